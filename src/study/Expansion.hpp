// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Expands methods and their sweeps into single runs, each a list of overrides of the deck.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/StudyParameters.hpp"

namespace tooljoint::study {

/// One override and the parameter of the Study list that contains it.
struct SourcedOverride {
  std::string text;    ///< "PATH=VALUE" or "!PATH"
  std::string source;  ///< "Study/Methods/explicit/Set"
};

/// The role of a run in a study.
enum class RunKind { Reference, Check, Sensitivity, Method };
std::string kindName(RunKind kind);

struct PlannedRun {
  RunKind kind = RunKind::Method;
  std::string source;  ///< the list it comes from, "Study/Methods/explicit"
  std::string method;  ///< label of its method
  std::string line;    ///< label of its line in the plots: the method and all but the last
                       ///< dimension
  std::string label;   ///< label of the run: the method and all dimensions
  bool reduced = false;
  std::vector<SourcedOverride> overrides;
  std::vector<std::pair<std::string, std::string>> sweep;  ///< parameter and value
};

/// Lists that a full model does not use.
using ReductionLists = std::vector<std::string>;

/// The runs of all methods, in the order of the deck; the last dimension of a sweep varies first.
std::vector<PlannedRun> expand(const StudySettings& settings,
                               const ReductionLists& reduction = {"Substructures", "Reduction"});

/// The product of the values of `dimensions`; the last one varies first. Labels are that of `base`
/// and the values. \param place  path of the list that holds the dimensions
std::vector<PlannedRun> product(const std::vector<Dimension>& dimensions, const PlannedRun& base,
                                const std::string& place);

/// The reference run, its check, and the perturbed one unless the perturbation is 0.
std::vector<PlannedRun> references(const StudySettings& settings,
                                   const ReductionLists& reduction = {"Substructures",
                                                                      "Reduction"});

}  // namespace tooljoint::study
