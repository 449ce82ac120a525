// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part before reduction: its own second-order model, and which of its dofs others may be joined
/// to.
#pragma once

#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"

namespace tooljoint::model {

/// Generic substructure. Where it came from (a beam mesh, files, a few lines of C++) does not
/// matter.
struct Substructure {
  std::string name;
  SecondOrderModel model;      ///< in physical dofs of this part; all labels Physical
  std::vector<int> interface;  ///< positions of dofs shared with other parts, increasing
  std::vector<int> retained;   ///< positions of further dofs kept as physical coordinates,
                               ///< increasing, disjoint from interface
  Vector
      reference;  ///< state the part is linearised about (static displacement), dofs; zero if empty
  double rounding = 0;  ///< relative difference of entries that the rounding of places leaves
                        ///< between two parts that are the same; 0: those have the same entries

  /// All positions that are neither interface nor retained, increasing.
  std::vector<int> interior() const;
};

}  // namespace tooljoint::model
