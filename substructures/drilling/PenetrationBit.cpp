// SPDX-License-Identifier: BSD-3-Clause
// A bit whose weight and torque depend on its rate of penetration.
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <string>

#include "common/Text.hpp"
#include "deck/PrintedUnits.hpp"
#include "model/laws/FormulaLaw.hpp"
#include "substructures/drilling/BitLaw.hpp"

namespace tooljoint::drilling {
namespace {

using deck::Range;

/// The bit and the rock of the source (Tucker and Wang 2003), in SI units.
namespace source {
constexpr double a1 = 3.429e-3, a2 = 5.672e-8, a3 = 1.374e-4, a4 = 9.537e6, a5 = 1.475e3;
}

/// With the advance v and the speed w of the bit, Z = w/sqrt(w^2 + e^2):
///
///     W = v/(a_2 Z^2) - a_3 w/(a_2 Z) + a_1/a_2,   T = v a_4 Z^2/w + a_5 Z
///
/// with w/Z = sqrt(w^2 + e^2) and Z^2/w = w/(w^2 + e^2), which are finite at w = 0 too. Z^2 in the
/// denominator is at least `floor`.
struct Penetration : model::Formula<2> {
  static constexpr bool walls = false;
  double a1, a2, a3, a4, a5, e, floor;

  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T*) const {
    using std::sqrt;
    const T v = at.v[0], w = at.v[1], square = w * w + e * e, root = sqrt(square);
    const T Z = w / root;
    const T Z2 = Z * Z > floor ? T(Z * Z) : T(floor);
    f[0] = -(v / (a2 * Z2) - a3 * root / a2 + a1 / a2);
    f[1] = -(v * a4 * w / square + a5 * Z);
  }
  /// All power given to the rock is lost.
  Power power(const model::PointAt<double>& at, const double*) const {
    return model::lostPower(*this, at);
  }
};

class TuckerWang final : public BitLaw {
 public:
  explicit TuckerWang(const Teuchos::ParameterList& list) {
    law_.a1 = list.get<double>("Threshold Rate");
    law_.a2 = list.get<double>("Rate per Weight");
    law_.a3 = list.get<double>("Rate per Speed");
    law_.a4 = list.get<double>("Torque per Depth");
    law_.a5 = list.get<double>("Torque of Friction");
    law_.e = list.get<double>("Regularisation Speed");
    law_.floor = list.get<double>("Smallest Z Squared");
    ofSource_ = law_.a1 == source::a1 && law_.a2 == source::a2 && law_.a3 == source::a3 &&
                law_.a4 == source::a4 && law_.a5 == source::a5;
  }
  bool givesWeight() const override { return true; }
  std::shared_ptr<const model::PointLaw> make(double) const override {
    return std::make_shared<model::FormulaLaw<Penetration>>(law_, 1);
  }
  bool weakensWithSpeed() const override { return true; }
  WeightRange calibration() const override {
    return ofSource_ ? WeightRange{100e3, 250e3} : WeightRange{};
  }
  std::string describe() const override {
    const std::string text = "weight and torque by the rate of penetration";
    if (!ofSource_) return text;
    const deck::PrintedUnit force("kN");
    return text +
           fmt::format(", calibrated for {:.4g} to {:.4g} ", force(calibration().least),
                       force(calibration().most)) +
           force.name();
  }

 private:
  Penetration law_;
  bool ofSource_;  ///< rock and bit of the source, fitted to these weights
};

const bool penetrationBitRegistered = addBitLaw<TuckerWang>(
    deck::ListSpec("Tucker-Wang",
                   "Weight and torque by the rate of penetration v, with Z = "
                   "omega/sqrt(omega^2 + e^2): W = v/(a_2 Z^2) - a_3 omega/(a_2 Z) + a_1/a_2, T = "
                   "v a_4 Z^2/omega + a_5 Z. Calibrated for 100 to 250 kN; outside the rock may "
                   "pull. (R. W. Tucker and C. Wang, Meccanica 38 (2003) 143-159; T. G. Ritto, C. "
                   "Soize and R. Sampaio, Int. J. Non-Linear Mech. 44 (2009) 865-876.)")
        .real("Threshold Rate", "m/s", source::a1, Range::nonNegative(),
              "a_1: what of the rate a weight has to overcome first.")
        .expert()
        .real("Rate per Weight", "m/(N s)", source::a2, Range::positive(),
              "a_2: rate of penetration per weight on bit.")
        .expert()
        .real("Rate per Speed", "m/rad", source::a3, Range::nonNegative(),
              "a_3: rate of penetration per rotary speed.")
        .expert()
        .real("Torque per Depth", "N rad", source::a4, Range::nonNegative(),
              "a_4: torque per depth of cut v/omega.")
        .expert()
        .real("Torque of Friction", "N m", source::a5, Range::nonNegative(),
              "a_5: torque of a bit that does not penetrate.")
        .expert()
        .real("Regularisation Speed", "rad/s", 2.0, Range::positive(),
              "e: speed below which the bit cuts less.")
        .expert()
        .real("Smallest Z Squared", "", 1e-2, Range{0.0, 1.0, true, false},
              "Z^2 is taken no smaller where it divides: a bit that stands still resists with "
              "1/(a_2 Z^2) times its advance, not without limit.")
        .expert());

}  // namespace
}  // namespace tooljoint::drilling
