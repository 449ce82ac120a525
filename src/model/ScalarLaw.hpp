// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A named scalar function of time that multiplies a constant matrix or load vector.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/SharedList.hpp"

namespace tooljoint::model {

/// Named scalar law of time. Two laws with one name are the same law: coupling merges them by name.
struct ScalarLaw {
  std::string name;                     ///< "1", "Omega", "sqrt|Omega|", "dOmega/dt", ...
  std::function<double(double)> value;  ///< value at time t [s]
  /// Increasing times [s] at which the value or its rate changes at once: steps that choose their
  /// length end there, and steps of one length are warned of what they miss.
  std::vector<double> corners = {};

  /// The law that is 1 at all times; every model has it at index 0.
  static ScalarLaw one() {
    return {kOne, [](double) { return 1.0; }};
  }
  /// Whether it is one(): what it multiplies is constant.
  bool isOne() const { return isOne(name); }
  /// Whether a file, or a model that names its laws, means one().
  static bool isOne(const std::string& name) { return name == kOne; }
  /// The list of a model whose terms are all constant: ScalarLaw::one() alone.
  static const SharedList<ScalarLaw>& constant() {
    static const SharedList<ScalarLaw> list{one()};
    return list;
  }

  static constexpr const char* kOne = "1";  ///< name of one()
};

}  // namespace tooljoint::model
