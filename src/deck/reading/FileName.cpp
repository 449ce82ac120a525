// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/FileName.hpp"

#include <Teuchos_ParameterList.hpp>
#include <filesystem>

namespace tooljoint::deck {

void markOrigin(Teuchos::ParameterList& list, const std::string& file) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    if (list.isSublist(name))
      markOrigin(list.sublist(name), file);
    else if (list.isType<std::string>(name))
      list.getEntry(name).setDocString(file);
  }
}

std::string fileName(const Teuchos::ParameterList& list, const std::string& parameter) {
  const auto& name = list.get<std::string>(parameter);
  const std::filesystem::path origin(list.getEntry(parameter).docString()), path(name);
  if (path.is_absolute() || !origin.has_parent_path()) return name;
  return (origin.parent_path() / path).string();
}

}  // namespace tooljoint::deck
