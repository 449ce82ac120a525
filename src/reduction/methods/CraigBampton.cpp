// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and fixed-interface modes: M. C. C. Bampton, R. R. Craig Jr., Coupling of
/// substructures for dynamic analyses, AIAA Journal 6 (1968) 1313-1319; Nguyen et al. 2020,
/// (32)-(37). Without modes it is Guyan's static condensation.
#include "reduction/methods/ReductionMethod.hpp"
#include "reduction/part/ConstraintModes.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"

namespace tooljoint::reduction {

namespace {

class CraigBampton : public ReductionMethod {
 public:
  MethodTraits traits() const override { return {true, false, false, true}; }

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    Basis basis;
    basis.partition = partition(part);
    basis.orthonormal = true;
    const Partition& p = basis.partition;
    const Sparse K = constantStiffness(part.model);

    ConstraintModes constraint = constraintModes(part, p, K);
    const FixedInterfaceModes normal = fixedInterfaceModes(part, p, symmetricPart(K), request);

    addConstraintRows(part, constraint, basis);
    addModes(normal, constraint.entries, basis);
    // Phi = [I 0; phi_C phi_D]
    basis.vectors = Sparse(p.size, static_cast<Eigen::Index>(p.kept.size()) + normal.kept);
    basis.vectors.setFromTriplets(constraint.entries.begin(), constraint.entries.end());
    return basis;
  }

 private:
  static void addConstraintRows(const model::Substructure& part, const ConstraintModes& constraint,
                                Basis& basis) {
    for (std::size_t j = 0; j < basis.partition.kept.size(); ++j) {
      BasisRow row;
      row.kind = "constraint";
      row.name = model::describe(part.model.dofs[static_cast<std::size_t>(basis.partition.kept[j])],
                                 part.model.componentNames);
      row.residual = constraint.residuals[static_cast<Eigen::Index>(j)];
      row.why = j < basis.partition.interface.size() ? "interface dof" : "retained dof";
      basis.rows.push_back(row);
    }
  }

  static void addModes(const FixedInterfaceModes& normal, Triplets& entries, Basis& basis) {
    const Partition& p = basis.partition;
    const auto keptColumns = static_cast<int>(p.kept.size());
    basis.eigenvalues.resize(normal.kept);
    basis.candidates.resize(static_cast<Eigen::Index>(normal.modes.size()));
    for (int k = 0; k < static_cast<int>(normal.modes.size()); ++k) {
      const FixedInterfaceMode& mode = normal.modes[static_cast<std::size_t>(k)];
      BasisRow row;
      row.kind = "fixed-interface";
      row.name = "mode " + std::to_string(k + 1);
      row.eigenvalue = mode.shown();
      row.residual = mode.residual;
      row.kept = k < normal.kept;
      row.why = !row.kept        ? "above the cut"
                : mode.floating  ? "asked for; rigid-body motion"
                : mode.buckled() ? "asked for; the part is buckled between its kept dofs"
                                 : "asked for";
      basis.rows.push_back(row);
      basis.candidates[k] = mode.eigenvalue;
      if (!row.kept) continue;
      basis.eigenvalues[k] = mode.eigenvalue;
      basis.modeKind.push_back(row.kind);
      const auto& link = p.links[static_cast<std::size_t>(mode.link)];
      for (std::size_t i = 0; i < link.size(); ++i) {
        const double value = mode.shape[static_cast<Eigen::Index>(i)];
        if (value != 0.0)
          entries.emplace_back(p.interior[static_cast<std::size_t>(link[i])], keptColumns + k,
                               value);
      }
    }
    basis.complete = normal.complete;
    basis.orthogonality = normal.orthogonality;
    basis.method = normal.method;
    basis.remarks = normal.remarks;
  }
};

const bool registered = MethodRegistry::instance().add(
    "Craig-Bampton",
    {"Constraint modes and fixed-interface modes (Bampton and Craig 1968); with 0 modes, static "
     "condensation (Guyan 1965).",
     deck::ListSpec("Craig-Bampton", "Craig-Bampton has no parameters of its own."),
     [](const Teuchos::ParameterList&) {
       return std::unique_ptr<ReductionMethod>(new CraigBampton);
     }});

}  // namespace

}  // namespace tooljoint::reduction
