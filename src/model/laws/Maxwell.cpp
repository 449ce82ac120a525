// SPDX-License-Identifier: BSD-3-Clause
// A spring and a dashpot in series: stiff for fast motion, yielding for slow one.
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

/// f = -k (d - x),  x' = (k/c) (d - x): x is the displacement of the dashpot. Relaxed at the start.
struct Maxwell : Formula<1, 1> {
  static constexpr bool walls = false;
  double k, c;
  explicit Maxwell(const Teuchos::ParameterList& list)
      : k(list.get<double>("Stiffness")), c(list.get<double>("Damping")) {}

  void initial(double, const double* d, const double*, double* x) const { x[0] = d[0]; }
  template <class T>
  void operator()(const PointAt<T>& at, T* f, T* g) const {
    const T stretch = at.d[0] - at.x[0];
    f[0] = -k * stretch;
    g[0] = k / c * stretch;
  }
  Power power(const PointAt<double>& at, const double* xDot) const {
    const double stretch = at.d[0] - at.x[0];
    Power p;
    p.stored = 0.5 * k * stretch * stretch;
    p.damping = c * xDot[0] * xDot[0];
    return p;
  }
};

const bool maxwellRegistered = registerFormula<Maxwell>(
    deck::ListSpec("Maxwell", "Spring and dashpot in series, relaxed at the start.")
        .real("Stiffness", "N/m", deck::Required{}, deck::Range::positive(),
              "Stiffness k of the spring.")
        .real("Damping", "N s/m", deck::Required{}, deck::Range::positive(),
              "Coefficient c of the dashpot; c/k is the relaxation time."));

}  // namespace
}  // namespace tooljoint::model
