// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A basis of your own, named in scene.xml: constraint modes and a random subspace of the interior,
/// moved towards its low modes by inverse iteration X <- K_II^-1 M_II X (Halko, Martinsson, Tropp,
/// SIAM Rev. 53 (2011) 217-288).
#include <Tpetra_Core.hpp>
#include <cstdio>
#include <tooljoint/linalg/Deterministic.hpp>
#include <tooljoint/reduction/methods/BasisBuilder.hpp>
#include <tooljoint/run.hpp>
using namespace tooljoint;
using namespace tooljoint::reduction;

struct RandomSubspace : ReductionMethod {
  int steps;
  explicit RandomSubspace(const Teuchos::ParameterList& list) : steps(list.get<int>("Steps")) {}
  Basis build(const PartView& part, const ModeRequest& request) const override {
    const Sparse& M = part.interiorMass();
    Matrix X = linalg::scatteredNumbers(M.rows(), request.count + 4, 1);
    for (int step = 0; step < steps; ++step) X = part.solveInterior(M * X);
    return subspaceBasis(part, X, request.count, "random");
  }
};
const bool registered = addMethod<RandomSubspace>(
    "Random Subspace",
    "Constraint modes and a random subspace of the interior (Halko et al. 2011).",
    deck::ListSpec("Random Subspace", "")
        .integer("Steps", 2, deck::Range::atLeast(1), "Inverse steps towards low modes."));

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    const auto error = runDeck(SCENE).number("reduction.estimate.frequency_error");
    return error < 1e-3 ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
