// SPDX-License-Identifier: BSD-3-Clause
// A point law outside of the library: one file, compiled by itself, named in decks.
#include <tooljoint/model/laws/PointLawRegistry.hpp>

using namespace tooljoint;

/// A wall that creeps (Zener): with the penetration p = -d > 0,
///
///     f = max(0, k p + k1 (p - x)),   x' = (p - x) / tau;   x falls back likewise without contact
struct CreepingWall : model::Formula<1, 1> {  // one coordinate, one state
  double k, k1, tau;
  explicit CreepingWall(const Teuchos::ParameterList& list)
      : k(list.get<double>("Stiffness")),
        k1(list.get<double>("Fast Stiffness")),
        tau(list.get<double>("Creep Time")) {}

  void initial(double, const double* d, const double*, double* x) const {
    x[0] = std::max(0.0, -d[0]);
  }
  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T* g) const {
    const T p = at.d[0] < 0.0 ? T(-at.d[0]) : T(0.0);
    const T push = k * p + k1 * (p - at.x[0]);
    f[0] = p > 0.0 && push > 0.0 ? push : T(0.0);
    g[0] = (p - at.x[0]) / tau;
  }
  Power power(const model::PointAt<double>& at, const double*) const {
    const double p = std::max(0.0, -at.d[0]);
    double f = 0, g = 0;
    (*this)(at, &f, &g);
    Power power;
    power.stored = 0.5 * k * p * p;
    power.damping = (f - k * p) * (p > 0.0 ? -at.v[0] : 0.0);  // the part not returned
    return power;
  }
};

const bool registered = model::registerFormula<CreepingWall>(
    deck::ListSpec("Creeping Wall", "A wall that creeps under load.")
        .real("Stiffness", "N/m", deck::Required{}, deck::Range::positive(), "At rest, k.")
        .real("Fast Stiffness", "N/m", deck::Required{}, deck::Range::positive(),
              "What fast motion feels beside that, k1.")
        .real("Creep Time", "s", deck::Required{}, deck::Range::positive(), "tau."));
