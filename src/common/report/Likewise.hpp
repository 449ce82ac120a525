// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Prints sentences on many runs that differ only in numbers once, with a count.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

namespace tooljoint {

/// Removes the numbers of a sentence: digits, points and signs, and the e of an exponent.
inline std::string withoutNumbers(const std::string& text) {
  const auto isDigit = [](char letter) {
    return std::isdigit(static_cast<unsigned char>(letter)) != 0;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    const bool exponent = letter == 'e' && i > 0 && isDigit(text[i - 1]) && i + 1 < text.size() &&
                          (isDigit(text[i + 1]) || text[i + 1] == '-' || text[i + 1] == '+');
    if (!isDigit(letter) && !exponent && letter != '.' && letter != '-' && letter != '+')
      out += letter;
  }
  return out;
}

class LikewiseList {
 public:
  /// \param kind      common beginning of sentences of the same kind
  /// \param reason    may differ in its numbers
  /// \param sentence  printed if it is the first of its kind
  void add(const std::string& kind, const std::string& reason, const std::string& sentence) {
    const auto key = kind + '\n' + withoutNumbers(reason);
    const auto known = std::find_if(groups_.begin(), groups_.end(),
                                    [&](const Group& one) { return one.key == key; });
    if (known == groups_.end())
      groups_.push_back({key, {sentence}});
    else if (std::find(known->sentences.begin(), known->sentences.end(), sentence) ==
             known->sentences.end())
      known->sentences.push_back(sentence);
  }
  bool empty() const { return groups_.empty(); }

  /// The first sentence of each kind, with the number of other different ones.
  std::vector<std::string> told(const std::string& thing) const {
    std::vector<std::string> out;
    for (const auto& group : groups_) {
      const auto further = group.sentences.size() - 1;
      out.push_back(group.sentences.front());
      if (further > 0)
        out.back() += " (" + std::to_string(further) + " further " + thing +
                      (further > 1 ? "s" : "") + " likewise)";
    }
    return out;
  }

 private:
  struct Group {
    std::string key;
    std::vector<std::string> sentences;
  };

  std::vector<Group> groups_;
};

}  // namespace tooljoint
