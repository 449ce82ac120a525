// SPDX-License-Identifier: BSD-3-Clause
#include "cases/imported/ImportedDeck.hpp"

#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/vectors/LoadVectors.hpp"
#include "statics/NoxSolver.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::cases {

namespace {

/// Errors that concern several lists.
void crossCheck(const ImportedDeck& deck, Faults& faults) {
  const auto& output = deck.common.output;
  if (deck.deck.gives("Output/XDMF") && output.xdmf)
    faults.add("Output/XDMF",
               "has no effect in a scene of parts: files of parts say nothing of what they look "
               "like. Leave it out.");
  if (deck.deck.gives("Output/XDMF Interval"))
    faults.add("Output/XDMF Interval", "has no effect in a scene of parts. Leave it out.");
  if (output.exportFormat != io::ExportFormat::None && !deck.reduces())
    faults.add("Output/Export Parts",
               "has no effect without a Reduction list. Add one, or leave it out.");
  std::vector<std::string> names;
  for (const auto& part : deck.settings.imported) names.push_back(part.name);
  checkCommonLists(deck.list(), deck.common, names, faults);
}

/// Adds file and line to the messages of `work`.
template <class Work>
auto locating(const deck::Deck& deck, const Work& work) {
  const Faults faults(deck, importedSpec());
  try {
    return work();
  } catch (const DeckError& fault) {
    throw DeckError(faults.located(fault.what()));
  } catch (const ModelError& fault) {
    throw ModelError(faults.located(fault.what()));
  }
}

}  // namespace

deck::ListSpec importedSpec() {
  deck::ListSpec scene(
      "Scene",
      "A scene of parts from files: what they are, how they are joined, and what to compute.");
  auto parts = parts::parameters();
  scene.requiredList(parts);
  scene.list(coupling::parameters());
  addCommonLists(scene);
  return scene;
}

ImportedDeck::ImportedDeck(deck::Deck read) : deck(std::move(read)) {
  Faults faults(deck, importedSpec());
  faults.attempt([&] { settings = parts::readSettings(list().sublist("Parts")); });
  common = readCommonLists(list(), faults);
  if (reduces())
    faults.attempt([&] {
      reduction::readOptions(list().sublist("Reduction"),
                             static_cast<int>(settings.imported.size()));
      estimate::readEstimateOptions(list().sublist("Reduction"));
    });
  faults.raise();
  crossCheck(*this, faults);
  faults.raise();
}

double ImportedDeck::startTime() const {
  return moves() ? list().sublist("Transient").get<double>("Start Time") : 0.0;
}

parts::PartsScene ImportedDeck::build() const {
  return locating(deck, [&] {
    return parts::buildScene(settings, common.coupling.value_or(coupling::CouplingInput()),
                             [&](const std::string& name) { return deck.resolve(name); });
  });
}

void ImportedDeck::checkReduction(const parts::PartsScene& scene) const {
  if (!reduces()) return;
  locating(deck, [&] {
    const auto& reduction = list().sublist("Reduction");
    std::vector<reduction::PartOutline> outlines;
    for (const auto& part : scene.parts)
      outlines.push_back({part.name, part.model.size(), !part.interior().empty()});
    reduction::makeBasis(reduction.get<std::string>("Basis"), reduction)->checkInput(outlines);
    reduction::requirePointNodes(scene.parts, reduction::readLoadVectors(reduction));
  });
}

Vector ImportedDeck::start(parts::PartsScene& scene) const {
  return locating(deck, [&] {
    return parts::findStart(settings, startTime(),
                            statics::noxSolver(Teuchos::ParameterList("Static")), scene);
  });
}

void ImportedDeck::requireMass(const parts::PartsScene& scene,
                               const model::SecondOrderModel& full) const {
  if (!moves() || !transient::isExplicit(list().sublist("Transient"))) return;
  const Vector diagonal = full.mass.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (diagonal[i] > 0.0) continue;
    const auto& label = full.dofs[static_cast<std::size_t>(i)];
    std::string who = "A mode";
    if (label.kind == model::DofLabel::Kind::Physical) {
      const auto& name = scene.nodes.at(label.entity).front();
      const auto& part = scene.contents[static_cast<std::size_t>(name.part)];
      who = full.componentNames[static_cast<std::size_t>(label.component)] + " of node " +
            std::to_string(name.node) + " of part \"" + part.part.name + "\" (" + part.file + ")";
    }
    throw ModelError(
        deck.error("Transient/Integrator",
                   "is \"" + deck.list().sublist("Transient").get<std::string>("Integrator") +
                       "\", which needs a mass at every dof, but " + who +
                       " has none. Use Generalized-alpha, or give that dof a mass."));
  }
}

}  // namespace tooljoint::cases
