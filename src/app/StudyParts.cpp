// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <map>

#include "app/PartsDeck.hpp"
#include "app/PartsRecording.hpp"
#include "app/StudyScene.hpp"
#include "common/Text.hpp"
#include "study/RowStore.hpp"

namespace tooljoint::app {

namespace {

/// Parts put together, and the state they start from once it is found.
struct StartedParts {
  PartsDeck deck;
  coupling::Coupling whole;
  Vector rest;
  bool found = false;
};
using SharedParts = std::map<std::string, std::shared_ptr<StartedParts>>;

void append(std::string& text, const double* values, Eigen::Index count) {
  text.append(reinterpret_cast<const char*>(values),
              static_cast<std::size_t>(count) * sizeof(double));
}

void append(std::string& text, const Sparse& matrix) {
  for (int row = 0; row < matrix.outerSize(); ++row)
    for (Sparse::InnerIterator it(matrix, row); it; ++it) {
      text += std::to_string(row) + "," + std::to_string(it.col()) + ";";
      append(text, &it.value(), 1);
    }
}

/// Imported parts, joined.
class PartsStudy : public StudyScene {
 public:
  PartsStudy(PartsDeck lists, std::shared_ptr<SharedParts> shared)
      : lists_(std::move(lists)), shared_(std::move(shared)) {
    auto key = lists_.list();
    for (const char* name : {"Reduction", "Transient", "Output", "Study"}) key.remove(name, false);
    auto& parts = (*shared_)[study::canonicalText(key) + formatNumber(lists_.startTime())];
    if (!parts) {
      const auto fresh = std::make_shared<StartedParts>(StartedParts{lists_, {}, {}, false});
      fresh->deck.build();
      parts = fresh;
    }
    parts_ = parts;
  }

  const deck::Deck& deck() const override { return lists_.deck; }
  std::unique_ptr<StudyScene> with(const std::vector<std::string>& overrides) const override {
    RunOptions options;
    options.deck = lists_.deck.file();
    options.overrides = overrides;
    return std::make_unique<PartsStudy>(readPartsLists(options), shared_);
  }
  std::vector<std::string> reductionLists() const override { return {"Reduction"}; }
  int nodes() const override { return static_cast<int>(parts_->deck.scene.nodes.size()); }
  std::string folder() const override { return lists_.output.folder; }

  /// The matrices and loads that were read.
  std::string files() const override {
    std::string text;
    for (const auto& content : parts_->deck.scene.contents) {
      const auto& model = content.part.model;
      append(text, model.mass);
      for (const auto& term : model.damping) append(text, term.matrix);
      for (const auto& term : model.stiffness) append(text, term.matrix);
      for (const auto& load : model.loads) append(text, load.vector.data(), load.vector.size());
      append(text, model.recovery);
    }
    return text;
  }

  void summarise(io::Summary& summary) const override {
    app::summarise(lists_, parts_->deck.whole(), summary);
  }

  void settle() override {
    if (!parts_->found) {
      parts_->deck.start();
      parts_->whole = parts_->deck.whole();
      parts_->rest = restOf(parts_->whole);
      parts_->found = true;
    }
    requireMass(lists_.deck, parts_->deck.scene, parts_->whole.model);
  }

  coupling::Coupling full() const override { return parts_->whole; }
  coupling::ResolvedCoupling parts() const override {
    return {parts_->deck.scene.parts, parts_->deck.scene.coupling};
  }
  Vector rest() const override { return parts_->rest; }

  /// Translations, or everything where there are none; nothing is known of walls and bits.
  Measures measures() const override {
    Measures m;
    m.nodes = parts_->whole.model.recoveryNodes;
    m.components = measuredComponents(parts_->whole.model.componentNames);
    m.vibrating = m.components.size();
    m.clearance.assign(m.nodes.size(), std::numeric_limits<double>::infinity());
    return m;
  }

  void write(io::ResultsFile& file) const override {
    writePartsModel(parts_->deck, parts_->whole.model, file);
  }

 private:
  PartsDeck lists_;  ///< of this run; its scene stays empty
  std::shared_ptr<SharedParts> shared_;
  std::shared_ptr<StartedParts> parts_;
};

}  // namespace

std::unique_ptr<StudyScene> readPartsStudy(const RunOptions& options) {
  return std::make_unique<PartsStudy>(readPartsLists(options), std::make_shared<SharedParts>());
}

}  // namespace tooljoint::app
