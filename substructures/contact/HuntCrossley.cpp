// SPDX-License-Identifier: BSD-3-Clause
// Hunt and Crossley, J. Appl. Mech. 42 (1975): the damping grows with the penetration, so the force
// starts and ends at zero.
#include <Teuchos_ParameterList.hpp>
#include <algorithm>

#include "substructures/contact/LawKernel.hpp"

namespace tooljoint::contact {
namespace {

/// F_n = k G^n (1 + chi G') for G > 0, never negative, zero for G <= 0. No regularisation.
class HuntCrossleyKernel {
 public:
  explicit HuntCrossleyKernel(double exponent = 1.0, double dissipation = 0.0)
      : n_(exponent), chi_(dissipation) {}

  void prepare(const ContactPoints& points) { k_ = points.stiffness; }

  double forceOnly(std::size_t i, double G, double rate) const {
    if (G <= 0.0) return 0.0;
    return std::max(0.0, k_[i] * G * power(G) * (1.0 + chi_ * rate));
  }

  NormalForce force(std::size_t i, double G, double rate) const {
    const double loss = 1.0 + chi_ * rate;
    if (G <= 0.0 || loss <= 0.0) return {};
    const double slope = k_[i] * power(G);
    return {slope * G * loss, n_ * slope * loss, slope * G * chi_};
  }

  double elastic(std::size_t i, double G, double, double& dG) const {
    dG = 0.0;
    if (G <= 0.0) return 0.0;
    const double slope = k_[i] * power(G);
    dG = n_ * slope;
    return slope * G;
  }

  double pull(std::size_t, double) const { return 0.0; }

  double energy(std::size_t i, double G) const {
    return G <= 0.0 ? 0.0 : k_[i] * G * G * power(G) / (n_ + 1.0);
  }

  double skin(std::size_t) const { return 0.0; }

 private:
  /// G^(n-1)
  double power(double G) const {
    if (n_ == 1.0) return 1.0;
    return n_ == 1.5 ? std::sqrt(G) : std::pow(G, n_ - 1.0);
  }

  double n_;
  double chi_;
  std::vector<double> k_;
};

const bool registered = LawRegistry::instance().add(
    "Hunt-Crossley",
    {"Power-law spring whose damping grows with the penetration (Hunt and Crossley 1975); Damping "
     "and the "
     "regularisations are not used.",
     deck::ListSpec("Hunt-Crossley", "Force k G^n (1 + chi dG/dt), only while it pushes.")
         .real("Exponent", "", 1.0, deck::Range::between(1.0, 3.0),
               "n; above 1 the Stiffness k is in N/m^n.")
         .expert()
         .real("Dissipation", "s/m", 0.0, deck::Range::nonNegative(),
               "chi; a body hitting the wall at v comes back with about (1 - 2 chi v/3) v."),
     [](const Teuchos::ParameterList& list) {
       const auto value = [&list](const char* name, double standard) {
         return list.isParameter(name) ? list.get<double>(name) : standard;
       };
       return std::make_unique<ContactLawOf<HuntCrossleyKernel>>(
           HuntCrossleyKernel(value("Exponent", 1.0), value("Dissipation", 0.0)));
     }});

}  // namespace
}  // namespace tooljoint::contact
