// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// name -> {factory, documented parameters, one sentence}. A new basis, integrator, trajectory or
/// law is one new file that registers itself; no other file changes.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "deck/Defaults.hpp"
#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// Registry of the variants of Base, made from Args...: first a `const Teuchos::ParameterList&`
/// with the variant's parameters, in which the registry fills in the defaults of absent ones.
template <class Base, class... Args>
class Registry {
 public:
  struct Entry {
    std::string doc;      ///< one sentence: what it is, and its source
    ListSpec parameters;  ///< the sublist named after the variant; empty when it has no parameters
                          ///< of its own
    std::function<std::unique_ptr<Base>(Args...)> make;
  };

  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  /// Call from a namespace-scope constant in the variant's own file: `const bool registered =
  /// Registry<...>::instance().add(...)`.
  bool add(const std::string& name, Entry entry) {
    return entries_.emplace(name, std::move(entry)).second;
  }

  const Entry& find(const std::string& name) const {
    const auto it = entries_.find(name);
    if (it == entries_.end()) {
      std::string known;
      for (const auto& [key, entry] : entries_)
        known += (known.empty() ? "\"" : ", \"") + key + "\"";
      throw DeckError("Unknown name \"" + name + "\". Available: " + known + ".");
    }
    return it->second;
  }

  std::unique_ptr<Base> make(const std::string& name, Args... args) const {
    return makeFrom(find(name), std::forward<Args>(args)...);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& [key, entry] : entries_) out.push_back(key);
    return out;
  }

  const std::map<std::string, Entry>& entries() const { return entries_; }

 private:
  template <class... Others>
  static std::unique_ptr<Base> makeFrom(const Entry& entry, const Teuchos::ParameterList& list,
                                        Others&&... others) {
    std::unique_ptr<Base> made;
    withDefaults(entry.parameters, list, [&](const Teuchos::ParameterList& filled) {
      made = entry.make(filled, std::forward<Others>(others)...);
    });
    return made;
  }

  std::map<std::string, Entry> entries_;
};

}  // namespace tooljoint::deck
