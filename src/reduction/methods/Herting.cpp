// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes, inertia-relief modes and modes of any support: D. N. Herting, A general
/// purpose, multi-stage, component modal synthesis method, Finite Elements in Analysis and Design 1
/// (1985) 153-164.
#include <Teuchos_ParameterList.hpp>

#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"
#include "reduction/vectors/FreeInterfaceModes.hpp"
#include "reduction/vectors/RitzModes.hpp"

namespace tooljoint::reduction {

namespace {

/// D = phi_C u_b + phi_R a + (phi - phi_C phi_b) xi,   phi_R = K_II^-1 (M Phi_r)_I  for the
/// rigid-body modes Phi_r.
class Herting : public ReductionMethod {
 public:
  explicit Herting(const Teuchos::ParameterList& list)
      : fixed_(list.get<std::string>("Mode Supports") == "Fixed"),
        inertiaRelief_(list.get<bool>("Inertia Relief")) {}

  Basis build(const PartView& part, const ModeRequest& request) const override {
    Basis basis;
    ModeRequest rigidOnly = request;
    if (fixed_) {
      rigidOnly.kind = ModeRequest::Kind::Count;
      rigidOnly.count = 0;
    }
    const InteriorVectors free = freeInterfaceModes(part, rigidOnly);
    const InteriorStatics statics(part, free);
    const ConstraintModes constraint = statics.constraintModes();
    addConstraintRows(part, part.partition(), constraint.residuals, basis);
    auto groups = freeInterfaceVectors(part, free, statics, inertiaRelief_, !fixed_);
    if (fixed_) {
      const InteriorVectors fixed = fixedInterfaceModes(part, request);
      addTo(groups, fixed, part.model().size());
      report(fixed, basis);
    } else {
      report(free, basis);
    }
    if (inertiaRelief_) addInertiaRelief(free, basis);
    completeWithRitzModes(part, constraint, groups, fixed_ ? "fixed-interface" : "free-interface",
                          basis);
    return basis;
  }

 private:
  /// Adds fixed-interface modes to the inertia-relief vectors of their free block.
  static void addTo(std::vector<VectorGroup>& groups, const InteriorVectors& fixed, int size) {
    for (int k = 0; k < fixed.kept; ++k) {
      const int first = fixed.groups[at(fixed.vectors[at(k)].group)].front();
      for (auto& group : groups) {
        if (!contains(group.positions, first)) continue;
        group.columns.conservativeResize(sizeOf(group.positions), group.columns.cols() + 1);
        group.columns.rightCols(1) = fixed.columns({k}, size)(group.positions, Eigen::all);
      }
    }
  }

  static void addInertiaRelief(const InteriorVectors& free, Basis& basis) {
    for (const auto& mode : free.vectors)
      if (mode.rigid)
        basis.rows.push_back({"inertia-relief", "of a rigid-body mode", 0, mode.residual, true,
                              "static response to rigid-body acceleration"});
  }

  bool fixed_;
  bool inertiaRelief_;
};

deck::ListSpec hertingParameters() {
  deck::ListSpec list("Herting", "Modes in addition to the constraint modes.");
  list.choice("Mode Supports", std::string("Free"), {"Free", "Fixed"},
              "Support of interface and retained dofs while the modes are computed: with \"Free\" "
              "and inertia relief the space is that of \"Rubin\", with \"Fixed\" and "
              "without it that of \"Craig-Bampton\".")
      .expert()
      .formerly("Modes with Interface");
  list.boolean(
          "Inertia Relief", true,
          "Add the static response, with boundary dofs fixed, to the inertia of every rigid-body "
          "mode of the free part; with \"Fixed\" these are additional to the number of modes.")
      .expert();
  return list;
}

const bool hertingRegistered = addMethod<Herting>(
    "Herting",
    "Constraint modes, inertia-relief modes and free- or fixed-interface modes (Herting 1985).",
    hertingParameters());

}  // namespace

}  // namespace tooljoint::reduction
