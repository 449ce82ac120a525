// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static condensation: R. J. Guyan, Reduction of stiffness and mass matrices, AIAA Journal 3
/// (1965) 380; B. Irons, Structural eigenvalue problems: elimination of unwanted variables, AIAA
/// Journal 3 (1965) 961-962. Further master dofs after Henshell and Ong (1975).
#include <Teuchos_ParameterList.hpp>

#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/part/MasterDofs.hpp"

namespace tooljoint::reduction {

namespace {

/// D_I = -K_II^-1 K_IC D_C. With requested modes the same number of interior dofs become masters
/// and are kept like retained dofs.
class Guyan : public ReductionMethod {
 public:
  explicit Guyan(const Teuchos::ParameterList& list)
      : automatic_(list.get<std::string>("Masters") == "Automatic") {}

  MethodTraits traits() const override {
    MethodTraits traits;
    traits.needsModes = false;
    return traits;
  }
  Basis build(const PartView& part, const ModeRequest& request) const override {
    Basis basis;
    PartView condensed = part;
    if (automatic_) {
      const MasterRanking ranking = rankMasters(part);
      const int masters = count(ranking, request);
      std::vector<int> retained = part.partition().retained;
      retained.insert(retained.end(), ranking.positions.begin(),
                      ranking.positions.begin() + masters);
      std::sort(retained.begin(), retained.end());
      condensed = part.withBoundary(part.partition().interface, retained);
      basis.candidates = ranking.ratios;
      basis.complete = true;
      remark(request, masters, sizeOf(part.partition().interior), basis);
    } else if (request.kind != ModeRequest::Kind::Count || request.count > 0) {
      basis.remarks.push_back(
          "static condensation without masters does not use the number of modes");
    }
    const ConstraintModes& constraint = condensed.constraintModes();
    basis.partition = condensed.partition();
    basis.vectors = constraint.vectors;
    basis.removable = false;
    basis.method = "static condensation";
    addConstraintRows(part, basis.partition, constraint.residuals, basis, "master dof");
    return basis;
  }

 private:
  static int count(const MasterRanking& ranking, const ModeRequest& request) {
    const auto all = static_cast<int>(ranking.positions.size());
    if (request.kind == ModeRequest::Kind::All) return all;
    if (request.kind == ModeRequest::Kind::Count) return std::min(request.count, all);
    int below = 0;
    while (below < all && signedOmega(ranking.ratios[below]) <= request.omegaMax) ++below;
    return below;
  }

  static void remark(const ModeRequest& request, int masters, int interior, Basis& basis) {
    if (request.kind == ModeRequest::Kind::Count && request.count > interior)
      basis.remarks.push_back("requested " + std::to_string(request.count) +
                              " master dofs, kept all " + std::to_string(interior));
    if (masters > 0)
      basis.remarks.push_back("instead of modes, " + std::to_string(masters) +
                              " interior dofs are masters");
  }

  bool automatic_;
};

deck::ListSpec guyanParameters() {
  deck::ListSpec list(
      "Guyan",
      "Static condensation has no modes; the mode selection can set the number of master dofs, and "
      "may be left out.");
  list.choice("Masters", std::string("Automatic"), {"Automatic", "None"},
              "\"Automatic\": the mode selection gives the number of interior dofs that become "
              "masters, found by repeated condensation of the dof with the largest k_ii / m_ii "
              "(Henshell and Ong 1975; a cut-off frequency is compared with sqrt(k_ii / m_ii)). "
              "\"None\": interface and retained dofs are the only masters.")
      .expert();
  return list;
}

const bool guyanRegistered = addMethod<Guyan>(
    "Guyan", "Static condensation on interface, retained and master dofs (Guyan 1965; Irons 1965).",
    guyanParameters());

}  // namespace

}  // namespace tooljoint::reduction
