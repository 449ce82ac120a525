// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A deck after lexical reading: lists and parameters with the position of each, before the names
/// are checked. Internal to src/deck.
#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/Text.hpp"
#include "deck/reading/Value.hpp"

namespace tooljoint::deck {

/// Position of an entry: a line of the file, or the n-th override of the command line.
struct Place {
  int line = 0;            ///< 1-based; 0 for none
  int overrideNumber = 0;  ///< 1-based; 0 for the file
  std::string overrideText;
  std::string diameter = {};  ///< name of the parameter if it gives the radius
  std::string unit = {};      ///< of its quantity; "" for a number in SI

  bool before(const Place& other) const {
    return overrideNumber != other.overrideNumber ? overrideNumber < other.overrideNumber
                                                  : line < other.line;
  }
  /// "deck.xml:42", or "--set Transient/Step=1"
  std::string text(const std::string& file) const {
    if (overrideNumber > 0)
      return overrideText[0] == '!' ? "--without " + excerpt(overrideText.substr(1))
                                    : "--set " + excerpt(overrideText);
    return line > 0 ? file + ":" + std::to_string(line) : file;
  }
};

struct RawParameter {
  std::string name;
  std::string type;
  std::string text;  ///< value attribute, unchanged
  Value value;
  Place place;
};

/// A list with its parameters and sublists in the order of the file, found by name.
class RawList {
 public:
  std::string name;
  Place place;

  const std::vector<RawParameter>& parameters() const { return parameters_; }
  const std::vector<RawList>& lists() const { return lists_; }

  RawParameter* findParameter(const std::string& wanted) {
    const auto it = parameterIndex_.find(wanted);
    return it == parameterIndex_.end() ? nullptr : &parameters_[it->second];
  }
  const RawParameter* findParameter(const std::string& wanted) const {
    const auto it = parameterIndex_.find(wanted);
    return it == parameterIndex_.end() ? nullptr : &parameters_[it->second];
  }
  RawList* findList(const std::string& wanted) {
    const auto it = listIndex_.find(wanted);
    return it == listIndex_.end() ? nullptr : &lists_[it->second];
  }
  bool holdsParameter(const std::string& wanted) const {
    return parameterIndex_.count(wanted) != 0;
  }
  bool holdsList(const std::string& wanted) const { return listIndex_.count(wanted) != 0; }

  RawParameter& add(RawParameter parameter) {
    parameterIndex_.emplace(parameter.name, parameters_.size());
    parameters_.push_back(std::move(parameter));
    return parameters_.back();
  }
  RawList& add(RawList list) {
    listIndex_.emplace(list.name, lists_.size());
    lists_.push_back(std::move(list));
    return lists_.back();
  }
  /// Removes a list; false if there is none with that name.
  bool removeList(const std::string& unwanted) {
    const auto it = listIndex_.find(unwanted);
    if (it == listIndex_.end()) return false;
    lists_.erase(lists_.begin() + static_cast<std::ptrdiff_t>(it->second));
    listIndex_.clear();
    for (std::size_t i = 0; i < lists_.size(); ++i) listIndex_.emplace(lists_[i].name, i);
    return true;
  }
  /// Removes a parameter; false if there is none with that name.
  bool removeParameter(const std::string& unwanted) {
    const auto it = parameterIndex_.find(unwanted);
    if (it == parameterIndex_.end()) return false;
    parameters_.erase(parameters_.begin() + static_cast<std::ptrdiff_t>(it->second));
    parameterIndex_.clear();
    for (std::size_t i = 0; i < parameters_.size(); ++i)
      parameterIndex_.emplace(parameters_[i].name, i);
    return true;
  }

 private:
  std::vector<RawParameter> parameters_;
  std::vector<RawList> lists_;
  std::unordered_map<std::string, std::size_t> parameterIndex_;
  std::unordered_map<std::string, std::size_t> listIndex_;
};

/// One error with its position; `text` follows "deck.xml:42: ".
struct Finding {
  Place place;
  std::string text;
};

/// Throws all findings, ordered by position, one line each, as one DeckError (at most the first
/// hundred); returns if there are none.
void raise(std::vector<Finding> findings, const std::string& file);

}  // namespace tooljoint::deck
