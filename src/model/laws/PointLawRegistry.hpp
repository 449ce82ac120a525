// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws by name, for connections between parts and for contact with a wall alike. A law is
/// one file that registers itself, in the tree or outside.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>

#include "deck/Registry.hpp"
#include "model/laws/FormulaLaw.hpp"

namespace tooljoint::model {

/// The place a law is made for. Its first coordinate is a separation [m] (or an angle [rad]): a
/// positive force pushes the two sides apart. The others are tangential displacements of the one
/// side against the other, where the place has directions for them.
struct PointLawPlace {
  int points = 1;       ///< all with these parameters
  int coordinates = 1;  ///< as many as the place can give, at most 3
};

/// A law may take fewer coordinates than offered. Makers throw DeckError for what no single
/// parameter shows.
using PointLawRegistry =
    deck::Registry<PointLaw, const Teuchos::ParameterList&, const PointLawPlace&>;

/// Registers the formula `Law`, which is made from its own parameter list. `parameters` has the
/// name of the law.
template <class Law>
bool registerFormula(const deck::ListSpec& parameters) {
  return PointLawRegistry::instance().add(
      parameters.name(), {parameters.doc(), parameters,
                          [](const Teuchos::ParameterList& own, const PointLawPlace& place) {
                            return std::make_unique<FormulaLaw<Law>>(Law(own), place.points);
                          }});
}

}  // namespace tooljoint::model
