// SPDX-License-Identifier: BSD-3-Clause
// A load outside of the library: one file, compiled by itself, given in decks as Loads/Wall Drag.
#include <cstdlib>
#include <string>
#include <tooljoint/common/Error.hpp>
#include <tooljoint/common/Parallel.hpp>
#include <tooljoint/substructures/loads/Load.hpp>

using namespace tooljoint;

/// A force per length along the string, between two depths; positive pulls it up the hole.
struct WallDrag : loads::Load {
  double from, to, drag;
  explicit WallDrag(const Teuchos::ParameterList& list)
      : from(list.get<double>("From")),
        to(list.get<double>("To")),
        drag(list.get<double>("Force Per Length")) {
    if (!(to > from)) throw DeckError("Loads/Wall Drag ends (To) before it starts (From).");
  }

  std::vector<loads::LineLoad> onElement(const loads::LoadedElement& element,
                                         const loads::RotarySpeed&) const override {
    if (const char* failing = std::getenv("WALL_DRAG_FAILS_ON"))
      if (std::to_string(parallel::rank()) == failing)
        throw ModelError("Loads/Wall Drag fails, as the test wants.");
    const double covered = std::min(to, element.to) - std::max(from, element.from);
    if (covered <= 0.0) return {};
    return {{"wall drag", Vector3(0, 0, -drag * covered / (element.to - element.from))}};
  }
  std::vector<loads::LoadRemark> describe(const loads::RotarySpeed&) const override {
    return {{true, "wall drag", std::to_string(drag * (to - from)) + " N in all"}};
  }
};

const bool registered = loads::addLoad<WallDrag>(
    "Wall Drag", "drag of the wall between two depths.",
    deck::ListSpec("Wall Drag", "Drag of the wall between two depths.")
        .real("From", "m", deck::Required{}, deck::Range::nonNegative(), "Its upper end.")
        .real("To", "m", deck::Required{}, deck::Range::positive(), "Its lower end.")
        .real("Force Per Length", "N/m", deck::Required{}, deck::Range::any(),
              "Positive pulls the string up."));
