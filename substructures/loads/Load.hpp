// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The interface of a load on the string. A load is one file that registers itself, in the tree or
/// outside; a deck gives its parameters in the list `Loads/<name>`.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"
#include "model/ScalarLaw.hpp"
#include "substructures/beam/Section.hpp"
#include "substructures/loads/RotarySpeed.hpp"

namespace tooljoint::loads {

/// A load on one dof, in the frame of its node: value times a scalar law of time. A load with the
/// law "1" acts in the static state too.
struct PointLoad {
  std::string name;
  int node = 0;        ///< 1-based
  int component = 0;   ///< 0-based: u, v, w, theta_x, theta_y, theta_z
  double value = 0.0;  ///< [N] or [N m]
  model::ScalarLaw law = model::ScalarLaw::one();
  /// The deck parameter that is rejected if a support holds the dof; empty: the load then has no
  /// effect.
  std::string parameter = {};
};

/// A constant force per length on an element, in element axes, times a scalar law of time.
struct LineLoad {
  std::string name;
  Vector3 force;  ///< [N/m]
  model::ScalarLaw law = model::ScalarLaw::one();
};

/// Data of an element that loads can use.
struct LoadedElement {
  const beam::Section& section;
  const Matrix3& frame;  ///< columns: element axes in global ones, z along the string, Z down
  double from = 0.0;     ///< measured depth of its upper end [m]
  double to = 0.0;       ///< of its lower end [m]
};

/// A line of `tooljoint check`.
struct LoadRemark {
  bool acts = true;
  std::string load;
  std::string text;  ///< its value, or why it does not act
};

/// Loads are evaluated during assembly, never in the step loop; their time dependence is a scalar
/// law.
class Load {
 public:
  virtual ~Load() = default;

  /// Acceleration of a field that acts on the mud too (buoyancy), global axes [m/s2].
  virtual Vector3 acceleration() const { return Vector3::Zero(); }
  virtual std::vector<LineLoad> onElement(const LoadedElement& /*element*/,
                                          const RotarySpeed& /*rotary*/) const {
    return {};
  }
  /// `depths`: measured depths of the nodes from the surface to the bit [m]. DeckError when the
  /// deck names a node that does not exist.
  virtual std::vector<PointLoad> atNodes(const std::vector<double>& /*depths*/,
                                         const RotarySpeed& /*rotary*/) const {
    return {};
  }
  virtual std::vector<LoadRemark> describe(const RotarySpeed& rotary) const = 0;
  /// The deck list for a warning about all its entries; empty: the warning uses the remark of the
  /// load.
  virtual std::string list() const { return {}; }
};

/// name -> load. A load whose description is called "Loads" has its parameters directly in the list
/// `Loads`, other loads in a sublist with their name.
using LoadRegistry = deck::Registry<Load, const Teuchos::ParameterList&>;

/// Registers a load that is made from its list. `doc`: one sentence.
/// `const bool registered = addLoad<Type>("Name", "...", parameters());`
template <class Type>
bool addLoad(const std::string& name, const std::string& doc, deck::ListSpec parameters) {
  return LoadRegistry::instance().add(name, {doc, std::move(parameters), [](const auto& list) {
                                               return std::make_unique<Type>(list);
                                             }});
}

/// The loads of a scene, in order of their names in the registry; empty without the list `Loads`.
using Loads = std::vector<std::shared_ptr<const Load>>;

/// The deck list `Loads`, with the parameters of every registered load.
deck::ListSpec parameters();
/// From the validated deck list `Loads`. DeckError as thrown by the loads.
Loads readLoads(const Teuchos::ParameterList& list);

/// Sum of the accelerations of all loads, global axes [m/s2].
Vector3 acceleration(const Loads& loads);
/// Distributed static loads on an element except the weight of acceleration(), element axes [N/m].
Vector3 steadyBesideWeight(const Loads& loads, const LoadedElement& element,
                           const RotarySpeed& rotary);
/// The same loads on the lower part of the string only. Its first node is at this measured depth
/// [m], and its depths start there.
Loads below(const Loads& loads, double top);
/// All loads at nodes. DeckError as Load::atNodes; ModelError for a node or a component that does
/// not exist.
std::vector<PointLoad> pointLoads(const Loads& loads, const std::vector<double>& depths,
                                  const RotarySpeed& rotary);

}  // namespace tooljoint::loads
