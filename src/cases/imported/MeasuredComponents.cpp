// SPDX-License-Identifier: BSD-3-Clause
#include "cases/imported/MeasuredComponents.hpp"

#include "coupling/input/ComponentAxes.hpp"

namespace tooljoint::cases {

std::vector<int> measuredComponents(const model::ComponentNames& names) {
  std::vector<int> all, translations;
  for (std::size_t c = 0; c < names.size(); ++c) {
    all.push_back(static_cast<int>(c));
    if (coupling::kindOf(names[c]) == coupling::ComponentKind::Translation)
      translations.push_back(static_cast<int>(c));
  }
  return translations.empty() ? all : translations;
}

}  // namespace tooljoint::cases
