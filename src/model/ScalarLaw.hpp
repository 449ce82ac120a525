// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A named scalar function of time that multiplies a constant matrix or load vector.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/SharedList.hpp"

namespace tooljoint::model {

/// Named scalar law of time. Laws with the same name are the same law: coupling merges them by
/// name.
struct ScalarLaw {
  std::string name;                     ///< "1", "Omega", "sqrt|Omega|", "dOmega/dt", ...
  std::function<double(double)> value;  ///< value at time t [s]
  /// Increasing times [s] at which the value or its rate jumps. Steps of variable length end there;
  /// for steps of equal length the run warns of missed parts of the law.
  std::vector<double> corners = {};

  /// The law that is 1 at all times; every model has it at index 0.
  static ScalarLaw one() {
    return {kOne, [](double) { return 1.0; }};
  }
  /// Whether it is one(), so that its matrix or load is constant.
  bool isOne() const { return isOne(name); }
  /// Whether a name in a file or a model means one().
  static bool isOne(const std::string& name) { return name == kOne; }
  /// Law list of a model with constant terms only: ScalarLaw::one().
  static const SharedList<ScalarLaw>& constant() {
    static const SharedList<ScalarLaw> list{one()};
    return list;
  }

  static constexpr const char* kOne = "1";  ///< name of one()
};

}  // namespace tooljoint::model
