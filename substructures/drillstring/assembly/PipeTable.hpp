// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables of drill pipe as printed in catalogues: each row of a CSV file is a joint.
#pragma once

#include <string>
#include <vector>

#include "substructures/drillstring/assembly/Components.hpp"

namespace tooljoint::drillstring {

/// Adds to the library, for each row, the joint NAME and the stand of three joints "NAME stand". A
/// joint consists of box, upset, body, upset and pin, from top to bottom.
///
/// The header names the columns in any order, lengths and strengths with a unit in brackets: Name,
/// Length, Outer Diameter, Inner Diameter, Upset Length, Upset Outer Diameter, Upset Inner
/// Diameter, Tool Joint Outer Diameter, Tool Joint Inner Diameter, Box Length, Pin Length, Yield
/// Strength, Tool Joint Yield Strength. Separators and decimal commas as in surveys.
/// \param standard  material without its yield strength, and element
/// \param faults    a line for each fault: file, line, text found and text expected. A row with a
///                  fault is omitted
void readPipeTable(const std::string& file, const SegmentDefaults& standard,
                   ComponentLibrary& library, std::vector<std::string>& faults);

}  // namespace tooljoint::drillstring
