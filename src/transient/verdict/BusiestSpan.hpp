// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where in a run its steps have most to follow. With the change h (a_k - a_k-1) of velocity that
/// the acceleration at the beginning of a step misses in it,
///
///     J^2 = sum |h (a_k - a_k-1)|^2 / sum |v_k|^2
///
/// over the steps of a span of a second, or a tenth of the run, |.| the norm of the diagonal of the
/// mass, which costs no product. The busiest span is the one with the largest numerator. Spans
/// begin a sixth of their length apart, and the state there is kept.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class BusiestSpan {
 public:
  /// \param window  of the run \param known  its motion up to there is judged anyway [s]
  /// \param like  a state
  BusiestSpan(const CompiledModel& model, const Window& window, double known, const State& like);
  /// After each step. Collective at the end of a part.
  void look(const State& from, const State& to);
  /// The busiest span is not known, has at least four times the numerator of those that are, and a
  /// J of more than 1 %.
  bool isLater() const;
  /// Where it begins.
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
  double begin_, part_, known_;  ///< of the run, length of a part, what is known from the start [s]
  std::array<Part, parts> last_;  ///< the part under way and those before it, in turn
  long closed_ = 0;               ///< parts
  bool empty_ = true;             ///< the part under way has no step
  double knownJumps_ = 0;         ///< most of a span that is known
  Part best_;                     ///< the busiest span so far
  Eigen::ArrayXd inertia_;        ///< diagonal of the mass; 0 for what another rank counts
  Vector difference_;
};

}  // namespace tooljoint::transient
