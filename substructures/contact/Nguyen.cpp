// SPDX-License-Identifier: BSD-3-Clause
// The contact law as printed in Nguyen et al. 2020, eqs. (6), (7). It pulls on rebound, its damping
// jumps at G = 0, and it pulls every open node to the wall with k_c/(pi^2 lambda) at any gap.
#include <limits>

#include "substructures/contact/LawKernel.hpp"

namespace tooljoint::contact {
namespace {

/// F_n = K(G) G + C(G) G',  K = (k/pi) atan2(1, -pi lambda G), C likewise.
class NguyenKernel {
 public:
  void prepare(const ContactPoints& points) {
    for (int p = 0; p < points.size(); ++p) {
      const ContactPoint point = points.at(p);
      constants_.push_back(
          {point.stiffness / pi, point.damping / pi, pi * point.lambdaK, pi * point.lambdaC});
    }
  }

  double forceOnly(std::size_t i, double G, double rate) const {
    const Constants& at = constants_[i];
    const double angleK = risingAngle(at.bk * G);
    const double angleC = at.bk == at.bc ? angleK : risingAngle(at.bc * G);
    return at.k * angleK * G + at.c * angleC * rate;
  }

  NormalForce force(std::size_t i, double G, double rate) const {
    const Constants& at = constants_[i];
    const double x = at.bk * G;
    const double y = at.bc * G;
    const double angleK = risingAngle(x);
    const double angleC = at.bk == at.bc ? angleK : risingAngle(y);
    const double C = at.c * angleC;
    // d angle / dG = b / (1 + (b G)^2)
    return {at.k * angleK * G + C * rate,
            at.k * (angleK + x / (1.0 + x * x)) + at.c * at.bc / (1.0 + y * y) * rate, C};
  }

  double elastic(std::size_t i, double G, double lambda, double& dG) const {
    const Constants& at = constants_[i];
    const double x = (lambda > 0.0 ? pi * lambda : at.bk) * G;
    const double angle = risingAngle(x);
    dG = at.k * (angle + x / (1.0 + x * x));
    return at.k * angle * G;
  }

  // k/(pi^2 lambda), reached far from the wall
  double pull(std::size_t i, double lambda) const {
    return constants_[i].k / (lambda > 0.0 ? pi * lambda : constants_[i].bk);
  }

  // with x = b G: (k/pi)/b^2 int_0^x y (pi/2 + atan y) dy
  double energy(std::size_t i, double G) const {
    const Constants& at = constants_[i];
    const double x = std::abs(at.bk * G);
    const double scale = at.k / (at.bk * at.bk);
    if (G >= 0.0) return scale * (0.25 * pi * x * x + angleMoment(x));
    // below the wall: int_0^x y (pi/2 - atan y) dy = (x^2 atan(1/x) + x - atan x)/2
    const double even = 0.5 * (x * x * risingAngle(-x) + x - positiveAngle(x));
    return scale * even;
  }

  double skin(std::size_t i) const {
    const Constants& at = constants_[i];
    // tails: k/(pi b) and, at 1 m/s and a gap g, c/(pi b g); Constants holds k/pi and c/pi
    if (at.k / at.bk > negligibleForce) return std::numeric_limits<double>::infinity();
    return at.c / (at.bc * negligibleForce);
  }

 private:
  struct Constants {
    double k, c, bk, bc;  // k/pi, c/pi, pi lambda_k, pi lambda_c
  };
  std::vector<Constants> constants_;
};

const bool nguyenRegistered = LawRegistry::instance().add(
    "Nguyen", {"The regularised law as printed in Nguyen et al. 2020, eqs. (6), (7): it pulls on "
               "rebound and has a tail in the open.",
               deck::ListSpec(), [](const Teuchos::ParameterList&) {
                 return std::make_unique<ContactLawOf<NguyenKernel>>();
               }});

}  // namespace
}  // namespace tooljoint::contact
