// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The span of a run that is hardest for its steps. h (a_k - a_k-1) is the change of velocity in a
/// step that the acceleration at its beginning misses;
///
///     J^2 = sum |h (a_k - a_k-1)|^2 / sum |v_k|^2
///
/// over the steps of a span of a second, or a tenth of the run. |.| is the norm of the diagonal
/// mass, which needs no product. The busiest span has the largest numerator. Spans start a sixth of
/// their length apart, and the state there is kept.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class BusiestSpan {
 public:
  /// \param window of the run
  /// \param known length of the motion that is judged in any case, from the start of the run [s]
  /// \param like a state
  BusiestSpan(const CompiledModel& model, const Window& window, double known, const State& like);
  /// After each step. Collective at the end of each part.
  void look(const State& from, const State& to);
  /// Whether the busiest span is outside the known motion, has more than four times the numerator
  /// of the known spans, and J above 1 %.
  bool isLater() const;
  /// State at the start of the busiest span.
  const State& start() const { return best_.from; }
  double end() const { return best_.from.t + length(); }                ///< [s]
  double length() const { return static_cast<double>(parts) * part_; }  ///< [s]

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  static constexpr std::size_t parts = 6;  ///< of a span
  struct Sums {
    double jumps = 0, speeds = 0;  ///< of |h (a_k - a_k-1)|^2 and |v_k|^2
  };
  struct Part {
    State from;
    Sums sums;
  };
  void close();
  double square(const Vector& v) const { return (v.array().square() * inertia_).sum(); }

  const CompiledModel* model_;
  double begin_, part_, known_;   ///< start of the run, length of a part, known motion [s]
  std::array<Part, parts> last_;  ///< the current part and those before it, cyclic
  long closed_ = 0;               ///< number of closed parts
  bool empty_ = true;             ///< the current part has no step yet
  double knownJumps_ = 0;         ///< largest numerator of a known span
  Part best_;                     ///< the busiest span so far
  Eigen::ArrayXd inertia_;        ///< diagonal of the mass; 0 for dofs that another rank counts
  Vector difference_;
};

}  // namespace tooljoint::transient
