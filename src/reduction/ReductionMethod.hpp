// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The interface of a reduction method. A variant is one file that adds itself with addMethod.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "deck/Registry.hpp"
#include "model/SharedSparse.hpp"
#include "reduction/part/PartView.hpp"
#include "reduction/project/BasisReport.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::reduction {

/// D = Phi q with q = (interface dofs, retained dofs, modal coordinates). The rows of Phi of the
/// boundary dofs are the identity and zero, so that interface dofs stay physical and parts are
/// joined by equal labels. Dual bases have interface forces as coordinates, and interface dofs
/// among the interior ones: q = (retained dofs, modal coordinates, forces).
struct Basis {
  Partition partition;
  model::SharedSparse vectors;        ///< Phi: dofs x (boundary + modes), structural zeros absent
  std::vector<std::string> modeKind;  ///< one per modal column
  Vector eigenvalues;                 ///< omega^2 of the modal columns [rad^2/s^2], increasing
  Vector candidates;                  ///< omega^2 of all modes computed, kept ones first
  bool complete = false;              ///< `candidates` are all modes the part has
  bool orthonormal =
      false;  ///< the modal columns are meant to be mass-orthonormal and to diagonalise sym(K)
  Sparse inertial;  ///< what mass and damping are projected on where that is not `vectors`
                    ///< (MacNeal); empty: `vectors`
  std::vector<int> forceDofs;  ///< positions of interface dofs that are no coordinates: the last
                               ///< columns are then the forces on them, one each (dual bases)
  bool removable = true;       ///< modal columns may be left out one by one; otherwise a basis with
                               ///< fewer modes is another one
  std::vector<BasisRow> rows;
  double orthogonality = 0;
  std::string method;
  std::vector<std::string> remarks;

  int modes() const { return static_cast<int>(eigenvalues.size()); }
  int forces() const { return static_cast<int>(forceDofs.size()); }
};

/// Keep only the first `modes` modal columns of `basis`; the rows of the others are marked dropped
/// with the reason `why`.
void truncate(Basis& basis, int modes, const std::string& why);

/// Keep only the modal columns with keep[k] != 0; their rows say `kept`, the others are marked
/// dropped with the reason `dropped`.
void select(Basis& basis, const std::vector<char>& keep, const std::string& kept,
            const std::string& dropped);

/// Dependent coordinates of a coupled model: q_dofs = rows q_others, others in
/// increasing order.
struct DependentCoordinates {
  std::vector<int> dofs;  ///< of the coupled model
  Matrix rows;            ///< dofs x others
};

/// Properties of a family of bases.
struct MethodTraits {
  bool ownMass = true;  ///< mass and damping are projected on its vectors; otherwise the coupled
                        ///< mass is singular and residuals give no error estimate
  bool interfaceForces = false;  ///< interface forces are coordinates, and interface dofs are none
  bool dependent =
      false;  ///< it has coordinates that depend on others, by the inverse of the coupled mass
  bool selectable = false;  ///< its modes have a fixed interface and may be left out one by one
  bool needsModes = true;   ///< a deck has to say how many; otherwise none where it does not
};

/// Data of a part before its reduction.
struct PartOutline {
  std::string name;
  int dofs = 0;       ///< of the part
  bool inner = true;  ///< it has interior dofs
};

/// A family of bases (Craig-Bampton, ...). Stateless: build() may be called for many parts, on
/// several ranks. The PartView computes the data of a part once for all stages of a method.
class ReductionMethod {
 public:
  virtual ~ReductionMethod() = default;

  /// Basis of one part. Throws ModelError (the interior is a mechanism, the mass is indefinite) or
  /// ConvergenceError.
  virtual Basis build(const PartView& part, const ModeRequest& request) const = 0;

  /// Second hook, for families that need the assembled interface: augment the bases of all parts
  /// given the coupled reduced model, `positions[p][i]` being the coupled dof of reduced coordinate
  /// i of part p. True when a basis was changed, and parts are then projected and coupled again.
  /// The default changes nothing.
  virtual bool augment(const model::SecondOrderModel& coupled,
                       const std::vector<std::vector<int>>& positions,
                       const std::vector<PartView>& parts, std::vector<Basis>& bases) const;

  /// Third hook, after the last augmentation: dependent coordinates, which are not unknowns of the
  /// coupled model. maps[p] are the coordinates of part p in coupled dofs. The default has
  /// none.
  virtual DependentCoordinates dependentCoordinates(const model::SecondOrderModel& coupled,
                                                    const std::vector<Sparse>& maps,
                                                    const std::vector<PartView>& parts,
                                                    const std::vector<Basis>& bases) const;

  virtual MethodTraits traits() const { return {}; }

  /// Checks its input, such as files, before anything is computed. Throws DeckError.
  /// The default reads nothing.
  virtual void checkInput(const std::vector<PartOutline>& parts) const;

  /// True when build() depends on the name of the part: then identical parts are reduced
  /// separately.
  virtual bool namesParts() const { return false; }
};

using MethodRegistry = deck::Registry<ReductionMethod, const Teuchos::ParameterList&>;

/// Registers a method under its name in the deck. `doc`: one sentence and the source it follows.
/// Method is made from the list of its own parameters, defaults filled in, or from nothing where it
/// has none. `const bool registered = addMethod<Method>("Name", "...", parameters());`
template <class Method>
bool addMethod(const std::string& name, const std::string& doc, deck::ListSpec parameters = {}) {
  return MethodRegistry::instance().add(
      name, {doc, std::move(parameters),
             [](const Teuchos::ParameterList& list) -> std::unique_ptr<ReductionMethod> {
               if constexpr (std::is_default_constructible_v<Method>)
                 return static_cast<void>(list), std::make_unique<Method>();
               else
                 return std::make_unique<Method>(list);
             }});
}

}  // namespace tooljoint::reduction
