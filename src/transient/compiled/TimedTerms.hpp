// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/compiled/MatrixSum.hpp"

namespace tooljoint::transient {

/// Terms of a model that depend on time: C(t), K(t) and F(t), in positions. They are formed again
/// only when a law has changed.
class TimedTerms {
 public:
  TimedTerms() = default;
  /// \param model must outlive the object; \param like see MatrixSum
  TimedTerms(const model::SecondOrderModel& model, const linalg::BlockPattern& pattern,
             const linalg::BlockProduct& like);

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

  /// Values of the laws at time().
  const std::vector<double>& lawValues() const { return lawValues_; }
  /// y += (c (C(t) - C(then)) + K(t) - K(then)) x, with `then` the law values at another time.
  void addChangeSince(const std::vector<double>& then, double c, const double* x, double* y);

  const MatrixSum& damping() const { return damping_; }
  const MatrixSum& stiffness() const { return stiffness_; }

 private:
  void sumLoads();
  template <class Value>
  void crossCorners(double begin, double end, const Value& value);
  template <class Value>
  void crossCornersOfMatrices(double begin, double end, const Value& value);

  struct Load {
    int law;
    Vector vector;  ///< positions
  };
  const model::SecondOrderModel* model_ = nullptr;
  MatrixSum damping_;
  MatrixSum stiffness_;
  std::vector<Load> loads_;
  std::vector<double> loadLaws_, lastLoadLaws_;  ///< values to sum up, values contained in load_
  Vector load_;
  bool plainLoads_ = true;  ///< load_ has the law values at time_
  std::vector<double> lawValues_;
  double time_ = 0;
  bool timeSet_ = false;
  long stamp_ = 0;
};

}  // namespace tooljoint::transient
