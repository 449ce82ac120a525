// SPDX-License-Identifier: BSD-3-Clause
#include "deck/PrintedUnits.hpp"
#include "substructures/loads/Load.hpp"

namespace tooljoint::loads {
namespace {

/// rho S g along global +Z (down); the mud model adds buoyancy.
class Gravity final : public Load {
 public:
  explicit Gravity(const Teuchos::ParameterList& list) : gravity_(list.get<double>("Gravity")) {}

  Vector3 acceleration() const override { return {0.0, 0.0, gravity_}; }

  std::vector<LineLoad> onElement(const LoadedElement& element, const RotarySpeed&) const override {
    if (gravity_ == 0.0) return {};
    const Vector3 gravity = element.frame.transpose() * acceleration();
    return {{"weight", element.section.massPerLength() * gravity}};
  }

  std::vector<LoadRemark> describe(const RotarySpeed&) const override {
    return {{gravity_ != 0.0, "weight",
             gravity_ != 0.0 ? "g = " + deck::printed(gravity_, "m/s2") : "Gravity is 0"}};
  }

 private:
  double gravity_;  ///< [m/s2]
};

const bool gravityRegistered =
    addLoad<Gravity>("Gravity", "weight of the string, buoyancy in the mud.",
                     deck::ListSpec("Loads", "")
                         .real("Gravity", "m/s2", 9.81, deck::Range::nonNegative(),
                               "Gravity, straight down; 0 models no weight."));

}  // namespace
}  // namespace tooljoint::loads
