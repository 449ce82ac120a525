// SPDX-License-Identifier: BSD-3-Clause
// A bit that resists by a smooth function of its speed, without a regularisation velocity.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <memory>

#include "common/Text.hpp"
#include "model/laws/FormulaLaw.hpp"
#include "substructures/drilling/BitLaw.hpp"

namespace tooljoint::drilling {
namespace {

using deck::Range;

/// T = W b_0 [tanh(b_1 w) + b_2 w/(1 + b_3 w^2)]
struct TanhTorque : model::Formula<1> {
  static constexpr bool walls = false;
  double force, b1, b2, b3;  ///< force: W b_0 [N m]

  template <class T>
  T torque(const T& w) const {
    using std::tanh;
    return force * (tanh(T(b1 * w)) + b2 * w / (1.0 + b3 * w * w));
  }
  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T*) const {
    f[0] = -torque(at.v[0]);
  }
  Power power(const model::PointAt<double>& at, const double*) const {
    Power p;
    p.friction = torque(at.v[0]) * at.v[0];
    return p;
  }
};

class Tanh final : public BitLaw {
 public:
  explicit Tanh(const Teuchos::ParameterList& list) : lever_(list.get<double>("Lever")) {
    curve_.b1 = list.get<double>("Rise");
    curve_.b2 = list.get<double>("Peak");
    curve_.b3 = list.get<double>("Peak Width");
  }
  bool givesWeight() const override { return false; }
  std::shared_ptr<const model::PointLaw> make(double weightOnBit) const override {
    auto curve = curve_;
    curve.force = weightOnBit * lever_;
    return std::make_shared<model::FormulaLaw<TanhTorque>>(curve, 1);
  }
  bool weakensWithSpeed() const override { return curve_.b2 > 0.0; }
  std::string describe() const override {
    return "torque by a smooth curve of the speed, " + formatNumber(lever_) +
           " m times the weight on bit at high speed";
  }

 private:
  double lever_;
  TanhTorque curve_;
};

const bool tanhBitRegistered = addBitLaw<Tanh>(
    deck::ListSpec("Tanh",
                   "Torque T = W b_0 [tanh(b_1 omega) + b_2 omega/(1 + b_3 omega^2)] under the "
                   "Weight On Bit W of Loads; without sticking: at standstill it creeps. Defaults "
                   "are those of the group of acoustics and vibration of COPPE/UFRJ, given for "
                   "244.2 kN.")
        .real("Lever", "m", 0.0239, Range::positive(), "b_0: torque over weight of a fast bit.")
        .expert()
        .real("Rise", "s/rad", 1.91, Range::positive(),
              "b_1: the inverse of the speed over which the torque rises from zero.")
        .expert()
        .real("Peak", "s/rad", 8.5, Range::nonNegative(),
              "b_2: size of the peak at low speed, from which the torque falls; 0 for none.")
        .real("Peak Width", "s2/rad2", 5.47, Range::positive(),
              "b_3: the peak lies near the speed 1/sqrt(b_3).")
        .expert());

}  // namespace
}  // namespace tooljoint::drilling
