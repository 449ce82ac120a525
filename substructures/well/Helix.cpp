// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <sstream>

#include "substructures/well/Trajectory.hpp"

namespace tooljoint::well {
namespace {

class Helix : public Trajectory {
 public:
  Helix(double radius, double angle, double length)
      : a_(radius), length_(length), rate_(angle / length) {
    const double c = length / angle;  // sqrt(a^2 + b^2)
    if (c < radius) {
      std::ostringstream text;
      text << "A helix of radius " << radius << " m that turns through " << angle
           << " rad is at least " << radius * angle << " m long, but its length is " << length
           << " m: b = sqrt((length/angle)^2 - radius^2) is not real. "
           << "Make it longer, or the radius or the angle smaller.";
      throw DeckError(text.str());
    }
    b_ = std::sqrt((c - radius) * (c + radius));
  }
  double length() const override { return length_; }

  WellPoint at(double s) const override {
    if (s < 0.0 || s > length_) {
      WellPoint end = inside(s < 0.0 ? 0.0 : length_);
      end.position += (s < 0.0 ? s : s - length_) * end.tangent;
      end.curvature.setZero();
      return end;
    }
    return inside(s);
  }

 private:
  // p = rate s: X = a cos p - a, Y = a sin p, Z = b p
  WellPoint inside(double s) const {
    const double p = rate_ * s;
    const double sine = std::sin(p);
    const double cosine = std::cos(p);
    const double half = std::sin(0.5 * p);
    return {Vector3(-2.0 * a_ * half * half, a_ * sine, b_ * p),
            rate_ * Vector3(-a_ * sine, a_ * cosine, b_),
            rate_ * rate_ * a_ * Vector3(-cosine, -sine, 0.0)};
  }

  double a_;
  double b_ = 0.0;
  double length_;
  double rate_;  // dp/ds
};

const bool helixRegistered = TrajectoryRegistry::instance().add(
    "Helix",
    {"Helix about a vertical axis with constant curvature and torsion (Nguyen et al. 2020, eq. "
     "44).",
     deck::ListSpec("Helix",
                    "Helix about a vertical axis; it starts in the origin, heading towards Y.")
         .real("Radius", "m", deck::Required{}, deck::Range::positive(),
               "Radius of the helix seen from above.")
         .real("Angle", "rad", deck::Required{}, deck::Range::positive(),
               "Angle the helix turns through over its length.")
         .real("Length", "m", deck::Required{}, deck::Range::positive(),
               "Length along the hole; at least Radius times Angle."),
     [](const Teuchos::ParameterList& list, const std::string&) {
       try {
         return helix(list.get<double>("Radius"), list.get<double>("Angle"),
                      list.get<double>("Length"));
       } catch (const DeckError& error) {
         throw DeckError(list.name() + ": " + error.what());
       }
     }});

}  // namespace

std::unique_ptr<Trajectory> helix(double radius, double angle, double length) {
  return std::make_unique<Helix>(radius, angle, length);
}

}  // namespace tooljoint::well
