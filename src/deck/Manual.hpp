// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The parameter reference, printed from the descriptions that the reader checks decks against, so
/// that both always agree.
#pragma once

#include <string>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// Markdown: one heading per list with its path, its sentence, and a table of name, type, unit,
/// range or choices, default (or "required") and sentence. `topic` selects a list by name or path
/// ("Contact", "Transient/RK4") with everything below it, or the lists with a parameter of that
/// name; "" prints everything. Throws UsageError for an unknown topic. The text depends only on the
/// description.
std::string manualMarkdown(const ListSpec& root, const std::string& topic = "",
                           int headingLevel = 2);

/// The same for several roots (scene, component library), one after the other; a topic must exist
/// in one of them.
std::string manualMarkdown(const std::vector<ListSpec>& roots, const std::string& topic = "",
                           int headingLevel = 2);

/// JSON with stable keys:
///
///     {"name","doc","required","pass_through",
///      "parameters":[{"name","type","kind","unit","min","max","open_min","open_max",
///                     "choices","required","default","doc"}],
///      "lists":[...],"named_lists":{...}|null}
///
/// Missing bounds and defaults are null. With a topic an array of the lists found, each with its
/// "path".
std::string manualJson(const ListSpec& root, const std::string& topic = "");
std::string manualJson(const std::vector<ListSpec>& roots, const std::string& topic = "");

/// True for the topic "Units": all unit symbols by quantity, with their other spellings and their
/// values in SI.
bool isUnitsTopic(const std::string& topic);
std::string unitsMarkdown(int headingLevel = 2);
/// [{"quantity", "si", "units": [{"unit", "also": [...], "factor"}]}], 1 unit = factor si.
std::string unitsJson();

}  // namespace tooljoint::deck
