// SPDX-License-Identifier: BSD-3-Clause
// A wall that only pushes: the regularised spring and damper act for G > 0 alone and their sum is
// never negative.
#include <algorithm>

#include "substructures/contact/LawKernel.hpp"

namespace tooljoint::contact {
namespace {

/// F_n = max(0, K(G) G + C(G) G') for G > 0, zero for G <= 0, with K = (2 k/pi) atan(pi lambda G)
/// and C likewise: both rise from zero, so force and elastic tangent are continuous at the wall.
class ClampedKernel {
 public:
  void prepare(const ContactPoints& points) {
    for (int p = 0; p < points.size(); ++p) {
      const ContactPoint point = points.at(p);
      constants_.push_back({2.0 * point.stiffness / pi, 2.0 * point.damping / pi,
                            pi * point.lambdaK, pi * point.lambdaC});
    }
  }

  double forceOnly(std::size_t i, double G, double rate) const {
    if (G <= 0.0) return 0.0;
    const Constants& at = constants_[i];
    const double angleK = positiveAngle(at.bk * G);
    const double angleC = at.bk == at.bc ? angleK : positiveAngle(at.bc * G);
    return std::max(0.0, at.k * angleK * G + at.c * angleC * rate);
  }

  NormalForce force(std::size_t i, double G, double rate) const {
    if (G <= 0.0) return {};
    const Constants& at = constants_[i];
    const double x = at.bk * G;
    const double y = at.bc * G;
    const double angleK = positiveAngle(x);
    const double C = at.c * (at.bk == at.bc ? angleK : positiveAngle(y));
    const double value = at.k * angleK * G + C * rate;
    if (value <= 0.0) return {};
    return {value, at.k * (angleK + x / (1.0 + x * x)) + at.c * at.bc / (1.0 + y * y) * rate, C};
  }

  double elastic(std::size_t i, double G, double lambda, double& dG) const {
    dG = 0.0;
    if (G <= 0.0) return 0.0;
    const Constants& at = constants_[i];
    const double x = (lambda > 0.0 ? pi * lambda : at.bk) * G;
    const double angle = positiveAngle(x);
    dG = at.k * (angle + x / (1.0 + x * x));
    return at.k * angle * G;
  }

  double pull(std::size_t, double) const { return 0.0; }

  double energy(std::size_t i, double G) const {
    const Constants& at = constants_[i];
    return G <= 0.0 ? 0.0 : at.k / (at.bk * at.bk) * angleMoment(at.bk * G);
  }

  double skin(std::size_t) const { return 0.0; }

 private:
  struct Constants {
    double k, c, bk, bc;  // 2k/pi, 2c/pi, pi lambda_k, pi lambda_c
  };
  std::vector<Constants> constants_;
};

const bool clampedRegistered = LawRegistry::instance().add(
    "Clamped",
    {"Regularised spring and damper that only push: no force without penetration, none that pulls.",
     deck::ListSpec(), [](const Teuchos::ParameterList&) {
       return std::make_unique<ContactLawOf<ClampedKernel>>();
     }});

}  // namespace
}  // namespace tooljoint::contact
