// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Study`: runs to compare, their reference, and the window of comparison.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::study {

/// One dimension of a method: a parameter of the deck and its values.
struct Dimension {
  std::string name;  ///< of its list
  std::string parameter;
  std::vector<std::string> values;
};

/// One line of the plots: overrides of the deck, and dimensions whose product gives its runs.
struct Method {
  std::string name;   ///< of its list
  std::string label;  ///< in tables and plots
  bool reduced = false;
  std::vector<std::string> set;
  std::vector<Dimension> sweep;  ///< the last one varies first
};

/// Published points, with the time of their machine.
struct Published {
  std::string label;
  std::vector<double> cpu;    ///< CPU time per simulated second [s]
  std::vector<double> error;  ///< of each point, or empty
  std::vector<std::string> points;
};

struct StudySettings {
  std::optional<double>
      window;  ///< length of the window of pointwise errors, from the start of the motion [s]
  std::optional<double> end;  ///< end time of every run [s]
  int repeats = 3;
  bool statistics = true;
  bool pictures = true;
  int frequencies = 0;                 ///< number of coupled frequencies that are compared with the
                                       ///< full model
  std::string baseline;                ///< label of a run; empty: none
  double perturbation = 1e-10;         ///< [m]; 0: no sensitivity
  std::optional<double> timeLimit;     ///< CPU seconds of one run
  std::vector<std::string> reference;  ///< overrides of the reference run
  std::vector<std::string> check;      ///< further overrides of its check
  std::vector<Method> methods;
  std::vector<Published> published;
};

/// Length of the window if the deck gives none [s].
constexpr double defaultWindow = 3.0;

/// Description of the list `Study`.
deck::ListSpec parameters();

/// Typed values of the list. DeckError with one line per fault: no method, an empty sweep, two
/// equal labels, a reference without its check, invalid overrides.
StudySettings readStudy(const Teuchos::ParameterList& list);

}  // namespace tooljoint::study
