// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes, inertia-relief modes and modes of any support: D. N. Herting, A general
/// purpose, multi-stage, component modal synthesis method, Finite Elements in Analysis and Design 1
/// (1985) 153-164.
#include <Teuchos_ParameterList.hpp>

#include "reduction/vectors/FixedInterfaceModes.hpp"
#include "reduction/vectors/RitzModes.hpp"

namespace tooljoint::reduction {

namespace {

/// D = phi_C u_b + phi_R a + (phi - phi_C phi_b) xi,   phi_R = K_II^-1 (M Phi_r)_I  for the
/// rigid-body modes Phi_r.
class Herting : public ReductionMethod {
 public:
  Herting(bool fixed, bool inertiaRelief) : fixed_(fixed), inertiaRelief_(inertiaRelief) {}

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    Basis basis;
    basis.partition = partition(part);
    const Partition& p = basis.partition;
    const Sparse K = constantStiffness(part.model);
    ModeRequest rigidOnly = request;
    if (fixed_) {
      rigidOnly.kind = ModeRequest::Kind::Count;
      rigidOnly.count = 0;
    }
    const FreeInterfaceModes free = freeInterfaceModes(part, K, rigidOnly);
    const InteriorStatics statics(part, p, K, free);
    const ConstraintModes constraint = statics.constraintModes();
    addConstraintRows(part, constraint, basis);
    std::vector<VectorGroup> groups =
        freeInterfaceVectors(part, K, p, free, statics, inertiaRelief_, !fixed_);
    if (fixed_)
      addFixed(fixedInterfaceModes(part, p, symmetricPart(K), request), free, groups, basis);
    else
      report(free, basis);
    if (inertiaRelief_ && free.rigid > 0) addInertiaRelief(free, basis);
    completeWithRitzModes(part, symmetricPart(K), constraint, groups,
                          fixed_ ? "fixed-interface" : "free-interface", basis);
    return basis;
  }

 private:
  /// Fixed-interface modes beside the inertia-relief vectors of their free link.
  static void addFixed(const FixedInterfaceModes& fixed, const FreeInterfaceModes& free,
                       std::vector<VectorGroup>& groups, Basis& basis) {
    const Partition& p = basis.partition;
    std::vector<int> groupOf(static_cast<std::size_t>(p.size), 0),
        rowOf(static_cast<std::size_t>(p.size), -1);
    for (std::size_t g = 0; g < free.links.size(); ++g)
      for (int i : free.links[g]) groupOf[static_cast<std::size_t>(i)] = static_cast<int>(g);
    for (const auto& group : groups)
      for (std::size_t i = 0; i < group.positions.size(); ++i)
        rowOf[static_cast<std::size_t>(group.positions[i])] = static_cast<int>(i);
    basis.candidates.resize(static_cast<Eigen::Index>(fixed.modes.size()));
    for (int k = 0; k < static_cast<int>(fixed.modes.size()); ++k) {
      const FixedInterfaceMode& mode = fixed.modes[static_cast<std::size_t>(k)];
      basis.candidates[k] = mode.eigenvalue;
      basis.rows.push_back({"fixed-interface", "mode " + std::to_string(k + 1), mode.eigenvalue,
                            mode.residual, k < fixed.kept,
                            k < fixed.kept ? "asked for" : "above the cut"});
      if (k >= fixed.kept) continue;
      const auto& link = p.links[static_cast<std::size_t>(mode.link)];
      const int first = p.interior[static_cast<std::size_t>(link.front())];
      VectorGroup& group =
          groups[static_cast<std::size_t>(groupOf[static_cast<std::size_t>(first)])];
      Vector shape = Vector::Zero(static_cast<Eigen::Index>(group.positions.size()));
      for (std::size_t i = 0; i < link.size(); ++i)
        shape[rowOf[static_cast<std::size_t>(p.interior[static_cast<std::size_t>(link[i])])]] =
            mode.shape[static_cast<Eigen::Index>(i)];
      group.columns.conservativeResize(shape.size(), group.columns.cols() + 1);
      group.columns.rightCols(1) = shape;
    }
    basis.complete = fixed.complete;
    basis.method = fixed.method;
    basis.remarks = fixed.remarks;
  }

  static void addInertiaRelief(const FreeInterfaceModes& free, Basis& basis) {
    for (const auto& mode : free.modes) {
      if (!mode.rigid) continue;
      BasisRow row;
      row.kind = "inertia-relief";
      row.name = "of a rigid-body mode";
      row.eigenvalue = 0;
      row.residual = mode.residual;
      row.why = "static answer to rigid-body acceleration";
      basis.rows.push_back(row);
    }
  }

  bool fixed_;
  bool inertiaRelief_;
};

deck::ListSpec parameters() {
  deck::ListSpec list("Herting", "Which modes go with the constraint modes.");
  list.choice("Mode Supports", std::string("Free"), {"Free", "Fixed"},
              "Support of interface and retained dofs while the modes are computed: with \"Free\" "
              "and inertia relief the space is that of \"Rubin\", with \"Fixed\" and "
              "without it that of \"Craig-Bampton\".")
      .expert()
      .formerly("Modes with Interface");
  list.boolean("Inertia Relief", true,
               "Add the static answer, kept dofs held, to the inertia of every rigid-body mode of "
               "the free part; those of \"Fixed\" come in addition to the number of modes.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "Herting",
    {"Constraint modes, inertia-relief modes and free- or fixed-interface modes (Herting 1985).",
     parameters(), [](const Teuchos::ParameterList& list) {
       const bool fixed =
           list.isParameter("Mode Supports") && list.get<std::string>("Mode Supports") == "Fixed";
       const bool relief = !list.isParameter("Inertia Relief") || list.get<bool>("Inertia Relief");
       return std::unique_ptr<ReductionMethod>(new Herting(fixed, relief));
     }});

}  // namespace

}  // namespace tooljoint::reduction
