// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A basis of your own, registered under a name and taken by a deck. Here: constraint modes and a
/// random subspace of the interior, drawn towards its low modes by a few inverse steps X <- K_II^-1
/// M_II X (N. Halko, P. G. Martinsson, J. A. Tropp, SIAM Rev. 53 (2011) 217-288).
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>
#include <cstdio>
#include <tooljoint/common/Constants.hpp>
#include <tooljoint/common/Parallel.hpp>
#include <tooljoint/coupling/CoupledModes.hpp>
#include <tooljoint/coupling/Synthesis.hpp>
#include <tooljoint/deck/Deck.hpp>
#include <tooljoint/linalg/Deterministic.hpp>
#include <tooljoint/parts/PartsScene.hpp>
#include <tooljoint/reduction/ReductionParameters.hpp>
#include <tooljoint/reduction/methods/BasisBuilder.hpp>
#include <tooljoint/reduction/vectors/ModalVectors.hpp>

namespace {

using namespace tooljoint;
using namespace tooljoint::reduction;
class RandomSubspace : public ReductionMethod {
 public:
  explicit RandomSubspace(const Teuchos::ParameterList& list) : steps_(list.get<int>("Steps")) {}
  Basis build(const PartView& part, const ModeRequest& request) const override {
    if (request.kind != ModeRequest::Kind::Count)
      throw DeckError("The basis \"Random Subspace\" needs a number of modes: give \"Modes\".");
    const Sparse& M = part.interiorMass();
    Matrix X =
        linalg::scatteredNumbers(M.rows(), std::min<Eigen::Index>(request.count + 4, M.rows()), 1);
    for (int step = 0; step < steps_; ++step) X = part.solveInterior(M * X);
    OrthonormalSet set(M, 1e-10, part.who());
    for (Eigen::Index j = 0; j < X.cols(); ++j) set.add(X.col(j));
    InteriorVectors vectors;
    vectors.groups = {part.partition().interior};
    addRitzVectors(part.symmetricInteriorStiffness(), M, set.basis(), 0, "random", vectors);
    vectors.kept = std::min(request.count, sizeOf(vectors.vectors));
    return fixedInterfaceBasis(part, vectors);
  }

 private:
  int steps_;
};
const bool registered = addMethod<RandomSubspace>(
    "Random Subspace",
    "Constraint modes and a random subspace of the interior (Halko, Martinsson and Tropp 2011).",
    deck::ListSpec("Random Subspace", "")
        .integer("Steps", 2, deck::Range::atLeast(1),
                 "Inverse steps that draw the vectors towards low modes."));

int run(const std::string& file) {
  deck::ListSpec spec("Scene", "Parts from files, reduced.");
  spec.requiredList(parts::parameters());
  spec.requiredList(reduction::parameters());
  const auto deck = deck::Deck::read(file, spec);
  const auto scene = parts::buildScene(parts::readSettings(deck.list().sublist("Parts")), {},
                                       [&](const std::string& name) { return deck.resolve(name); });
  const auto mine =
      coupling::synthesise(scene.parts, deck.list().sublist("Reduction"), scene.coupling);
  const auto whole = coupling::coupleWithPositions(scene.parts, scene.coupling);
  const auto full = coupling::lowestModes(whole.model, 8),
             small = coupling::lowestModes(mine.coupled.model, 8);
  bool near = registered;
  for (int k = 0; k < 8; ++k) {
    const double hertz = std::sqrt(full.values[k]) / constants::twoPi,
                 error = std::sqrt(small.values[k] / full.values[k]) - 1;
    if (parallel::rank() == 0) std::printf("mode %d: %9.4f Hz, error %+.1e\n", k + 1, hertz, error);
    near =
        near && error > -1e-7 && error < 1e-3;  // Rayleigh and Ritz: from above, but for rounding
  }
  return near ? 0 : 1;
}
}  // namespace
int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    return run(argc > 1 ? argv[1] : SCENE);
  } catch (const tooljoint::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
