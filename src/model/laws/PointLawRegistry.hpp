// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws by name, for connections between parts and for contact with a wall. A law is one file
/// that registers itself, in the tree or outside.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>

#include "deck/Registry.hpp"
#include "model/laws/FormulaLaw.hpp"

namespace tooljoint::model {

/// Place for which a law is made. Its first coordinate is a separation [m] (or an angle [rad]): a
/// positive force pushes the two sides apart. The others are tangential displacements of one side
/// relative to the other, if the place defines directions for them.
struct PointLawPlace {
  int points = 1;       ///< all with these parameters
  int coordinates = 1;  ///< available at the place, at most 3
};

/// A law may use fewer coordinates than available. Makers throw DeckError for errors that a single
/// parameter does not show.
using PointLawRegistry =
    deck::Registry<PointLaw, const Teuchos::ParameterList&, const PointLawPlace&>;

/// Registers the formula `Law`, which is constructed from its own parameter list. `parameters` has
/// the name of the law.
template <class Law>
bool registerFormula(const deck::ListSpec& parameters) {
  return PointLawRegistry::instance().add(
      parameters.name(), {parameters.doc(), parameters,
                          [](const Teuchos::ParameterList& own, const PointLawPlace& place) {
                            return std::make_unique<FormulaLaw<Law>>(Law(own), place.points);
                          }});
}

}  // namespace tooljoint::model
