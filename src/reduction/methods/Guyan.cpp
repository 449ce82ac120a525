// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static condensation: R. J. Guyan, Reduction of stiffness and mass matrices, AIAA Journal 3
/// (1965) 380; B. Irons, Structural eigenvalue problems: elimination of unwanted variables, AIAA
/// Journal 3 (1965) 961-962. Further master dofs after Henshell and Ong (1975).
#include <Teuchos_ParameterList.hpp>
#include <algorithm>

#include "reduction/methods/ReductionMethod.hpp"
#include "reduction/part/ConstraintModes.hpp"
#include "reduction/part/MasterDofs.hpp"

namespace tooljoint::reduction {

namespace {

/// D_I = -K_II^-1 K_IC D_C; where modes are asked for, as many interior dofs become masters: kept
/// like retained ones.
class Guyan : public ReductionMethod {
 public:
  explicit Guyan(bool automatic) : automatic_(automatic) {}

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    Basis basis;
    const Partition own = partition(part);
    model::Substructure condensed = part;
    if (automatic_) {
      const MasterRanking ranking =
          rankMasters(part, own, symmetricPart(constantStiffness(part.model)));
      const int masters = count(ranking, request);
      condensed.retained.insert(condensed.retained.end(), ranking.positions.begin(),
                                ranking.positions.begin() + masters);
      std::sort(condensed.retained.begin(), condensed.retained.end());
      basis.candidates = ranking.ratios;
      basis.complete = true;
      remark(request, masters, static_cast<int>(own.interior.size()), basis);
    } else if (request.kind != ModeRequest::Kind::Count || request.count > 0) {
      basis.remarks.push_back(
          "static condensation without masters: the number of modes asked for is not used");
    }
    basis.partition = partition(condensed);
    basis.removable = false;
    basis.method = "static condensation";
    const Partition& p = basis.partition;
    const ConstraintModes constraint = constraintModes(part, p, constantStiffness(part.model));
    for (std::size_t j = 0; j < p.kept.size(); ++j) {
      BasisRow row;
      row.kind = "constraint";
      row.name = model::describe(part.model.dofs[static_cast<std::size_t>(p.kept[j])],
                                 part.model.componentNames);
      row.residual = constraint.residuals[static_cast<Eigen::Index>(j)];
      const bool retained =
          std::find(part.retained.begin(), part.retained.end(), p.kept[j]) != part.retained.end();
      row.why = j < p.interface.size() ? "interface dof" : retained ? "retained dof" : "master dof";
      basis.rows.push_back(row);
    }
    basis.vectors = Sparse(p.size, static_cast<Eigen::Index>(p.kept.size()));
    basis.vectors.setFromTriplets(constraint.entries.begin(), constraint.entries.end());
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
      basis.remarks.push_back("asked for " + std::to_string(request.count) +
                              " master dofs, kept all " + std::to_string(interior) + " there are");
    if (masters > 0)
      basis.remarks.push_back("in the place of modes, " + std::to_string(masters) +
                              " interior dofs are masters");
  }

  bool automatic_;
};

deck::ListSpec parameters() {
  deck::ListSpec list("Guyan",
                      "Static condensation has no modes; what the deck says about their number may "
                      "choose further dofs to keep.");
  list.choice("Masters", std::string("Automatic"), {"Automatic", "None"},
              "\"Automatic\" keeps, in the place of modes, as many interior dofs as physical "
              "coordinates: those left when the dof with the largest k_ii / m_ii "
              "is condensed again and again (Henshell and Ong 1975; a cut-off frequency is "
              "compared with sqrt(k_ii / m_ii)). \"None\" keeps interface and "
              "retained dofs alone.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "Guyan",
    {"Static condensation on interface, retained and master dofs (Guyan 1965; Irons 1965).",
     parameters(), [](const Teuchos::ParameterList& list) {
       return std::unique_ptr<ReductionMethod>(new Guyan(
           !list.isParameter("Masters") || list.get<std::string>("Masters") == "Automatic"));
     }});

}  // namespace

}  // namespace tooljoint::reduction
