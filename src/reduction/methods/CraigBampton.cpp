// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and fixed-interface modes: M. C. C. Bampton, R. R. Craig Jr., Coupling of
/// substructures for dynamic analyses, AIAA Journal 6 (1968) 1313-1319; Nguyen et al. 2020,
/// (32)-(37). Without modes it is Guyan's static condensation.
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"

namespace tooljoint::reduction {

namespace {

class CraigBampton : public ReductionMethod {
 public:
  MethodTraits traits() const override { return {true, false, false, true}; }

  Basis build(const PartView& part, const ModeRequest& request) const override {
    return fixedInterfaceBasis(part, fixedInterfaceModes(part, request));
  }
};

const bool craigBamptonRegistered = addMethod<CraigBampton>(
    "Craig-Bampton",
    "Constraint modes and fixed-interface modes (Bampton and Craig 1968); with 0 modes, static "
    "condensation (Guyan 1965).");

}  // namespace

}  // namespace tooljoint::reduction
