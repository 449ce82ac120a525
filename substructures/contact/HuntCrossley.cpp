// SPDX-License-Identifier: BSD-3-Clause
// Hunt and Crossley, J. Appl. Mech. 42 (1975): the damping grows with the penetration, so the force
// starts and ends at zero.
#include <Teuchos_ParameterList.hpp>

#include "substructures/contact/LawKernel.hpp"

namespace tooljoint::contact {
namespace {

/// model::HuntCrossley without a transition. No regularisation.
class HuntCrossleyKernel {
 public:
  explicit HuntCrossleyKernel(double exponent = 1.0, double dissipation = 0.0)
      : law_(exponent, dissipation) {}

  void prepare(const ContactPoints& points) { k_ = points.stiffness; }

  double forceOnly(std::size_t i, double G, double rate) const {
    return law_.forceOnly(k_[i], G, rate);
  }
  NormalForce force(std::size_t i, double G, double rate) const {
    return law_.force(k_[i], G, rate);
  }
  double elastic(std::size_t i, double G, double, double& dG) const {
    return law_.elastic(k_[i], G, dG);
  }
  double pull(std::size_t, double) const { return 0.0; }
  double energy(std::size_t i, double G) const { return law_.energy(k_[i], G); }
  double skin(std::size_t) const { return law_.reach(); }

 private:
  model::HuntCrossley law_;
  std::vector<double> k_;
};

const bool huntCrossleyRegistered = LawRegistry::instance().add(
    "Hunt-Crossley",
    {"Power-law spring whose damping grows with the penetration (Hunt and Crossley 1975); Damping "
     "and the "
     "regularisations are not used.",
     deck::ListSpec("Hunt-Crossley", "Force k G^n (1 + chi dG/dt), only while it pushes.")
         .real("Exponent", "", 1.0, deck::Range::between(1.0, 3.0),
               "n; above 1 the Stiffness k is in N/m^n.")
         .expert()
         .real("Dissipation", "s/m", 0.0, deck::Range::nonNegative(),
               "chi; a body hitting the wall at v comes back with about (1 - 2 chi v/3) v.")
         .expert(),
     [](const Teuchos::ParameterList& list) {
       return std::make_unique<ContactLawOf<HuntCrossleyKernel>>(
           HuntCrossleyKernel(list.get<double>("Exponent"), list.get<double>("Dissipation")));
     }});

}  // namespace
}  // namespace tooljoint::contact
