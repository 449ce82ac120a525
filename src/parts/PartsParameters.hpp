// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list `Parts`: the parts of a model, their files, loads and initial
/// conditions.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/ListSpec.hpp"
#include "model/ScalarLaw.hpp"

namespace tooljoint::parts {

/// One part of a scene.
struct ImportedPart {
  std::string name;
  std::string where;                   ///< path of its list, for messages
  std::string file;                    ///< as given in the deck
  Matrix3 axes = Matrix3::Identity();  ///< axes of the part in the common frame, columns
  bool turned = false;
  std::vector<std::string> fixed;
  std::vector<std::string> retained;
  bool reduce = true;
};

/// A load on one dof: value times a law of time.
struct PartLoad {
  std::string name;
  std::string where;
  std::string part;
  int node = 0;
  std::string component;
  double value = 0;
  std::string law = "1";
};

/// Initial displacement and velocity of one dof.
struct PartStart {
  std::string where;
  std::string part;
  int node = 0;
  std::string component;
  double displacement = 0;
  double velocity = 0;
};

struct PartsSettings {
  std::string where = "Parts";
  std::vector<ImportedPart> imported;
  std::vector<std::string> joints;
  bool atRest = false;  ///< the motion starts from the equilibrium of the loads
  std::vector<PartLoad> loads;
  std::vector<PartStart> starts;
  std::vector<model::ScalarLaw> laws;
};

/// Description of the list `Parts`.
deck::ListSpec parameters();

/// Typed values of the validated list. DeckError: no part, an axis without length, inconsistent
/// laws.
PartsSettings readSettings(const Teuchos::ParameterList& list);

}  // namespace tooljoint::parts
