// SPDX-License-Identifier: BSD-3-Clause
#include "cases/CaseKinds.hpp"

#include <algorithm>
#include <utility>

#include "common/Error.hpp"

namespace tooljoint::cases {

namespace {

/// Lists of the cases in other libraries of the package, as listed in CMakeLists.txt.
constexpr struct {
  const char* list;
  const char* library;
} elsewhere[] = {TOOLJOINT_LISTS_ELSEWHERE};

}  // namespace

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
  const auto reader = [&](const std::vector<std::string>& of) {
    return std::find_if(kinds_.begin(), kinds_.end(), [&](const CaseKind& kind) {
      return std::find_first_of(of.begin(), of.end(), kind.lists.begin(), kind.lists.end()) !=
             of.end();
    });
  };
  for (const auto& [list, library] : elsewhere)
    if (std::find(lists.begin(), lists.end(), list) != lists.end() &&
        reader({list}) == kinds_.end())
      throw DeckError("The list \"" + std::string(list) + "\" is read by " + library +
                      ", which this program is not linked to: "
                      "target_link_libraries(<program> PRIVATE " +
                      library + " Tooljoint::toolkit).");
  const auto it = reader(lists);
  return it == kinds_.end() ? kinds_.front() : *it;
}

namespace {

/// Makes the case of the deck that read() returns. The lists of the deck choose its kind; `file` is
/// its name in errors.
std::unique_ptr<Case> makeCase(
    const std::string& file, const std::function<deck::Deck(const deck::Deck::ChooseSpec&)>& read) {
  const CaseKind* kind = nullptr;
  auto deck = read([&](const std::vector<std::string>& lists) {
    try {
      kind = &CaseKinds::instance().of(lists);
    } catch (const DeckError& error) {
      throw DeckError(file + ": " + error.what());
    }
    return kind->parameters();
  });
  return kind->make(std::move(deck));
}

}  // namespace

std::unique_ptr<Case> readCase(const std::string& file, const std::vector<std::string>& overrides) {
  return makeCase(file, [&](const deck::Deck::ChooseSpec& choose) {
    return deck::Deck::read(file, choose, overrides);
  });
}

std::unique_ptr<Case> parseCase(const std::string& text, const std::string& file,
                                const std::vector<std::string>& overrides) {
  return makeCase(file, [&](const deck::Deck::ChooseSpec& choose) {
    return deck::Deck::parse(text, file, choose, overrides);
  });
}

}  // namespace tooljoint::cases
