// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free-interface modes with residual flexibility but no residual mass: R. H. MacNeal, A hybrid
/// method of component mode synthesis, Computers and Structures 1 (1971) 581-601.
#include <utility>

#include "reduction/methods/FreeInterfaceBasis.hpp"

namespace tooljoint::reduction {

namespace {

/// The coordinates of Craig and Chang; inertia and damping act on Phi p only:
///
///     M = [0 .; . I],   K = [G^-1  -G^-1 Phi_b; .  Lambda + Phi_b' G^-1 Phi_b]
///
/// with the residual flexibility G = Psi_b, for symmetric parts; in general C = [0 .; . Phi' C Phi]
/// and K is projected completely.
class MacNeal : public ReductionMethod {
 public:
  MethodTraits traits() const override { return {false, false, false, false}; }

  Basis build(const PartView& part, const ModeRequest& request) const override {
    FreeInterfaceBasis free = freeInterfaceBasis(part, request);
    const Matrix amplitudes = toModeAmplitudes(part, free);
    const Sparse shapes = Matrix(free.shapes).sparseView(), p = amplitudes.sparseView();
    free.basis.inertial = shapes * p;
    return std::move(free.basis);
  }
};

const bool macNealRegistered = addMethod<MacNeal>(
    "MacNeal",
    "Free-interface modes with the residual flexibility of all others, but not their mass and "
    "damping (MacNeal 1971). The mass is singular, so only implicit integrators can run it.");

}  // namespace

}  // namespace tooljoint::reduction
