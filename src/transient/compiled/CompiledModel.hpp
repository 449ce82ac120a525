// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A SecondOrderModel in the form a step loop wants: dofs gathered into dense blocks, terms that
/// share a law merged, matrices of equal layout combined only when a law has changed, loads
/// likewise. Built once; nothing here allocates afterwards.
///
/// Vectors are raw arrays in *positions* (dofs renumbered block by block); toPositions()/toDofs()
/// translate.
///
/// The model may be one rank's share of a motion that several compute (RankShare). Products, point
/// forces and loads are then partial at the cut, states are the same on all ranks that hold them,
/// and sums, maxima and norms are those of the whole (linalg::RankCut).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/compiled/PointBatch.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient {

/// A sum of constant matrices times laws: sum_i c_i(t) C_i.
class MatrixSum {
 public:
  struct Term {
    std::string name;            ///< names of the merged terms, joined by " + "
    int law = 0;                 ///< index of the model's law
    linalg::BlockValues values;  ///< on the common pattern
    linalg::BlockProduct product;
    bool skew = false;  ///< does no work (gyroscopics): x'Ax = 0 to rounding
  };

  MatrixSum() = default;
  /// \param like  a product whose list of blocks those of the terms share where they can
  MatrixSum(const std::vector<model::MatrixTerm>& terms, const std::vector<model::ScalarLaw>& laws,
            const linalg::BlockPattern& pattern, const linalg::BlockProduct& like);
  bool empty() const { return terms_.empty(); }
  /// True if a law has another value than last time. The sum is formed when the laws stand still or
  /// it is needed; while they change, products go term by term.
  bool update(const std::vector<double>& lawValues);
  /// What update() and products have left, to come back to: the sum is formed anew where another
  /// has been.
  struct Snapshot {
    std::vector<double> last;
    bool formed = false;
  };
  void remember(Snapshot& snapshot) const { snapshot.last = last_, snapshot.formed = formed_; }
  void comeBack(const Snapshot& snapshot);
  bool isFormed() const { return formed_; }
  void setFormed(bool formed);
  /// y += factor (A(t) - A(then)) x, where `then` are the law values at another time.
  void addChangeSince(const std::vector<double>& then, double factor, const double* x,
                      double* y) const;
  /// y += A(t) x, rows of these blocks.
  void addTo(const double* x, double* y, linalg::BlockRange rows) const;
  /// values += factor * A(t).
  void combine(double factor, double* values, std::size_t storage) const;
  double entry(std::size_t address) const { return terms_.empty() ? 0.0 : current()[address]; }
  const std::vector<Term>& terms() const { return terms_; }
  /// Value of the law of a term at the time of the last update().
  double factor(std::size_t term) const { return last_[term]; }
  /// Constant and symmetric: forces of a potential x'Ax / 2.
  bool isConservative() const { return constant_ && product_.isSymmetric(); }
  /// The part of x'Ax that the rows of some blocks add, of a conservative A.
  double form(const double* x, linalg::BlockRange rows) const {
    return product_.form(current(), x, rows);
  }
  /// Values of A(t) on the pattern; undefined when empty().
  const double* current() const {
    if (constant_) return terms_.front().values.data();
    if (!formed_) form();
    return sum_.data();
  }

 private:
  std::vector<Term> terms_;
  std::vector<double> last_;  ///< law values at the time of the last update()
  void form() const;
  mutable linalg::BlockValues sum_;
  mutable bool formed_ = false;  ///< sum_ is for last_
  linalg::BlockProduct product_;
  bool constant_ = false;  ///< one term with the law 1: no sum is kept
};

class CompiledModel {
 public:
  /// Throws ModelError when the model is inconsistent.
  explicit CompiledModel(const model::SecondOrderModel& model);
  /// That of one rank; the share must outlive it. Collective.
  explicit CompiledModel(const RankShare& share);
  CompiledModel(const CompiledModel&) = delete;
  CompiledModel& operator=(const CompiledModel&) = delete;

  int size() const { return pattern_.size(); }
  const model::SecondOrderModel& source() const { return model_; }
  const linalg::BlockPattern& pattern() const { return pattern_; }

  /// From and to dofs of the model of all ranks; toDofs() is collective.
  void toPositions(const Vector& dofs, Vector& positions) const;
  void toDofs(const Vector& positions, Vector& dofs) const;
  /// "theta_z of node 17".
  std::string dofName(int position) const;
  /// Where x is largest, or not a number; x the same on all ranks that share it. Collective.
  std::string worstName(const Vector& x) const;
  /// Of what BlockFactor::factor() returned. Collective.
  std::string pivotName(int position) const;

  const linalg::RankCut& cut() const { return pattern_.cut(); }
  /// Positions of the model of all ranks.
  int wholeSize() const { return wholeSize_; }
  /// x'y of an x that is the same on all ranks and a partial y; max |x_i|. Collective.
  double dot(const Vector& x, const Vector& partial) const;
  double largest(const Vector& x) const;
  /// sum x_i^2. Collective.
  double squaredNorm(const Vector& x) const;
  /// Place of a position in the model of all ranks.
  int numberInWhole(int position) const {
    return share_ != nullptr ? share_->numbers()[static_cast<std::size_t>(position)] : position;
  }

  /// Evaluate the laws at t and recombine what changed. Cheap when nothing did.
  void setTime(double t);
  double time() const { return time_; }
  // Loads and matrices of steps of length h inside which a law f has corners: f is replaced by
  // values that give its integral and first moment, since what jumps or pulses between two ends of
  // steps would otherwise come early, late or not at all. Elsewhere they are those of setTime().

  /// At the end of an implicit step, for one of the same length behind it:
  /// int_{-h}^{h} f(end + t) (1 - |t|/h) dt / h.
  void setStepEnd(double begin, double end);
  /// Where the first one begins: the half of that which is ahead, twice.
  void setStart(double t, double h);
  /// A stage in the middle or at the end t of a Runge-Kutta step from `begin`: f_2 = f_3 and f_4
  /// with (f_1 + 2 f_2 + 2 f_3 + f_4) / 6 = int f ds, (f_1 + f_2 + f_3) / 6 = int (1 - s) f ds.
  void setStage(double t, double begin, double h);
  /// At `end`, for the work since `begin`: (f(begin) + f) / 2 = int f ds. True when a law had a
  /// corner.
  bool setMean(double begin, double end);
  /// int (s - 1/2) f ds, with s from 0 at `begin` to 1 at `end`, of laws with a corner between; the
  /// work of a load on a velocity v(0) + s Dv is its mean times that of v, and this times Dv.
  void setMoment(double begin, double end);
  /// The first corner of a law after t and before `end`; else `end`.
  double nextCorner(double t, double end) const;
  /// What setTime() has left, for somebody who takes the model to other times and wants to leave no
  /// trace. Allocates once.
  struct Snapshot {
    double time = 0;
    bool timeSet = false;
    long stamp = 0;
    std::vector<double> lawValues, loadLaws;
    Vector load;
    bool plain = true;
    MatrixSum::Snapshot damping, stiffness;
  };
  void remember(Snapshot& snapshot) const;
  /// Products and loads are then bit by bit those of the time of remember().
  void comeBack(const Snapshot& snapshot);
  /// The same for a restart: append / take back the time, and which sums are formed. The matrix
  /// stamp is not one of before.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);
  /// Changes whenever C(t) or K(t) changed.
  long matrixStamp() const { return stamp_; }
  /// F(t).
  const double* load() const { return load_.data(); }

  /// y += M x, y += C(t) x, y += K(t) x.
  void addMass(const double* x, double* y) const { addMass(x, y, all()); }
  void addDamping(const double* x, double* y) const { addDamping(x, y, all()); }
  void addStiffness(const double* x, double* y) const { addStiffness(x, y, all()); }
  /// x' M x. Collective.
  double massForm(const double* x) const { return cut().sum(ownMassForm(x)); }
  /// The share of this rank in it.
  double ownMassForm(const double* x) const { return massProduct_.form(mass_.data(), x); }
  /// The same for the rows of some blocks, M times a factor.
  void addMass(const double* x, double* y, linalg::BlockRange rows, double factor = 1.0) const {
    massProduct_.addTo(mass_.data(), x, y, factor, rows);
  }
  void addDamping(const double* x, double* y, linalg::BlockRange rows) const {
    damping_.addTo(x, y, rows);
  }
  void addStiffness(const double* x, double* y, linalg::BlockRange rows) const {
    stiffness_.addTo(x, y, rows);
  }
  /// All blocks in runs whose vectors stay in a near cache: what is done run by run reads long
  /// vectors once.
  const std::vector<linalg::BlockRange>& runs() const { return runs_; }

  /// Values of the laws at time().
  const std::vector<double>& lawValues() const { return lawValues_; }
  /// y += (c (C(t) - C(then)) + K(t) - K(then)) x, where `then` are the law values at another time.
  void addChangeSince(const std::vector<double>& then, double c, const double* x, double* y);
  /// values = m M + c C(t) + k K(t) on the pattern (storage() doubles).
  void combine(double m, double c, double k, double* values) const;
  /// Diagonal of the same sum. Collective.
  void diagonal(double m, double c, double k, double* out) const;

  const MatrixSum& damping() const { return damping_; }
  const MatrixSum& stiffness() const { return stiffness_; }
  /// Batches of its own for somebody who evaluates points beside the motion.
  std::vector<PointBatch> makePoints() const;
  std::vector<PointBatch>& points() { return points_; }
  const std::vector<PointBatch>& points() const { return points_; }
  /// PointBatch::addMissed() of all; true where any rank has such points. Collective.
  bool addMissed(const double* q, double t = std::numeric_limits<double>::quiet_NaN());
  /// PointBatch::meetsOrLeavesWall() of any, on any rank. Collective.
  bool meetsOrLeavesWall(const double* q);

  // States of point laws, one after the other in the order of points(); most models have none. A
  // rank has those of its own points, and zeros for the points of others.
  int stateSize() const { return stateSize_; }
  /// x of one rank -> of all. Collective.
  void joinStates(Vector& x) const;
  /// x of all ranks -> of this one.
  void keepOwnStates(Vector& x) const { keepOwnStates(x.data()); }
  /// Those of the start of a motion at (q, v).
  void initialStates(double t, const double* q, const double* v, double* x);
  /// What the points are evaluated with from now on, see PointStates::bind(); arrays of
  /// stateSize() that must outlive their use.
  void bindStates(const double* base, double factor = 0.0, const double* rate = nullptr);
  /// See PointStates::bindKnown().
  void bindKnownStates(const double* x, double factor);
  /// Rates of the last evaluation of all points.
  void stateRates(double* xDot) const;
  /// The end (q, v) of an implicit step: states, their rates, held ones accepted.
  void completeStates(double t, const double* q, const double* v, double* x, double* xDot);
  /// Of an explicit one, whose rated states are known.
  void acceptStates(double t, const double* q, const double* v, double* x);
  /// out = from + s (to - from) for rated states, those of `held` for the others.
  void blendStates(const Vector& from, const Vector& to, double s, const Vector& held,
                   Vector& out) const;
  /// Length of the difference of rated states. Collective.
  double stateDistance(const Vector& a, const Vector& b) const;

  /// sum of R' f over all batches: evaluated at the active points of state (q, v), added to y.
  void addPointForces(double t, const double* q, const double* v, double* y);

 private:
  CompiledModel(const model::SecondOrderModel& model, const RankShare* share);
  Vector inOrder(const Vector& dofs) const;
  void keepOwnStates(double* x) const;
  void sumLoads();
  template <class Value>
  void crossCorners(double begin, double end, const Value& value);
  template <class Value>
  void crossCornersOfMatrices(double begin, double end, const Value& value);
  linalg::BlockRange all() const { return {0, pattern_.blocks()}; }

  const model::SecondOrderModel& model_;
  const RankShare* share_ = nullptr;  ///< null: the whole model
  int wholeSize_ = 0;
  linalg::BlockPattern pattern_;
  std::vector<linalg::BlockRange> runs_;
  linalg::BlockValues mass_;
  linalg::BlockProduct massProduct_;
  MatrixSum damping_;
  MatrixSum stiffness_;
  std::vector<std::size_t> diagonalAddress_;
  struct Load {
    int law;
    Vector vector;  ///< positions
  };
  std::vector<Load> loads_;
  std::vector<double> loadLaws_, lastLoadLaws_;  ///< to sum up, and those in load_
  Vector load_;
  bool plainLoads_ = true;  ///< load_ has the values of the laws at time_
  std::vector<double> lawValues_;
  std::vector<PointBatch> points_;
  double time_ = 0;
  bool timeSet_ = false;
  long stamp_ = 0;
  int stateSize_ = 0;
};

}  // namespace tooljoint::transient
