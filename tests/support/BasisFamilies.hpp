// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction and coupling by any family of bases, for tests that run over families.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "coupling/CoupledModes.hpp"
#include "coupling/Synthesis.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace tooljoint::samples {

/// A basis with its parameters.
struct Family {
  std::string basis;
  std::string parameter;  ///< name of a parameter not at its default; empty: none
  std::string text;       ///< its value, when it is a text
  bool flag = false;      ///< its value, when `text` is empty

  std::string name() const {
    return basis + (parameter.empty() ? ""
                                      : ", " + parameter + " " +
                                            (text.empty() ? (flag ? "true" : "false") : text));
  }
  std::unique_ptr<reduction::ReductionMethod> make() const {
    Teuchos::ParameterList list;
    auto& own = list.sublist(basis);
    if (!parameter.empty() && text.empty()) own.set(parameter, flag);
    if (!parameter.empty() && !text.empty()) own.set(parameter, text);
    return reduction::makeBasis(basis, list);
  }
};

/// Free-interface families, and those that are Rayleigh-Ritz among them.
inline std::vector<Family> freeFamilies() {
  return {{"Guyan", "", ""},
          {"Rubin", "", ""},
          {"Craig-Chang", "", ""},
          {"Herting", "", ""},
          {"Herting", "Mode Supports", "Fixed"},
          {"Herting", "Inertia Relief", "", false},
          {"MacNeal", "", ""},
          {"Dual Craig-Bampton", "", ""},
          {"Dual Craig-Bampton", "Residual Mass", "", true}};
}
inline bool isRitz(const Family& family) {
  return family.basis != "MacNeal" && family.basis != "Dual Craig-Bampton";
}

/// `count` modes of a part.
inline reduction::ModeRequest modes(int count) {
  reduction::ModeRequest request;
  request.kind = reduction::ModeRequest::Kind::Count;
  request.count = count;
  return request;
}

/// `modes` for every part; negative: all.
inline reduction::ReductionOptions modeCount(const std::string& basis, int modes) {
  reduction::ReductionOptions options;
  options.basis = basis;
  if (modes < 0) return options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  return options;
}

inline coupling::Synthesis synthesised(const std::vector<model::Substructure>& parts,
                                       const Family& family, int modes,
                                       const coupling::CouplingOptions& coupling = {}) {
  const auto basis = family.make();
  return coupling::synthesise(parts, *basis, modeCount(family.basis, modes), coupling);
}

/// omega^2 of the lowest modes of the coupled model, spurious negative ones (below -`bound`) left
/// out.
inline Vector eigenvalues(const model::SecondOrderModel& m, double bound = 1e300) {
  const Vector all = coupling::lowestModes(m, m.size()).values;
  Eigen::Index first = 0;
  while (first < all.size() && all[first] < -bound) ++first;
  return all.tail(all.size() - first);
}

}  // namespace tooljoint::samples
