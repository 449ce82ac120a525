// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and Krylov vectors of the interior driven by the boundary dofs.
#include <Teuchos_ParameterList.hpp>

#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/KrylovVectors.hpp"

namespace tooljoint::reduction {

namespace {

class Krylov : public ReductionMethod {
 public:
  explicit Krylov(const Teuchos::ParameterList& list)
      : options_{list.get<double>("Expansion Frequency"), list.get<bool>("Damped"),
                 list.get<double>("Time")} {}

  Basis build(const PartView& part, const ModeRequest& request) const override {
    return fixedInterfaceBasis(part, krylovVectors(part, request, options_));
  }

 private:
  KrylovOptions options_;
};

deck::ListSpec krylovParameters() {
  using deck::Range;
  deck::ListSpec list("Krylov",
                      "Vectors that match moments of the response of the interior to motions of "
                      "the boundary dofs.");
  list.removed({"Deflation"}, "the part of a vector that must be new is a constant. Leave it out.");
  list.real("Expansion Frequency", "Hz", 0.0, Range::nonNegative(),
            "Expansion point of the moments: this frequency, or with \"Damped\" s = 2 pi times "
            "this on the real axis. Use the middle of the frequency band of interest; 0 gives "
            "quasi-static vectors.")
      .expert();
  list.boolean("Damped", false,
               "Second-order Krylov vectors of mass, damping and stiffness (Bai and Su 2005) "
               "instead of those of mass and stiffness alone.")
      .expert();
  list.real("Time", "s", 0.0, Range::any(),
            "Time at which varying damping, such as gyroscopic terms, is evaluated; used with "
            "\"Damped\".");
  return list;
}

const bool krylovRegistered = addMethod<Krylov>(
    "Krylov",
    "Constraint modes and Krylov vectors that match moments of the interior at one frequency "
    "(Shyu, Ma and Hulbert 1997; Bai and Su 2005).",
    krylovParameters());

}  // namespace

}  // namespace tooljoint::reduction
