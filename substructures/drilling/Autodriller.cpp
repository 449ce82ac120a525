// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drilling/Autodriller.hpp"

#include <limits>
#include <memory>

#include "common/Error.hpp"
#include "deck/PrintedUnits.hpp"
#include "model/laws/FormulaLaw.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drilling/BitLaw.hpp"

namespace tooljoint::drilling {
namespace {

using deck::Optional;
using deck::Range;
using deck::Required;

/// Lines of stiffness k between a block and the string. The block is ahead of its frame by x, and e
/// is the integral of the missing weight:
///
///     f = F_0 - k (w - x),   W = W_0 + f - F_0   (a slack line puts weight on the bit)
///     u = k_p (W_set - W) + k_i e,   x' = u within -feed ... fastest - feed
///     e' = W_set - W + (x' - u)/k_p
///
/// with anti-windup by back-calculation as in the law Speed Control. The block never goes up.
struct Lines : model::Formula<1, 2> {
  static constexpr bool walls = false;
  double k, kp, ki, F0, lack;  ///< lack: W_set - W_0 [N]
  double slowest, fastest;     ///< x' [m/s]

  void initial(double, const double* d, const double*, double* x) const {
    x[0] = d[0];
    x[1] = 0.0;
  }
  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T* g) const {
    const T line = k * (at.d[0] - at.x[0]), error = lack + line;
    const T wanted = kp * error + ki * at.x[1];
    f[0] = F0 - line;
    g[0] = wanted < slowest ? T(slowest) : wanted > fastest ? T(fastest) : wanted;
    g[1] = error + (g[0] - wanted) / kp;
  }
  Power power(const model::PointAt<double>& at, const double* xDot) const {
    const double stretch = at.d[0] - at.x[0];
    Power p;
    p.stored = 0.5 * k * stretch * stretch;
    p.drive = F0 * at.v[0] - k * stretch * xDot[0];
    return p;
  }
};

}  // namespace

deck::ListSpec autodrillerParameters() {
  return deck::ListSpec(
             "Autodriller",
             "A PI controller that holds the weight on bit by the speed of the block. "
             "It takes the weight from what the hook load lacks; the block never goes up. "
             "Needs a Bit law that gives the weight on bit.")
      .real("Weight On Bit", "N", Required{}, Range::positive(), "Set point.")
      .real("Proportional Gain", "m/(N s)", Required{}, Range::positive(),
            "Gain k_p: speed of the block for what the weight lacks.")
      .real("Integral Gain", "m/(N s2)", 0.0, Range::nonNegative(),
            "Gain k_i on the integral of what the weight lacks.")
      .real("Largest Block Speed", "m/s", Optional{}, Range::positive(),
            "Limit of the speed of the block; none without it.")
      .real("Line Stiffness", "N/m", 1e7, Range::positive(),
            "Stiffness of the lines that carry the block: ten lines of 40 m with 1 MN/m each.")
      .expert()
      .real("Block Mass", "kg", 0.0, Range::nonNegative(),
            "Mass of block and drive, which moves with the top of the string.")
      .expert();
}

Autodriller readAutodriller(const Teuchos::ParameterList& list) {
  Autodriller settings;
  settings.weight = list.get<double>("Weight On Bit");
  settings.proportionalGain = list.get<double>("Proportional Gain");
  settings.integralGain = list.get<double>("Integral Gain");
  if (list.isParameter("Largest Block Speed"))
    settings.fastest = list.get<double>("Largest Block Speed");
  settings.lineStiffness = list.get<double>("Line Stiffness");
  settings.blockMass = list.get<double>("Block Mass");
  return settings;
}

PointOnString autodrillerOnString(const Autodriller& settings, double feed, double staticForce,
                                  double staticWeight) {
  if (settings.fastest && feed > *settings.fastest)
    throw ModelError("Steady drilling needs a block speed of " + deck::printed(feed, "m/s", 4) +
                     ", more than Top Drive/Autodriller/Largest Block Speed of " +
                     deck::printed(*settings.fastest, "m/s", 4) +
                     ". Raise it, or reduce the weight on bit.");
  Lines lines;
  lines.k = settings.lineStiffness;
  lines.kp = settings.proportionalGain;
  lines.ki = settings.integralGain;
  lines.F0 = staticForce;
  lines.lack = settings.weight - staticWeight;
  lines.slowest = -feed;
  lines.fastest =
      settings.fastest ? *settings.fastest - feed : std::numeric_limits<double>::infinity();
  return onString(hookSet, 0,
                  {{beam::nodal::w,
                    {},
                    {"measured_weight", "N", "Weight on bit as the hook load shows it"},
                    1.0,
                    staticWeight - staticForce}},
                  std::make_shared<model::FormulaLaw<Lines>>(lines, 1),
                  {{0, {"block_speed", "m/s", "Speed of the block, positive down"}, feed}});
}

}  // namespace tooljoint::drilling
