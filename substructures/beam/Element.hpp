// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The interface of a finite element of the string. An element is one file that registers itself,
/// in the tree or outside; a deck names it as `Drillstring/Element` or in a component.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "deck/Registry.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "substructures/beam/Corotational.hpp"
#include "substructures/beam/Section.hpp"

namespace tooljoint::beam {

/// Dofs u, v, w, theta_x, theta_y, theta_z that an element has at its nodes.
using DofMap = std::array<bool, 6>;

/// Two-node element between neighbouring nodes of the string. All matrices are 12 x 12 in the frame
/// of the element (BeamMatrices.hpp); rows and columns of dofs missing in dofs() are zero. Matrices
/// are computed during assembly, never in the step loop.
class Element {
 public:
  Element(const Section& section, double length) : section_(section), length_(length) {}
  virtual ~Element() = default;

  const Section& section() const { return section_; }
  double length() const { return length_; }  ///< l0, unstrained [m]

  /// Dofs of the element; all unless overridden. The string holds the dofs that no element has at a
  /// node.
  virtual DofMap dofs() const { return {true, true, true, true, true, true}; }

  /// K_a: symmetric, no force in a rigid motion [N/m, N, N m]. Its entries for w and theta_z give
  /// the axial force and the torque of the static state.
  virtual Matrix12 stiffness() const = 0;
  /// M_a: symmetric [kg, kg m, kg m2].
  virtual Matrix12 mass() const = 0;
  /// C_a: damping of the element, in addition to the Rayleigh damping of the deck; zero unless
  /// overridden [N s/m, N s, N m s].
  virtual Matrix12 damping() const { return Matrix12::Zero(); }
  /// C_ac of the kinetic energy Omega D' C_ac D', as beam::gyroscopic [kg m2].
  virtual Matrix12 gyroscopic() const = 0;
  /// F_thetaz of the load -dOmega/dt F_thetaz, as beam::spinLoad [kg m2].
  virtual Vector12 spinLoad() const = 0;
  /// Geometric stiffness of a unit axial force, tension positive [1/m, 1, m].
  virtual Matrix12 geometricAxial() const = 0;
  /// Geometric stiffness of a unit torque, on the left-hand side [1/m, 1, m].
  virtual Matrix12 geometricTorque() const = 0;
  /// Nodal loads [N, N m] of a constant force per length q [N/m] in element axes.
  virtual Vector12 distributedLoad(const Vector3& q) const = 0;

  /// Forces and tangent at large displacements. Unless overridden: stiffness() in the frame of the
  /// chord (CorotationalElement). Errors as CorotationalElement::evaluate.
  virtual CorotationalResponse response(const ElementPose& pose, bool withTangent) const;

 private:
  Section section_;
  double length_;
};

/// Dofs of each node of a chain of elements: those of the one or two elements that share the node.
std::vector<DofMap> nodalDofs(const std::vector<std::shared_ptr<const Element>>& chain);

/// An element is made from its own parameters, its section and its length [m].
using ElementRegistry =
    deck::Registry<Element, const Teuchos::ParameterList&, const Section&, double>;

/// Registers an element under its name in the deck. `doc`: one sentence and the source of the
/// element. The constructor of Type takes (section, length), or (list of its own parameters,
/// section, length). `const bool registered = addElement<Type>("Name", "...", parameters());`
template <class Type>
bool addElement(const std::string& name, const std::string& doc, deck::ListSpec parameters = {}) {
  return ElementRegistry::instance().add(
      name, {doc, std::move(parameters),
             [](const Teuchos::ParameterList& list, const Section& section, double length) {
               if constexpr (std::is_constructible_v<Type, const Section&, double>)
                 return static_cast<void>(list), std::make_unique<Type>(section, length);
               else
                 return std::make_unique<Type>(list, section, length);
             }});
}

/// The element chosen in a deck: its name and its own parameters.
struct ElementChoice {
  std::string name = "Timoshenko";
  Teuchos::ParameterList own;

  /// DeckError for an unregistered name, and for parameters that the element rejects. ModelError if
  /// mass or stiffness is not symmetric, or if a rigid motion along or about the axis causes
  /// forces.
  std::shared_ptr<const Element> make(const Section& section, double length) const;
};

/// Declares the choice `Element` and the lists of elements that have their own parameters.
void declareElement(deck::ListSpec& list, deck::Default chosen, const std::string& doc);
/// The choice of a validated list; `standard` if the list has none. DeckError when the list of an
/// element with required parameters is missing.
ElementChoice readElement(const Teuchos::ParameterList& list, const ElementChoice& standard);

}  // namespace tooljoint::beam
