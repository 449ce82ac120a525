// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A contact law of your own, named in scene.xml: a Hertzian wall with dissipation (Hunt and
/// Crossley 1975). With the penetration p = -d of the separation d
///
///     f = k p^(3/2) (1 + c p'),   f >= 0
#include <Tpetra_Core.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tooljoint/common/Parallel.hpp>
#include <tooljoint/model/laws/PointLawRegistry.hpp>
#include <tooljoint/run.hpp>
using namespace tooljoint;

struct HertzWall : model::Formula<1> {  // one coordinate, no state
  double k, c;
  explicit HertzWall(const Teuchos::ParameterList& list)
      : k(list.get<double>("Stiffness")), c(list.get<double>("Damping")) {}

  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T*) const {
    using std::sqrt;
    f[0] = T(0.0);
    if (!(at.d[0] < 0.0)) return;
    const T p = -at.d[0];
    const T push = k * p * sqrt(p) * (1.0 - c * at.v[0]);
    if (push > 0.0) f[0] = push;
  }
  Power power(const model::PointAt<double>& at, const double*) const {
    const double p = std::max(0.0, -at.d[0]);
    double f = 0;
    (*this)(at, &f, static_cast<double*>(nullptr));
    const double elastic = k * p * std::sqrt(p);
    return {0.4 * elastic * p, (elastic - f) * at.v[0]};  // stored [J], lost [W]
  }
};
const bool registered = model::registerFormula<HertzWall>(
    deck::ListSpec("Hertz Wall", "Hertzian wall with losses (Hunt and Crossley 1975).")
        .real("Stiffness", "N/m^1.5", deck::Required{}, deck::Range::positive(), "k.")
        .real("Damping", "s/m", 0.0, deck::Range::nonNegative(), "c."));

/// Largest relative difference of a normal force at rest from k p^(3/2).
double errorAtRest(const Results& results, double k) {
  const auto file = results.histories();
  const auto u = file.numbers("/static/displacement"), force = file.numbers("/static/normal_force"),
             clearance = file.numbers("/model/clearance");
  double error = 0;
  for (std::size_t node = 0; node < force.size(); ++node) {
    const double p = std::hypot(u[6 * node], u[6 * node + 1]) - clearance[node];
    if (force[node] > 1.0)
      error = std::max(error, std::abs(k * std::pow(p, 1.5) / force[node] - 1));
  }
  return error;
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    const auto results = runDeck(SCENE);
    const double error = errorAtRest(results, 1e9);
    const double nodes = results.number("static.contact_nodes");
    if (parallel::rank() == 0)
      std::printf("%g nodes touch; their forces are those of the law to %.1e\n", nodes, error);
    return nodes > 0 && error < 1e-6 ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
