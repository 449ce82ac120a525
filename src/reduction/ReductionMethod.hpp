// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The interface of a reduction method. A method is one file that registers itself with addMethod.
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
/// joined by equal labels. Dual bases have interface forces as coordinates, and interface dofs are
/// among the interior dofs: q = (retained dofs, modal coordinates, forces).
struct Basis {
  Partition partition;
  model::SharedSparse vectors;        ///< Phi: dofs x (boundary + modes), structural zeros absent
  std::vector<std::string> modeKind;  ///< one per modal column
  Vector eigenvalues;                 ///< omega^2 of the modal columns [rad^2/s^2], increasing
  Vector candidates;                  ///< omega^2 of all modes computed, kept ones first
  bool complete = false;              ///< `candidates` are all modes of the part
  bool orthonormal =
      false;        ///< the modal columns should be mass-orthonormal and diagonalise sym(K)
  Sparse inertial;  ///< mass and damping are projected on this instead of `vectors` (MacNeal);
                    ///< empty: on `vectors`
  std::vector<int> forceDofs;  ///< positions of interface dofs that are not coordinates; the last
                               ///< columns are then the forces on them, one each (dual bases)
  bool removable = true;       ///< single modal columns may be removed; otherwise fewer modes need
                               ///< another basis
  std::vector<BasisRow> rows;
  double orthogonality = 0;
  std::string method;
  std::vector<std::string> remarks;

  int modes() const { return static_cast<int>(eigenvalues.size()); }
  int forces() const { return static_cast<int>(forceDofs.size()); }
};

/// Keeps only the first `modes` modal columns of `basis`; the rows of the others are marked as
/// dropped with the reason `why`.
void truncate(Basis& basis, int modes, const std::string& why);

/// Keeps only the modal columns with keep[k] != 0; their rows get the reason `kept`, the others are
/// marked as dropped with the reason `dropped`.
void select(Basis& basis, const std::vector<char>& keep, const std::string& kept,
            const std::string& dropped);

/// Dependent coordinates of a coupled model: q_dofs = rows q_others, with the others in increasing
/// order.
struct DependentCoordinates {
  std::vector<int> dofs;  ///< of the coupled model
  Matrix rows;            ///< dofs x others
};

/// Properties of a family of bases.
struct MethodTraits {
  bool ownMass = true;  ///< mass and damping are projected on its vectors; otherwise the coupled
                        ///< mass is singular and residuals give no error estimate
  bool interfaceForces = false;  ///< interface forces are coordinates, and interface dofs are not
  bool dependent =
      false;  ///< it has coordinates that depend on others through the inverse of the coupled mass
  bool selectable = false;  ///< its modes have a fixed interface and may be removed one by one
  bool needsModes = true;   ///< the deck must give their number; otherwise the default is none
};

/// Data of a part before its reduction.
struct PartOutline {
  std::string name;
  int dofs = 0;       ///< of the part
  bool inner = true;  ///< it has interior dofs
};

/// A family of bases (Craig-Bampton, ...). Stateless: build() may be called for many parts, on
/// several ranks. PartView computes the data of a part once for all stages of a method.
class ReductionMethod {
 public:
  virtual ~ReductionMethod() = default;

  /// Basis of one part. Throws ModelError (the interior is a mechanism, the mass is indefinite) or
  /// ConvergenceError.
  virtual Basis build(const PartView& part, const ModeRequest& request) const = 0;

  /// Second hook, for families that need the assembled interface: augments the bases of all parts,
  /// given the coupled reduced model; `positions[p][i]` is the coupled dof of reduced coordinate i
  /// of part p. Returns true when a basis was changed; parts are then projected and coupled again.
  /// The default changes nothing.
  virtual bool augment(const model::SecondOrderModel& coupled,
                       const std::vector<std::vector<int>>& positions,
                       const std::vector<PartView>& parts, std::vector<Basis>& bases) const;

  /// Third hook, after the last augmentation: dependent coordinates, which are not unknowns of the
  /// coupled model. maps[p] gives the coordinates of part p in coupled dofs. The default has none.
  virtual DependentCoordinates dependentCoordinates(const model::SecondOrderModel& coupled,
                                                    const std::vector<Sparse>& maps,
                                                    const std::vector<PartView>& parts,
                                                    const std::vector<Basis>& bases) const;

  virtual MethodTraits traits() const { return {}; }

  /// Checks the input of the method, such as files, before any computation. Throws DeckError. The
  /// default reads nothing.
  virtual void checkInput(const std::vector<PartOutline>& parts) const;

  /// True when build() depends on the name of the part; identical parts are then reduced
  /// separately.
  virtual bool namesParts() const { return false; }
};

using MethodRegistry = deck::Registry<ReductionMethod, const Teuchos::ParameterList&>;

/// Registers a method under its name in the deck. `doc`: one sentence and the source of the method.
/// The constructor takes the list of its own parameters, defaults filled in, or nothing if it has
/// none. `const bool registered = addMethod<Method>("Name", "...", parameters());`
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
