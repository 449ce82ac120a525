// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Craig-Bampton of one large part by cutting it into substructures: automated multilevel
/// substructuring, J. K. Bennighof and R. B. Lehoucq, SIAM J. Sci. Comput. 25 (2004) 2084-2106.
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "reduction/CollectiveMethod.hpp"
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/multilevel/TreeModes.hpp"
#include "reduction/multilevel/TreeStatics.hpp"

namespace tooljoint::reduction {

namespace {

/// Dofs of a substructure if the deck does not give their number.
constexpr int dofsOfAPart = 8000;

/// Node number of every interior dof; a coordinate without a node forms its own group.
std::vector<int> nodesOf(const PartView& part) {
  std::map<std::int64_t, int> numbers;
  std::vector<int> groups;
  int next = 0;
  for (int position : part.partition().interior) {
    const auto& label = part.model().dofs[at(position)];
    if (label.kind != model::DofLabel::Kind::Physical) {
      groups.push_back(next++);
      continue;
    }
    const auto [node, isNew] = numbers.emplace(label.entity, next);
    if (isNew) ++next;
    groups.push_back(node->second);
  }
  return groups;
}

class Multilevel : public CollectiveMethod {
 public:
  explicit Multilevel(const Teuchos::ParameterList& list) : parts_(list.get<int>("Parts")) {
    options_.cutOffFactor = list.get<double>("Cut-off Factor");
    options_.accuracy = list.get<double>("Accuracy");
    options_.corrections = list.get<int>("Corrections");
  }

  MethodTraits traits() const override { return {true, false, false, true}; }

  Basis build(const PartView& part, const ModeRequest& request) const override {
    Basis basis;
    basis.partition = part.partition();
    basis.orthonormal = true;
    const int interior = sizeOf(basis.partition.interior);
    if (interior == 0) {
      const auto& constraint = part.constraintModes();
      addConstraintRows(part, basis.partition, constraint.residuals, basis);
      setVectors(basis.partition, constraint.vectors, {}, basis);
      basis.complete = true;
      return basis;
    }
    const Sparse &K = part.symmetricInteriorStiffness(), &M = part.interiorMass();
    requireMass(part, M);
    const auto factor = eliminated(part, K, M);
    const ConstraintModes constraint =
        part.symmetric() ? treeConstraintModes(part, *factor) : part.constraintModes();
    const InteriorVectors vectors = modesOf(part, request, *factor);
    addConstraintRows(part, basis.partition, constraint.residuals, basis);
    setVectors(basis.partition, constraint.vectors, vectors, basis);
    report(vectors, basis);
    basis.removable = true;
    basis.orthogonality = vectors.orthogonality;
    return basis;
  }

 private:
  static void requireMass(const PartView& part, const Sparse& M) {
    const Vector diagonal = M.diagonal();
    Eigen::Index least = 0;
    if (diagonal.minCoeff(&least) < 0.0)
      throw ModelError(part.who() +
                       "its mass matrix must be positive semi-definite, and it is not at " +
                       part.dofName(part.partition().interior[at(least)]) + ".");
  }

  std::shared_ptr<const TreeFactor> eliminated(const PartView& part, const Sparse& K,
                                               const Sparse& M) const {
    const int automatic = (sizeOf(part.partition().interior) + dofsOfAPart / 2) / dofsOfAPart;
    const int parts = parts_ > 0 ? parts_ : std::max(1, automatic);
    const auto tree =
        std::make_shared<const SubstructureTree>(cutIntoTree(K, M, nodesOf(part), parts));
    try {
      return eliminate(tree, K, M);
    } catch (const ModelError& error) {
      throw ModelError(part.who() + error.what() + ".");
    }
  }

  InteriorVectors modesOf(const PartView& part, const ModeRequest& request,
                          const TreeFactor& factor) const {
    InteriorVectors vectors;
    vectors.groups = {part.partition().interior};
    vectors.removable = true;
    if (request.kind == ModeRequest::Kind::Count && request.count == 0) {
      vectors.method = "none requested";
      return vectors;
    }
    const Sparse &K = part.symmetricInteriorStiffness(), &M = part.interiorMass();
    const TreeModes modes = treeModes(K, M, factor, request, options_);
    if (modes.values.size() == 0) {
      vectors.method =
          modes.complete ? "no dof of the interior has mass" : "no mode below the cut-off";
      vectors.complete = modes.complete;
      return vectors;
    }
    linalg::EigenPairs pairs;
    pairs.values = modes.values;
    pairs.vectors = modes.vectors;
    linalg::applyConventions(pairs, M);
    linalg::recomputeErrors(pairs, K, M, 1.0, 1e-8);
    const auto floating = linalg::areRounding(pairs.values, pairs.vectors, K);
    for (int k = 0; k < pairs.count(); ++k) {
      ModalVector mode{pairs.values[k], 0, pairs.vectors.col(k), pairs.residuals[k],
                       "fixed-interface"};
      mode.floating = floating[at(k)] != 0;
      mode.why = fmt::format("requested; estimated error {:.1e}", modes.errors[k]);
      if (mode.floating) mode.why = "requested; rigid-body motion";
      if (mode.shown() < 0.0)
        mode.why = "requested; the part is buckled with its boundary dofs fixed";
      vectors.vectors.push_back(std::move(mode));
    }
    vectors.orthogonality = pairs.orthogonality;
    vectors.complete = modes.complete;
    vectors.keepAll();
    vectors.kept = roundUp(vectors.eigenvalues(), modes.wanted, request.pairTolerance);
    for (int k = 0; k < sizeOf(vectors.vectors); ++k)
      vectors.vectors[at(k)].name = "mode " + std::to_string(k + 1);
    vectors.remarkOnCount(request, sizeOf(part.partition().interior));
    describe(modes, factor, vectors);
    return vectors;
  }

  void describe(const TreeModes& modes, const TreeFactor& factor, InteriorVectors& vectors) const {
    const double worst = vectors.kept > 0 ? modes.errors.head(vectors.kept).maxCoeff() : 0.0;
    const auto& tree = factor.tree();
    vectors.method = fmt::format(
        "{} substructures, {} dofs between them, {} coordinates{}, {} correction{}: estimated "
        "error of the frequencies {:.1e}",
        tree.leaves(), tree.separatorDofs(), modes.coordinates,
        std::isinf(modes.cutOff) ? ""
                                 : fmt::format(" up to {:.4g} Hz", modes.cutOff / constants::twoPi),
        modes.corrections, modes.corrections == 1 ? "" : "s", worst);
    if (worst > options_.accuracy)
      vectors.remarks.push_back(fmt::format(
          "the estimated error of its modes is {:.1e}, more than Accuracy = {:.1e}: allow more "
          "Corrections or a larger Cut-off Factor",
          worst, options_.accuracy));
  }

  int parts_;
  TreeModesOptions options_;
};

deck::ListSpec multilevelParameters() {
  using deck::Range;
  deck::ListSpec list("Multilevel", "How a part is cut into substructures, and their modes.");
  list.integer("Parts", 0, Range::atLeast(0),
               "Number of substructures of each part; 0: one for every 8000 dofs. A graph that "
               "cannot be cut so often has fewer.");
  list.real("Cut-off Factor", "", 2.5, Range::atLeast(1.0),
            "Substructures and the separators between them have their modes up to so many times "
            "the highest frequency wanted.")
      .expert();
  list.real("Accuracy", "", 1e-4, Range::positive(),
            "Estimated relative error of the frequencies of the modes above which they are "
            "corrected.")
      .expert();
  list.integer("Corrections", 3, Range::atLeast(0),
               "Corrections at most: each is a Rayleigh-Ritz step on the modes and their static "
               "responses to the residuals, and about squares the errors.")
      .expert();
  return list;
}

const bool multilevelRegistered = addMethod<Multilevel>(
    "Multilevel",
    "Craig-Bampton of one large part, cut into substructures by nested dissection (Scotch): "
    "constraint modes and fixed-interface modes from the modes of substructures and separators "
    "(Bennighof and Lehoucq 2004), with error estimates. All ranks work on each part.",
    multilevelParameters());

}  // namespace

}  // namespace tooljoint::reduction
