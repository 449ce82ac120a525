// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Defaults.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/reading/Validator.hpp"

namespace tooljoint::deck {

void withDefaults(const ListSpec& spec, const Teuchos::ParameterList& given,
                  const std::function<void(const Teuchos::ParameterList&)>& use) {
  Teuchos::ParameterList filled(given);
  for (const ParameterSpec& parameter : spec.parameters()) {
    if (!filled.isParameter(parameter.name)) {
      setDefault(filled, parameter);
    } else if (parameter.kind == Kind::Choice) {
      const auto& text = filled.get<std::string>(parameter.name);
      if (std::find(parameter.choices.begin(), parameter.choices.end(), text) ==
          parameter.choices.end())
        throw DeckError("\"" + parameter.name + "\" is \"" + text +
                        "\"; available: " + quotedList(parameter.choices) + ".");
    }
  }
  use(filled);
}

}  // namespace tooljoint::deck
