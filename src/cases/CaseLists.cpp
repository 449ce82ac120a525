// SPDX-License-Identifier: BSD-3-Clause
#include "cases/CaseLists.hpp"

#include <algorithm>
#include <utility>

#include "cases/PartsExport.hpp"
#include "cases/ReductionRules.hpp"
#include "cases/figures/FigureWindow.hpp"
#include "common/Text.hpp"
#include "reduction/ReductionParameters.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::cases {

AnalysisLists& AnalysisLists::instance() {
  static AnalysisLists lists;
  return lists;
}

bool AnalysisLists::add(AnalysisList list) {
  const auto after = std::upper_bound(lists_.begin(), lists_.end(), list,
                                      [](const auto& a, const auto& b) { return a.name < b.name; });
  lists_.insert(after, std::move(list));
  return true;
}

Faults::Faults(const deck::Deck& deck, const deck::ListSpec& spec) : deck_(deck) {
  for (const auto& list : spec.lists()) roots_.push_back(list.name());
}

std::string Faults::located(const std::string& message) const {
  std::vector<std::string> lines;
  for (const auto& line : split(message, '\n')) {
    std::string rooted = line;
    // "Loads/Unbalance/a needs ..." -> "/scene/Loads/Unbalance/a needs ..."
    for (const auto& name : roots_)
      if (line.rfind(name + "/", 0) == 0 || line.rfind(name + " ", 0) == 0)
        rooted = "/" + deck_.name() + "/" + line;
    lines.push_back(deck_.located(rooted));
  }
  return join(lines, "\n");
}

void Faults::keep(const std::string& message) { lines_.push_back(located(message)); }

void Faults::add(const std::string& path, const std::string& sentence) {
  lines_.push_back(deck_.error(path, sentence));
}

void Faults::raise() const {
  if (!none()) throw DeckError(join(lines_, "\n"));
}

void addCommonLists(deck::ListSpec& scene) {
  scene.list(reduction::parameters());
  scene.list(transient::parameters());
  scene.list(io::parameters());
  for (const auto& analysis : AnalysisLists::instance().lists()) scene.list(analysis.parameters());
}

Teuchos::ParameterList listOrDefaults(const Teuchos::ParameterList& deck,
                                      const deck::ListSpec& spec) {
  return deck.isSublist(spec.name()) ? deck.sublist(spec.name()) : deck::defaults(spec);
}

CommonLists readCommonLists(const Teuchos::ParameterList& deck, Faults& faults) {
  CommonLists out;
  faults.attempt([&] { out.output = io::readOutput(listOrDefaults(deck, io::parameters())); });
  if (deck.isSublist("Transient"))
    faults.attempt([&] { transient::readOptions(deck.sublist("Transient")); });
  if (deck.isSublist("Coupling"))
    faults.attempt([&] { out.coupling = coupling::readCoupling(deck.sublist("Coupling")); });
  for (const auto& analysis : AnalysisLists::instance().lists())
    if (deck.isSublist(analysis.name))
      faults.attempt([&] { analysis.read(deck.sublist(analysis.name)); });
  return out;
}

void checkCommonLists(const Teuchos::ParameterList& deck, const CommonLists& common,
                      const std::vector<std::string>& parts, Faults& faults) {
  if (deck.isSublist("Transient"))
    faults.attempt([&] { figureWindow(common.output.figures, deck.sublist("Transient")); });
  if (common.output.exportFormat != io::ExportFormat::None)
    faults.attempt([&] { exportedFiles(parts, common.output.exportFormat); });
  const auto assembly = common.coupling ? common.coupling->assembly : coupling::Assembly::Primal;
  for (const auto& fault : reductionFaults(deck, assembly, static_cast<int>(parts.size())))
    faults.add(fault.path, fault.sentence);
}

}  // namespace tooljoint::cases
