// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction of parts: basis, projection, checks; distributed over the MPI ranks.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/Substructure.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "reduction/selection/ModeChoice.hpp"
#include "reduction/vectors/LoadVectors.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::reduction {

struct ReducedCore;
class InterfaceBasis;

/// Initial state in reduced coordinates.
enum class InitialState {
  KeepStatic,    ///< D = D_s + Phi q: the part is reduced about its reference state; q(0) is 0 when
                 ///< it starts there
  LeastSquares,  ///< D = Phi q, q_C(0) = D_C(0), q_D(0) by least squares: Nguyen et al. 2020,
                 ///< (38)-(42)
};

/// All choices of the deck list "Reduction" that are common to all bases.
struct ReductionOptions {
  std::string basis = "Craig-Bampton";
  ModeRule modes;
  InitialState initialState = InitialState::KeepStatic;
  bool checks = true;
  LoadVectorOptions loadVectors;  ///< static responses to loads in addition to the modes; none by
                                  ///< default
  std::shared_ptr<const linalg::EigenOptions> eigen;  ///< null: the defaults of the eigensolver
  std::shared_ptr<const InterfaceBasis> interface;  ///< reduction of the joined dofs of the coupled
                                                    ///< model (coupling::synthesise); null: none
};

/// Reads the list "Reduction" (defaults filled in). Throws DeckError, also those of
/// readModeSelection. The options refer to the sublist "Anasazi" of the list, so the list must
/// outlive them.
ReductionOptions readOptions(const Teuchos::ParameterList& reduction, int parts);

/// The basis named in the list, made from the sublist of its name.
std::unique_ptr<ReductionMethod> makeBasis(const std::string& name,
                                           const Teuchos::ParameterList& reduction);

/// Projects `part` on `basis`: M, C_i, K_i, loads, point rows, recovery and initial state. Matrices
/// are projected completely, unsymmetric parts included (Nguyen et al. 2020, (43)). Constant
/// stiffness terms become one term; every other term keeps its law. `index` numbers the part in the
/// labels of its modes.
ReducedSubstructure reduce(const PartView& part, const Basis& basis,
                           const ReductionOptions& options, int index);

/// Reduces all parts. Every rank passes the same parts and gets the same result; each part is
/// reduced by one rank and sent to the others. Identical parts (findIdenticalParts) are reduced
/// once. Collective over MPI_COMM_WORLD. An error on one rank is thrown on all. Throws ModelError,
/// ConvergenceError.
std::vector<ReducedSubstructure> reduceAll(const std::vector<model::Substructure>& parts,
                                           const ReductionMethod& basis,
                                           const ReductionOptions& options);

/// Data shared by several rounds of reduction of the same parts: their views, the classes of
/// identical parts, and every reduction so far by its number of modes. The same on every rank
/// except for the views.
struct ReductionCache {
  bool remembers = true;
  std::vector<PartView> views;  ///< one for each part
  std::vector<int> classes;     ///< findIdenticalParts; empty before the first round
  std::map<std::pair<int, int>, std::shared_ptr<const ReducedCore>>
      cores;  ///< by class and requested number of modes
};

/// The same with the reductions of earlier rounds. If the cache stores them (`remembers`), only
/// parts with a new number of modes are reduced; this needs ModeRule::Kind::PerPart.
std::vector<ReducedSubstructure> reduceAll(const std::vector<model::Substructure>& parts,
                                           const ReductionMethod& basis,
                                           const ReductionOptions& options, ReductionCache& cache);

/// The same from a deck list.
std::vector<ReducedSubstructure> reduceAll(const std::vector<model::Substructure>& parts,
                                           const Teuchos::ParameterList& reduction);

/// summaryTable of the reports.
std::string summaryTable(const std::vector<ReducedSubstructure>& parts);

}  // namespace tooljoint::reduction
