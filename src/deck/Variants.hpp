// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Adds the registered variants of one kind to the description of a list: a choice that names the
/// variant, and for each variant with its own parameters an optional sublist with the variant's
/// name.
#pragma once

#include <string>
#include <utility>

#include "deck/ListSpec.hpp"
#include "deck/Registry.hpp"

namespace tooljoint::deck {

/// The sublist of a registered variant: its own parameters, under its name.
template <class Entry>
ListSpec variantSpec(const std::string& name, const Entry& entry) {
  const ListSpec& own = entry.parameters;
  return own.doc().empty() ? ListSpec(name, entry.doc).merge(own) : own.named(name);
}

/// `declareVariants<Integrator, ...>(list, "Integrator", "Generalized-alpha", "The time
/// integrator.")`. The sentence of the choice is followed by the description of each variant.
template <class Base, class... Args>
ListSpec& declareVariants(ListSpec& list, const std::string& parameter, Default&& chosen,
                          const std::string& doc) {
  const auto& registry = Registry<Base, Args...>::instance();
  std::string sentence = doc;
  for (const auto& [name, entry] : registry.entries()) sentence += " " + name + ": " + entry.doc;
  list.choice(parameter, std::move(chosen), registry.names(), sentence);
  for (const auto& [name, entry] : registry.entries()) {
    const ListSpec& own = entry.parameters;
    if (own.parameters().empty() && own.lists().empty() && own.pattern() == nullptr) continue;
    list.list(variantSpec(name, entry));
  }
  return list;
}

}  // namespace tooljoint::deck
