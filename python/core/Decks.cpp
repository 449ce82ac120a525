// SPDX-License-Identifier: BSD-3-Clause
// Decks, the cases they describe, and the commands of the program in this process.
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Lists.hpp"
#include "Models.hpp"
#include "Synthesis.hpp"
#include "cases/CaseCheck.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/run/Run.hpp"
#include "common/report/Log.hpp"
#include "deck/Deck.hpp"
#include "deck/Manual.hpp"
#include "response/Response.hpp"
#include "response/campbell/Campbell.hpp"
#include "study/engine/Study.hpp"
#include "study/map/Map.hpp"

namespace tooljoint::python {

py::object listToPython(const Teuchos::ParameterList& list);

namespace {

/// A deck in Python: a file, the text that replaces it (empty: the file itself), and changes in the
/// form of `--set`.
struct DeckSource {
  std::string file, text;
  std::vector<std::string> overrides;

  std::unique_ptr<cases::Case> makeCase() const {
    return text.empty() ? cases::readCase(file, overrides)
                        : cases::parseCase(text, file, overrides);
  }
};

/// A deck and the description of its lists.
struct ReadDeck {
  deck::Deck deck;
  std::string description;  ///< JSON
};

std::shared_ptr<ReadDeck> readDeck(const DeckSource& from) {
  deck::ListSpec spec;
  const auto choose = [&](const std::vector<std::string>& lists) {
    return spec = cases::CaseKinds::instance().of(lists).parameters();
  };
  auto deck = from.text.empty() ? deck::Deck::read(from.file, choose, from.overrides)
                                : deck::Deck::parse(from.text, from.file, choose, from.overrides);
  return std::make_shared<ReadDeck>(ReadDeck{std::move(deck), deck::manualJson(spec)});
}

/// Switches the printing of log lines during its lifetime.
class Quiet {
 public:
  explicit Quiet(bool quiet) : before_(log::quiet()) { log::setQuiet(quiet); }
  ~Quiet() { log::setQuiet(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  bool before_;
};

std::string run(const DeckSource& deck, const std::string& output, const std::string& restart,
                bool quiet) {
  const Quiet scope(quiet);
  return longCall([&] { return cases::run(*deck.makeCase(), {output, restart}); });
}

/// Computes an analysis of a case into a folder.
void compute(const std::string& what, const cases::Case& one, const std::string& output, bool fresh,
             bool sharedTiming) {
  if (what == "study") {
    study::StudyOptions options;
    options.output = output;
    options.fresh = fresh;
    options.sharedTiming = sharedTiming;
    study::run(one, options);
  } else if (what == "map") {
    study::MapOptions options;
    options.output = output;
    options.fresh = fresh;
    study::runMap(one, options);
  } else if (what == "campbell") {
    response::runCampbell(one, output, fresh);
  } else {
    response::runResponse(one, output, fresh);
  }
}

void analyse(const std::string& what, const DeckSource& deck, const std::string& output, bool fresh,
             bool sharedTiming, bool quiet) {
  const Quiet scope(quiet);
  longCall([&] { compute(what, *deck.makeCase(), output, fresh, sharedTiming); });
}

void check(const DeckSource& deck, bool quiet) {
  const Quiet scope(quiet);
  longCall([&] { cases::check(*deck.makeCase(), false); });
}

/// The case of a deck at rest.
struct AtRest {
  std::unique_ptr<cases::Case> made;
  std::shared_ptr<const cases::RestingCase> rest;
};

std::shared_ptr<AtRest> solveStatic(const DeckSource& deck) {
  return longCall([&] {
    auto out = std::make_shared<AtRest>();
    out->made = deck.makeCase();
    out->rest = out->made->atRest();
    return out;
  });
}

py::tuple partsOf(const AtRest& one) {
  auto resolved = longCall([&] { return one.rest->parts(); });
  Parts parts;
  for (auto& part : resolved.parts)
    parts.push_back(std::make_shared<model::Substructure>(std::move(part)));
  return py::make_tuple(parts, std::move(resolved.options));
}

}  // namespace

void bindDecks(py::module_& module) {
  py::class_<DeckSource>(module, "DeckSource",
                         "A deck: a file, or a text that replaces it, and changes.")
      .def(py::init([](const std::string& file, const std::string& text,
                       const std::vector<std::string>& overrides) {
             return DeckSource{file, text, overrides};
           }),
           py::arg("file"), py::arg("text"), py::arg("overrides"));
  py::class_<ReadDeck, std::shared_ptr<ReadDeck>>(module, "ReadDeck",
                                                  "A deck after reading and checking.")
      .def_property_readonly(
          "name", [](const ReadDeck& d) { return d.deck.name(); }, "Name of the root list.")
      .def_property_readonly(
          "text", [](const ReadDeck& d) { return d.deck.text(); },
          "The text of the file without the changes.")
      .def_property_readonly(
          "description", [](const ReadDeck& d) { return d.description; },
          "The description of the lists as JSON.")
      .def(
          "to_dict", [](const ReadDeck& d) { return listToPython(d.deck.list()); },
          "All values in SI, defaults included; lists are dicts.")
      .def(
          "gives", [](const ReadDeck& d, const std::string& path) { return d.deck.gives(path); },
          py::arg("path"), "Whether the deck or a change gives this value; False for a default.")
      .def(
          "where", [](const ReadDeck& d, const std::string& path) { return d.deck.where(path); },
          py::arg("path"), "\"deck.xml:42: /Scene/Contact/Stiffness\".");
  module.def("read_deck", &readDeck, py::arg("deck"),
             "Read and check a deck. DeckError, FileError.");
  module.def("run", &run, py::arg("deck"), py::arg("output"), py::arg("restart"), py::arg("quiet"),
             "Run a deck; returns the folder of its results.");
  module.def("analyse", &analyse, py::arg("what"), py::arg("deck"), py::arg("output"),
             py::arg("fresh"), py::arg("shared_timing"), py::arg("quiet"),
             "Compute \"study\", \"map\", \"campbell\" or \"response\" of a deck into a folder.");
  module.def("check", &check, py::arg("deck"), py::arg("quiet"), "Raise the errors of a run.");
  py::class_<AtRest, std::shared_ptr<AtRest>>(module, "RestingCase", "The case of a deck at rest.")
      .def(
          "full",
          [](const AtRest& one) {
            return longCall(
                [&] { return std::make_shared<model::SecondOrderModel>(one.rest->full().model); });
          },
          "The full model.")
      .def("parts", &partsOf, "The parts and their connections.")
      .def_property_readonly(
          "displacement", [](const AtRest& one) { return one.rest->rest(); },
          "Displacements at rest, rows of the recovery.");
  module.def("solve_static", &solveStatic, py::arg("deck"),
             "Solve the static state of a deck; returns the case at rest.");
}

}  // namespace tooljoint::python
