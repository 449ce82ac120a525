// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The interface of a mud model: contributions of the drilling mud to the matrices and loads of one
/// element. A model is one file that registers itself, in the tree or outside; a deck names it as
/// `Mud/Model`.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "substructures/beam/Section.hpp"

namespace tooljoint::mud {

/// Values of the deck list `Mud` for all models: the fluid and the active effects. A deck without
/// the list has no mud model.
struct MudProperties {
  double density = 0.0;              ///< rho_f [kg/m3]
  double frictionCoefficient = 0.0;  ///< C_f of the axial flow along the string [-]
  double kinematicViscosity = 0.0;   ///< nu_f [m2/s]
  double flowRate = 0.0;             ///< Q [m3/s]; positive down the string and up the annulus
  bool coriolis = true;              ///< Coriolis pair of both flows
  bool centrifugal = true;           ///< centrifugal stiffness of both flows
  bool axialDrag = true;             ///< axial drag load of the annular flow
  bool annularThrust = false;        ///< thrust of its pressure loss on the string
  bool rotatingAnnulus = false;      ///< annular mud swirls at Omega/2 on average
};

/// A 12 x 12 element matrix times a law of the rotary speed: "1", "sqrt|Omega|", "Omega", "Omega^2"
/// or "Omega sqrt|Omega|".
struct MatrixTerm {
  std::string name;  ///< "mud drag", "mud Coriolis", ...: the same for every element
  std::string law;
  beam::Matrix12 matrix;  ///< element frame, on the left-hand side
};

/// Contributions of the mud to one element, in its element frame. Terms that the deck makes zero
/// are omitted from the lists.
struct ElementContribution {
  beam::Matrix12 mass = beam::Matrix12::Zero();
  std::vector<MatrixTerm> damping;
  std::vector<MatrixTerm> stiffness;
  beam::Vector12 load = beam::Vector12::Zero();  ///< on the right-hand side [N, N m]
};

class MudModel {
 public:
  virtual ~MudModel() = default;

  /// Contribution to an element of length l [m] in a bore of radius R_w [m]; `gravity` is the
  /// acceleration vector in the element frame [m/s2] (zero for a deck without gravity). ModelError
  /// for a section or a bore that the model does not cover.
  virtual ElementContribution element(const beam::Section& section, double boreRadius,
                                      double length, const Vector3& gravity) const = 0;
};

/// name -> model, made from the list of its own parameters and the properties of the mud.
using MudModels = deck::Registry<MudModel, const Teuchos::ParameterList&, const MudProperties&>;

/// Registers a model that is made from (list of its own parameters, properties) or from
/// (properties). `doc`: one sentence and the source of the model. `const bool registered =
/// addMudModel<Type>("Name", "...", parameters());`
template <class Type>
bool addMudModel(const std::string& name, const std::string& doc, deck::ListSpec parameters = {}) {
  return MudModels::instance().add(
      name, {doc, std::move(parameters),
             [](const Teuchos::ParameterList& list, const MudProperties& properties) {
               if constexpr (std::is_constructible_v<Type, const MudProperties&>)
                 return static_cast<void>(list), std::make_unique<Type>(properties);
               else
                 return std::make_unique<Type>(list, properties);
             }});
}

/// The deck list `Mud`, with one sublist for each registered model that has its own parameters.
deck::ListSpec parameters();
/// The properties of the validated deck list `Mud`.
MudProperties readProperties(const Teuchos::ParameterList& list);
/// The model named in the validated deck list `Mud`. DeckError as thrown by the model.
std::unique_ptr<MudModel> readMud(const Teuchos::ParameterList& list);

}  // namespace tooljoint::mud
