// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A case of joined parts from files.
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

/// Joined parts, and their initial state once it is computed.
struct JoinedParts {
  parts::PartsScene scene;
  coupling::Coupling whole;                            ///< unreduced, always primal
  bool started = false;                                ///< the parts are in their initial state
  std::optional<stability::StateStability> stability;  ///< of the state at rest, or of the state
                                                       ///< about which a response is linearised
};

class ImportedCase : public Case, public NodeChoice {
 public:
  /// Reads the parts and joins them. ModelError, FileError, DeckError.
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
  /// Solves for rest and reduces: the parts may not come to rest, and a basis with interface forces
  /// represents interface dofs by its modes, whose initial state may not match that of the
  /// neighbours.
  void verify() const override;
  std::shared_ptr<const RestingCase> solveStatic() const override;

 private:
  /// Joined parts by the lists they depend on.
  using Shared = std::map<std::string, std::shared_ptr<JoinedParts>>;
  ImportedCase(ImportedDeck lists, std::shared_ptr<Shared> shared);
  /// A sentence for an unknown node name.
  std::string unknownNode(const std::string& name) const;

  std::shared_ptr<const ImportedDeck> lists_;
  std::shared_ptr<Shared> shared_;
  std::shared_ptr<JoinedParts> joined_;
};

}  // namespace tooljoint::cases
