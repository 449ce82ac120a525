// SPDX-License-Identifier: BSD-3-Clause
#include "cases/CaseKinds.hpp"

#include <algorithm>

namespace tooljoint::cases {

CaseKinds& CaseKinds::instance() {
  static CaseKinds kinds;
  return kinds;
}

bool CaseKinds::add(CaseKind kind) {
  const auto lower = [&](const CaseKind& other) { return other.precedence < kind.precedence; };
  kinds_.insert(std::find_if(kinds_.begin(), kinds_.end(), lower), std::move(kind));
  return true;
}

const CaseKind& CaseKinds::of(const std::vector<std::string>& lists) const {
  const auto claims = [&](const CaseKind& kind) {
    return std::find_first_of(lists.begin(), lists.end(), kind.lists.begin(), kind.lists.end()) !=
           lists.end();
  };
  const auto it = std::find_if(kinds_.begin(), kinds_.end(), claims);
  return it == kinds_.end() ? kinds_.front() : *it;
}

std::unique_ptr<Case> readCase(const std::string& file, const std::vector<std::string>& overrides) {
  const CaseKind* kind = nullptr;
  auto deck = deck::Deck::read(
      file,
      [&](const std::vector<std::string>& lists) {
        kind = &CaseKinds::instance().of(lists);
        return kind->parameters();
      },
      overrides);
  return kind->make(std::move(deck));
}

}  // namespace tooljoint::cases
