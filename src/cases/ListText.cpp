// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ListText.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_any.hpp>
#include <map>
#include <sstream>

#include "common/Text.hpp"

namespace tooljoint::cases {

std::string valueText(const Teuchos::ParameterEntry& entry) {
  const auto& any = entry.getAny(false);
  if (any.type() == typeid(double)) return formatNumber(Teuchos::any_cast<double>(any));
  if (any.type() == typeid(Teuchos::Array<double>)) {
    std::string text;
    for (double value : Teuchos::any_cast<Teuchos::Array<double>>(any))
      text += formatNumber(value) + ",";
    return text;
  }
  std::ostringstream out;
  out << any;
  return out.str();
}

std::string canonicalText(const Teuchos::ParameterList& list) {
  std::map<std::string, std::string> lines;
  for (auto it = list.begin(); it != list.end(); ++it) {
    const auto& name = list.name(it);
    lines[name] = list.isSublist(name) ? "{\n" + canonicalText(list.sublist(name)) + "}"
                                       : "= " + valueText(list.entry(it));
  }
  std::string text;
  for (const auto& [name, value] : lines) text += name + " " + value + "\n";
  return text;
}

}  // namespace tooljoint::cases
