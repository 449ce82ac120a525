// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part before reduction: its own second-order model, and the dofs to which others may be joined.
#pragma once

#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"

namespace tooljoint::model {

/// Generic substructure of any origin (a beam mesh, files, a few lines of C++).
struct Substructure {
  std::string name;
  SecondOrderModel model;      ///< in physical dofs of this part; all labels Physical
  std::vector<int> interface;  ///< positions of dofs shared with other parts, increasing
  std::vector<int> retained;   ///< positions of further dofs kept as physical coordinates,
                               ///< increasing, disjoint from interface
  Vector reference;     ///< state of linearisation (static displacement), dofs; zero if empty
  double rounding = 0;  ///< relative difference of entries of identical parts due to rounding of
                        ///< positions; 0: their entries are equal

  /// All positions that are neither interface nor retained, increasing.
  std::vector<int> interior() const;
};

}  // namespace tooljoint::model
