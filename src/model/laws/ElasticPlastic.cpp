// SPDX-License-Identifier: BSD-3-Clause
// A spring with yield: dry friction with elastic sticking (Prandtl element, Jenkin element).
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

/// f = -k (d - p), limited to +-F by the plastic displacement p, which is updated at the end of a
/// step:
///
///     e = d - p_n;   |k e| <= F: f = -k e, p = p_n;   else f = -F sign e, p = d - (F/k) sign e
struct ElasticPlastic : Formula<1, 0, 1> {
  static constexpr bool walls = false;
  double k, F;
  explicit ElasticPlastic(const Teuchos::ParameterList& list)
      : k(list.get<double>("Stiffness")), F(list.get<double>("Yield Force")) {}

  void initial(double, const double* d, const double*, double* p) const { p[0] = d[0]; }
  template <class T>
  void operator()(const PointAt<T>& at, T* f, T*) const {
    const T elastic = -k * (at.d[0] - at.held[0]);
    f[0] = elastic > F ? T(F) : elastic < -F ? T(-F) : elastic;
  }
  void accept(double, const double* d, const double*, double* p) const {
    p[0] = std::clamp(p[0], d[0] - F / k, d[0] + F / k);
  }
  /// Small motions do not yield.
  std::optional<std::complex<double>> heldFactor(std::complex<double>, const double*,
                                                 const double*) const {
    return 1.0;
  }
  Power power(const PointAt<double>& at, const double* xDot) const {
    Power power;
    const double stretch = std::clamp(at.d[0] - at.held[0], -F / k, F / k);
    power.stored = 0.5 * k * stretch * stretch;
    power.friction = F * std::abs(xDot[0]);
    return power;
  }
};

const bool elasticPlasticRegistered = registerFormula<ElasticPlastic>(
    deck::ListSpec("Elastic-Plastic",
                   "Spring that yields at a force: dry friction with elastic sticking (Prandtl, "
                   "Jenkin), relaxed at the start.")
        .real("Stiffness", "N/m", deck::Required{}, deck::Range::positive(),
              "Stiffness k while it sticks.")
        .real("Yield Force", "N", deck::Required{}, deck::Range::positive(),
              "Force F beyond which it slips."));

}  // namespace
}  // namespace tooljoint::model
