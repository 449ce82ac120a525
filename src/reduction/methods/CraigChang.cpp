// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free-interface modes and residual attachment modes as component modes: R. R. Craig Jr., C.-J.
/// Chang, Free-interface methods of substructure coupling for dynamic analysis, AIAA Journal 14
/// (1976) 1633-1635; On the use of attachment modes in substructure coupling for dynamic analysis,
/// AIAA/ASME 18th SDM Conference (1977) B, 89-99. In physical interface coordinates as Martinez et
/// al. (1984).
#include <utility>

#include "reduction/methods/FreeInterfaceBasis.hpp"

namespace tooljoint::reduction {

namespace {

/// D = Psi Psi_b^-1 (u_b - Phi_b p) + Phi p, everything projected: the same space as Rubin's; the
/// modal coordinates are the amplitudes of the free-interface modes.
class CraigChang : public ReductionMethod {
 public:
  Basis build(const PartView& part, const ModeRequest& request) const override {
    FreeInterfaceBasis free = freeInterfaceBasis(part, request);
    toModeAmplitudes(part, free);
    return std::move(free.basis);
  }
};

const bool craigChangRegistered =
    addMethod<CraigChang>("Craig-Chang",
                          "Free-interface modes and residual attachment modes (Craig and Chang "
                          "1976, 1977): the space of \"Rubin\", with the amplitudes of the "
                          "free-interface modes as coordinates in addition to the interface dofs.");

}  // namespace

}  // namespace tooljoint::reduction
