// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A SecondOrderModel in the form used by the time loop: dofs gathered into dense blocks, terms
/// with the same law merged. Matrices of equal layout, and loads, are combined again only when a
/// law has changed. Built once; nothing allocates afterwards.
///
/// Vectors are raw arrays in *positions* (dofs renumbered block by block); toPositions() and
/// toDofs() convert.
///
/// The model may be one rank's share of a motion divided among ranks (RankShare). Products, point
/// forces and loads are then partial at the cut; states are the same on all ranks that hold them;
/// sums, maxima and norms are those of the whole model (linalg::RankCut).
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
    bool skew = false;  ///< no work (gyroscopics): x'Ax = 0 to rounding
  };

  MatrixSum() = default;
  /// \param like a product whose list of blocks is shared with the terms where possible
  MatrixSum(const std::vector<model::MatrixTerm>& terms, const std::vector<model::ScalarLaw>& laws,
            const linalg::BlockPattern& pattern, const linalg::BlockProduct& like);
  bool empty() const { return terms_.empty(); }
  /// True if the value of a law has changed. The sum is formed when the laws are constant or when
  /// it is needed; while the laws vary, products are taken term by term.
  bool update(const std::vector<double>& lawValues);
  /// State of the last update() and of the sum, for a later return. The sum is formed again if
  /// another one has replaced it.
  struct Snapshot {
    std::vector<double> last;
    bool formed = false;
  };
  void remember(Snapshot& snapshot) const { snapshot.last = last_, snapshot.formed = formed_; }
  void comeBack(const Snapshot& snapshot);
  bool isFormed() const { return formed_; }
  void setFormed(bool formed);
  /// y += factor (A(t) - A(then)) x, with `then` the law values at another time.
  void addChangeSince(const std::vector<double>& then, double factor, const double* x,
                      double* y) const;
  /// y += A(t) x for the rows of these blocks.
  void addTo(const double* x, double* y, linalg::BlockRange rows) const;
  /// values += factor * A(t).
  void combine(double factor, double* values, std::size_t storage) const;
  double entry(std::size_t address) const { return terms_.empty() ? 0.0 : current()[address]; }
  const std::vector<Term>& terms() const { return terms_; }
  /// Value of the law of a term at the time of the last update().
  double factor(std::size_t term) const { return last_[term]; }
  /// Constant and symmetric: the forces have the potential x'Ax / 2.
  bool isConservative() const { return constant_ && product_.isSymmetric(); }
  /// Contribution of the rows of some blocks to x'Ax, for a conservative A.
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
  mutable bool formed_ = false;  ///< sum_ belongs to last_
  linalg::BlockProduct product_;
  bool constant_ = false;  ///< one term with the law 1: no sum is kept
};

class CompiledModel {
 public:
  /// Throws ModelError if the model is inconsistent.
  explicit CompiledModel(const model::SecondOrderModel& model);
  /// The model of one rank; the share must outlive it. Collective.
  explicit CompiledModel(const RankShare& share);
  CompiledModel(const CompiledModel&) = delete;
  CompiledModel& operator=(const CompiledModel&) = delete;

  int size() const { return pattern_.size(); }
  const model::SecondOrderModel& source() const { return model_; }
  const linalg::BlockPattern& pattern() const { return pattern_; }

  /// Conversion from and to dofs of the model of all ranks; toDofs() is collective.
  void toPositions(const Vector& dofs, Vector& positions) const;
  void toDofs(const Vector& positions, Vector& dofs) const;
  /// "theta_z of node 17".
  std::string dofName(int position) const;
  /// Name of the dof where x is largest or not a number; x must agree on all ranks that share it.
  /// Collective.
  std::string worstName(const Vector& x) const;
  /// Name for the result of BlockFactor::factor(). Collective.
  std::string pivotName(int position) const;

  const linalg::RankCut& cut() const { return pattern_.cut(); }
  /// Positions of the model of all ranks.
  int wholeSize() const { return wholeSize_; }
  /// x'y of an x that agrees on all ranks and a partial y; max |x_i|. Collective.
  double dot(const Vector& x, const Vector& partial) const;
  double largest(const Vector& x) const;
  /// sum x_i^2. Collective.
  double squaredNorm(const Vector& x) const;
  /// Number of a position in the model of all ranks.
  int numberInWhole(int position) const {
    return share_ != nullptr ? share_->numbers()[static_cast<std::size_t>(position)] : position;
  }

  /// Evaluate the laws at t and recombine what changed. Cheap if nothing has changed.
  void setTime(double t);
  double time() const { return time_; }
  // Loads and matrices for steps of length h. If a law f has corners within a step, f is replaced
  // by values with its integral and first moment; otherwise a jump or pulse between two ends of
  // steps would act early, late or not at all. Laws without corners have the values of setTime().

  /// At the end of an implicit step, followed by one of the same length:
  /// int_{-h}^{h} f(end + t) (1 - |t|/h) dt / h.
  void setStepEnd(double begin, double end);
  /// At the start of the first step: twice the part of this integral that lies ahead.
  void setStart(double t, double h);
  /// A stage in the middle or at the end t of a Runge-Kutta step from `begin`: f_2 = f_3 and f_4
  /// with (f_1 + 2 f_2 + 2 f_3 + f_4) / 6 = int f ds, (f_1 + f_2 + f_3) / 6 = int (1 - s) f ds.
  void setStage(double t, double begin, double h);
  /// At `end`, for the work since `begin`: (f(begin) + f) / 2 = int f ds. True if a law had a
  /// corner.
  bool setMean(double begin, double end);
  /// int (s - 1/2) f ds, with s from 0 at `begin` to 1 at `end`, for laws with a corner in between.
  /// The work of a load on a velocity v(0) + s Dv is its mean times that of v, plus this moment
  /// times Dv.
  void setMoment(double begin, double end);
  /// The first corner of a law after t and before `end`; else `end`.
  double nextCorner(double t, double end) const;
  /// State of setTime(), for callers that evaluate the model at other times and restore it
  /// afterwards. Allocates once.
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
  /// Products and loads are then bitwise equal to those at the time of remember().
  void comeBack(const Snapshot& snapshot);
  /// The same for a restart: append / restore the time, and which sums are formed. The matrix stamp
  /// is a new one.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);
  /// Changes with every change of C(t) or K(t).
  long matrixStamp() const { return stamp_; }
  /// F(t).
  const double* load() const { return load_.data(); }

  /// y += M x, y += C(t) x, y += K(t) x.
  void addMass(const double* x, double* y) const { addMass(x, y, all()); }
  void addDamping(const double* x, double* y) const { addDamping(x, y, all()); }
  void addStiffness(const double* x, double* y) const { addStiffness(x, y, all()); }
  /// x' M x. Collective.
  double massForm(const double* x) const { return cut().sum(ownMassForm(x)); }
  /// Contribution of this rank to x' M x.
  double ownMassForm(const double* x) const { return massProduct_.form(mass_.data(), x); }
  /// The same for the rows of some blocks, with a factor of M.
  void addMass(const double* x, double* y, linalg::BlockRange rows, double factor = 1.0) const {
    massProduct_.addTo(mass_.data(), x, y, factor, rows);
  }
  void addDamping(const double* x, double* y, linalg::BlockRange rows) const {
    damping_.addTo(x, y, rows);
  }
  void addStiffness(const double* x, double* y, linalg::BlockRange rows) const {
    stiffness_.addTo(x, y, rows);
  }
  /// All blocks, in runs whose vectors fit into a near cache: work run by run reads long vectors
  /// only once.
  const std::vector<linalg::BlockRange>& runs() const { return runs_; }

  /// Values of the laws at time().
  const std::vector<double>& lawValues() const { return lawValues_; }
  /// y += (c (C(t) - C(then)) + K(t) - K(then)) x, with `then` the law values at another time.
  void addChangeSince(const std::vector<double>& then, double c, const double* x, double* y);
  /// values = m M + c C(t) + k K(t) on the pattern (storage() doubles).
  void combine(double m, double c, double k, double* values) const;
  /// Diagonal of the same sum. Collective.
  void diagonal(double m, double c, double k, double* out) const;

  const MatrixSum& damping() const { return damping_; }
  const MatrixSum& stiffness() const { return stiffness_; }
  /// Separate batches for evaluating points apart from the motion.
  std::vector<PointBatch> makePoints() const;
  std::vector<PointBatch>& points() { return points_; }
  const std::vector<PointBatch>& points() const { return points_; }
  /// PointBatch::addMissed() of all batches; true if any rank has such points. Collective.
  bool addMissed(const double* q, double t = std::numeric_limits<double>::quiet_NaN());
  /// PointBatch::meetsOrLeavesWall() of any batch on any rank. Collective.
  bool meetsOrLeavesWall(const double* q);

  // States of point laws, one after the other in the order of points(); most models have none. A
  // rank has the states of its own points, and zeros for those of other ranks.
  int stateSize() const { return stateSize_; }
  /// States x of one rank -> of all ranks. Collective.
  void joinStates(Vector& x) const;
  /// States x of all ranks -> of this rank.
  void keepOwnStates(Vector& x) const { keepOwnStates(x.data()); }
  /// States at the start of a motion at (q, v).
  void initialStates(double t, const double* q, const double* v, double* x);
  /// States for the following evaluations of points, see PointStates::bind(); arrays of stateSize()
  /// that must outlive their use.
  void bindStates(const double* base, double factor = 0.0, const double* rate = nullptr);
  /// See PointStates::bindKnown().
  void bindKnownStates(const double* x, double factor);
  /// Rates of the last evaluation of all points.
  void stateRates(double* xDot) const;
  /// End (q, v) of an implicit step: sets states and rates, accepts held states.
  void completeStates(double t, const double* q, const double* v, double* x, double* xDot);
  /// End of an explicit step, with known rated states.
  void acceptStates(double t, const double* q, const double* v, double* x);
  /// out = from + s (to - from) for rated states; held states are copied from `held`.
  void blendStates(const Vector& from, const Vector& to, double s, const Vector& held,
                   Vector& out) const;
  /// Norm of the difference of rated states. Collective.
  double stateDistance(const Vector& a, const Vector& b) const;

  /// Adds the sum of R' f over all batches to y, evaluated at the active points of state (q, v).
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
  std::vector<double> loadLaws_, lastLoadLaws_;  ///< values to sum up, values contained in load_
  Vector load_;
  bool plainLoads_ = true;  ///< load_ has the law values at time_
  std::vector<double> lawValues_;
  std::vector<PointBatch> points_;
  double time_ = 0;
  bool timeSet_ = false;
  long stamp_ = 0;
  int stateSize_ = 0;
};

}  // namespace tooljoint::transient
