// SPDX-License-Identifier: BSD-3-Clause
// A basis outside of the library: one file, compiled by itself, named in decks.
#include <Eigen/QR>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <tooljoint/common/Error.hpp>
#include <tooljoint/linalg/Deterministic.hpp>
#include <tooljoint/reduction/methods/BasisBuilder.hpp>

using namespace tooljoint;
using namespace tooljoint::reduction;

/// Constraint modes and a subspace of the interior that converges by inverse iteration X <- K_II^-1
/// M_II X to the lowest fixed-interface modes (Bathe and Wilson 1973): in the limit the span of
/// Craig-Bampton.
class InverseSubspace final : public ReductionMethod {
 public:
  explicit InverseSubspace(const Teuchos::ParameterList& own) : steps_(own.get<int>("Steps")) {}

  Basis build(const PartView& part, const ModeRequest& request) const override {
    if (request.kind != ModeRequest::Kind::Count)
      throw DeckError("The basis \"Inverse Subspace\" needs a number of modes: give \"Modes\".");
    const Sparse& M = part.interiorMass();
    const Eigen::Index columns = std::min<Eigen::Index>(2 * request.count + 8, M.rows());
    Matrix X = linalg::scatteredNumbers(M.rows(), columns, 1);
    for (int step = 0; step < steps_; ++step) {
      X = part.solveInterior(M * X);
      X = Matrix(X.householderQr().householderQ() * Matrix::Identity(X.rows(), X.cols()));
    }
    return subspaceBasis(part, X, request.count, "subspace");
  }

 private:
  int steps_;
};

const bool registered = addMethod<InverseSubspace>(
    "Inverse Subspace", "Constraint modes and an iterated subspace (Bathe and Wilson 1973).",
    deck::ListSpec("Inverse Subspace", "")
        .integer("Steps", 4, deck::Range::atLeast(0), "Inverse steps."));
