// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Map`: a grid of parameters of the deck, and the mapped values.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "study/StudyParameters.hpp"

namespace tooljoint::study {

/// One axis of the grid.
struct MapAxis {
  Dimension dimension;          ///< parameter of the deck and its values as texts
  std::vector<double> numbers;  ///< the values in `unit`; empty if they are not numbers
  std::string unit;             ///< as written in the deck; "" for none
};

/// A numeric key of summary.json, and its unsafe range.
struct MapValue {
  std::string name;  ///< of its list
  std::string key;
  std::optional<double> unsafeAbove, unsafeBelow;

  bool unsafe(double value) const {
    return (unsafeAbove && value > *unsafeAbove) || (unsafeBelow && value < *unsafeBelow);
  }
};

struct MapSettings {
  std::vector<MapAxis> axes;  ///< at least two; the last one varies first
  std::vector<MapValue> values;
  std::optional<double> timeLimit;  ///< CPU seconds of one point
  bool pictures = true;

  std::size_t points() const;
};

/// Description of the list `Map`.
deck::ListSpec mapParameters();

/// Typed values of the list. DeckError with one line per fault: fewer than two axes, an axis with
/// fewer than two points, a repeated value, different units, a key that summary.json does not have.
MapSettings readMap(const Teuchos::ParameterList& list);

}  // namespace tooljoint::study
