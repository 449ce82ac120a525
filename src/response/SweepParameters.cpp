// SPDX-License-Identifier: BSD-3-Clause
#include "response/SweepParameters.hpp"

#include <fmt/format.h>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::response {

void declareCommon(deck::ListSpec& list) {
  list.choice("Friction", std::string("None"), {"None", "Sliding"},
              "Contacts at rest: None takes closed contacts as springs and dashpots along their "
              "normals; Sliding adds the tangent of friction at the speed of sliding, which is not "
              "symmetric and can make a motion grow.")
      .integer("Spot Checks", 3, deck::Range::nonNegative(),
               "Points at which the full model is solved as well as the reduced one; of a response "
               "also at the highest peak of each output, unless 0.")
      .expert()
      .choice(
          "Axis", std::string("z"), {"x", "y", "z"},
          "Axis of the rotation: separates forward from backward whirl and directs unbalance. That "
          "of a string is z.")
      .expert();
}

bool wantsFriction(const Teuchos::ParameterList& list) {
  return list.get<std::string>("Friction") == "Sliding";
}

std::vector<double> evenly(const Teuchos::ParameterList& list, const std::string& from,
                           const std::string& to, const std::string& unit) {
  const double first = list.get<double>(from), last = list.get<double>(to);
  if (!(last > first))
    throw DeckError(list.name() + "/" + to + " is " + deck::printed(last, unit, 6) + ", but " +
                    from + " is " + deck::printed(first, unit, 6) + ". Give a larger one.");
  const int count = list.get<int>("Points");
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / (count - 1));
  return values;
}

std::string rangeOf(const std::vector<double>& sweep, double factor) {
  return fmt::format("{:.6g} to {:.6g}", factor * sweep.front(), factor * sweep.back());
}

std::vector<std::size_t> spread(std::size_t size, int count) {
  std::vector<std::size_t> places;
  for (int i = 0; i < count; ++i)
    places.push_back(count == 1 ? size / 2 : (size - 1) * at(i) / at(count - 1));
  makeUnique(places);
  return places;
}

}  // namespace tooljoint::response
