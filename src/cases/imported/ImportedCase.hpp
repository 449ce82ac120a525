// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parts from files, joined, as a case.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "cases/imported/ImportedDeck.hpp"
#include "cases/recording/RecordedNodes.hpp"
#include "stability/StateStability.hpp"

namespace tooljoint::cases {

/// Parts put together, and the state they start from once it is found.
struct JoinedParts {
  parts::PartsScene scene;
  coupling::Coupling whole;                            ///< unreduced, always primal
  bool started = false;                                ///< the parts hold the state they start from
  std::optional<stability::StateStability> stability;  ///< of their rest, or of the state that a
                                                       ///< response is linearised about
};

class ImportedCase : public Case, public NodeChoice {
 public:
  /// Reads the parts and puts them together. ModelError, FileError, DeckError.
  explicit ImportedCase(ImportedDeck lists);

  const deck::Deck& deck() const override { return lists_->deck; }
  std::unique_ptr<Case> with(const std::vector<std::string>& overrides) const override;
  std::vector<std::string> reductionLists() const override { return {"Reduction"}; }
  bool reducesWithoutMotion() const override { return true; }
  const io::OutputSettings& output() const override { return lists_->common.output; }
  /// `Output/Nodes`.
  std::vector<std::int64_t> recordedNodes() const override;
  /// The matrices and loads that were read.
  std::string files() const override;
  int nodes() const override { return static_cast<int>(joined_->scene.nodes.size()); }
  int components() const override;
  int freeDofs() const override { return joined_->whole.model.size(); }
  std::string describe() const override;
  std::vector<std::string> remarks() const override;
  void summarise(io::Summary& summary) const override;
  CaseOutline outline() const override;
  /// The parts may not come to rest, and a basis with interface forces leaves interface dofs to its
  /// modes, which may not start where the neighbours do: only the reduction shows it.
  void verify() const override;
  std::shared_ptr<const RestingCase> solveStatic() const override;

 private:
  /// Joined parts by the lists they depend on.
  using Shared = std::map<std::string, std::shared_ptr<JoinedParts>>;
  ImportedCase(ImportedDeck lists, std::shared_ptr<Shared> shared);
  /// A sentence on a name that is not there.
  std::string unknownNode(const std::string& name) const;

  std::shared_ptr<const ImportedDeck> lists_;
  std::shared_ptr<Shared> shared_;
  std::shared_ptr<JoinedParts> joined_;
};

}  // namespace tooljoint::cases
