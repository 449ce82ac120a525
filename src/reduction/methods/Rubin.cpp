// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Free-interface modes with residual flexibility and residual mass: S. Rubin, Improved
/// component-mode representation for structural dynamic analysis, AIAA Journal 13 (1975) 995-1006;
/// with physical interface coordinates as D. R. Martinez, T. G. Carne, D. L. Gregory, A. K. Miller,
/// Combined experimental/analytical modeling using component mode synthesis, AIAA/ASME 25th SDM
/// Conference (1984), paper 84-0941.

#include "reduction/methods/FreeInterfaceBasis.hpp"

namespace tooljoint::reduction {

namespace {

class Rubin : public ReductionMethod {
 public:
  Basis build(const PartView& part, const ModeRequest& request) const override {
    return freeInterfaceBasis(part, request).basis;
  }
};

const bool rubinRegistered = addMethod<Rubin>(
    "Rubin",
    "Free-interface modes, rigid-body ones always among them, with the residual flexibility and "
    "residual mass of all others (Rubin 1975); interface dofs stay coordinates (Martinez et al. "
    "1984).");

}  // namespace

}  // namespace tooljoint::reduction
