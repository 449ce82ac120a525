// SPDX-License-Identifier: BSD-3-Clause
#include "study/StudyParameters.hpp"

#include <Teuchos_Array.hpp>
#include <map>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "study/reference/FittedReference.hpp"

namespace tooljoint::study {
namespace {

using deck::ListSpec;
using deck::Range;
using Texts = std::vector<std::string>;

/// Largest number of runs of one method, the product of the values of its sweep.
constexpr double mostRuns = 1e4;

const char* const overrideDoc =
    "\"PATH=VALUE\" replaces a value of the deck as --set does, \"!PATH\" takes a list or "
    "parameter out as --without does.";

ListSpec dimension() {
  return ListSpec("Dimension",
                  "One dimension of the sweep, named as you like; several lists make a product.")
      .text("Parameter", deck::Required{},
            "Path of a parameter of the deck: Transient/Step, Reduction/Mode Selection/Cut-off "
            "Frequency, Substructures/Rule ...")
      .textArray("Values", deck::Required{}, {},
                 "The values it takes, each written as behind --set PATH=.");
}

ListSpec method() {
  ListSpec spec("Method", "One method, named as you like: a line of the plots.");
  spec.text("Label", deck::Optional{}, "Name in tables and plots; by default that of the list.")
      .choice("Model", deck::Required{}, {"Full", "Reduced"},
              "Full: the lists Reduction and Substructures are taken out of the deck. Reduced: "
              "they stay.")
      .textArray("Set", Texts{}, {},
                 std::string("Changes of the deck by this method. ") + overrideDoc);
  ListSpec sweep("Sweep",
                 "The runs of this method: the product of all dimensions; the last one runs along "
                 "a line of the plots. Without it there is one run.");
  sweep.namedLists(dimension());
  return spec.list(sweep);
}

ListSpec published() {
  return ListSpec("Published", "A series of points, named as you like.")
      .text("Label", deck::Optional{}, "Name in the plots; by default that of the list.")
      .realArray("CPU Time", "s", deck::Required{}, Range::positive(),
                 "CPU time of each point per simulated second.")
      .realArray("Error", "", deck::Optional{}, Range::positive(),
                 "Error of each point; without it the points stand at the edge of the plot.")
      .textArray("Points", deck::Optional{}, {}, "Label to write at each point.");
}

Texts texts(const Teuchos::ParameterList& list, const char* name) {
  return list.isParameter(name) ? list.get<Teuchos::Array<std::string>>(name).toVector() : Texts{};
}

std::vector<double> numbers(const Teuchos::ParameterList& list, const char* name) {
  return list.isParameter(name) ? list.get<Teuchos::Array<double>>(name).toVector()
                                : std::vector<double>{};
}

std::optional<double> number(const Teuchos::ParameterList& list, const char* name) {
  if (!list.isParameter(name)) return std::nullopt;
  return list.get<double>(name);
}

Texts sublists(const Teuchos::ParameterList& list) {
  Texts names;
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.isSublist(list.name(it))) names.push_back(list.name(it));
  return names;
}

std::string labelOf(const Teuchos::ParameterList& list, const std::string& name) {
  return list.isParameter("Label") ? list.get<std::string>("Label") : name;
}

/// First name of a path, with or without a leading "/".
std::string firstList(const std::string& path) {
  return split(!path.empty() && path[0] == '/' ? path.substr(1) : path, '/')[0];
}

class Reader {
 public:
  StudySettings read(const Teuchos::ParameterList& list) {
    StudySettings s;
    s.window = number(list, "Window");
    s.end = number(list, "End Time");
    s.repeats = list.get<int>("Repeats");
    s.statistics = list.get<bool>("Statistics");
    s.pictures = list.get<bool>("Pictures");
    s.frequencies = list.get<int>("Frequencies");
    if (list.isParameter("Baseline")) s.baseline = list.get<std::string>("Baseline");
    s.perturbation = list.get<double>("Perturbation");
    s.timeLimit = number(list, "Time Limit");
    readReference(list, s);
    for (const auto& name : sublists(list.sublist("Methods")))
      s.methods.push_back(readMethod(list.sublist("Methods").sublist(name), name));
    if (list.isSublist("Published"))
      for (const auto& name : sublists(list.sublist("Published")))
        s.published.push_back(readPublished(list.sublist("Published").sublist(name), name));
    if (s.methods.empty())
      fault(
          "Study/Methods",
          "holds no method: there is nothing to study. Add a list with a Model, and Set or Sweep.");
    distinctLabels(s.methods);
    if (!faults_.empty()) throw DeckError(join(faults_, "\n"));
    return s;
  }

 private:
  void fault(const std::string& path, const std::string& sentence) {
    faults_.push_back(path + " " + sentence);
  }

  /// Checks that overrides are valid and do not change settings of the whole study.
  void checkOverrides(const Texts& overrides, const std::string& path) {
    for (const auto& text : overrides) {
      const bool removes = !text.empty() && text[0] == '!';
      const auto equals = removes ? text.size() : text.find('=');
      const bool named = equals != std::string::npos &&
                         !trim(text.substr(removes ? 1 : 0, equals - (removes ? 1 : 0))).empty();
      if (!named)
        fault(path, "has the entry " + inQuotes(text) +
                        ", which is no override. Write \"PATH=VALUE\", for example "
                        "\"Transient/Step=1e-3\", or \"!PATH\".");
      else
        belongs(trim(removes ? text.substr(1) : text.substr(0, equals)), path);
    }
  }

  void belongs(const std::string& target, const std::string& path) {
    const auto first = firstList(target);
    if (first == "Study" || first == "Output")
      fault(path, "changes " + target +
                      ", which belongs to the whole study. Change it in the deck itself.");
    for (const char* common :
         {"Transient/Start Time", "Transient/End Time", "Transient/Sampling Interval"})
      if (target == common || target == std::string("/") + common)
        fault(path, "changes " + std::string(common) +
                        ", but all runs must be sampled at the same times. Change it in the deck "
                        "(the end with Study/End Time).");
  }

  void readReference(const Teuchos::ParameterList& list, StudySettings& s) {
    const auto read = [&](const char* name, Texts& set) {
      if (!list.isSublist(name)) return;
      set = texts(list.sublist(name), "Set");
      checkOverrides(set, std::string("Study/") + name + "/Set");
    };
    if (list.isSublist("Check")) s.reference = explicitReference();
    read("Reference", s.reference);
    read("Check", s.check);
    if (list.isSublist("Reference") && !list.isSublist("Check"))
      fault("Study/Reference",
            "is not the default, so the default Check need not be tighter than it. Add a list "
            "Check whose Set makes a second, tighter or "
            "different run; the difference of the two is the error of the reference.");
    if (list.isSublist("Check") && s.check.empty())
      fault("Study/Check",
            "changes nothing: a run compared with itself says nothing about its error. Give Set a "
            "smaller step or another integrator.");
  }

  Method readMethod(const Teuchos::ParameterList& list, const std::string& name) {
    const std::string path = "Study/Methods/" + name;
    Method m{name,
             labelOf(list, name),
             list.get<std::string>("Model") == "Reduced",
             texts(list, "Set"),
             {}};
    checkOverrides(m.set, path + "/Set");
    if (!list.isSublist("Sweep")) return m;
    for (const auto& key : sublists(list.sublist("Sweep"))) {
      const auto& dimension = list.sublist("Sweep").sublist(key);
      const std::string where = path + "/Sweep/" + key;
      m.sweep.push_back(
          {key, trim(dimension.get<std::string>("Parameter")), texts(dimension, "Values")});
      if (m.sweep.back().values.empty())
        fault(where + "/Values", "is empty: a sweep needs at least one value.");
      belongs(m.sweep.back().parameter, where + "/Parameter");
    }
    double runs = 1.0;
    for (const auto& one : m.sweep) runs *= static_cast<double>(one.values.size());
    if (runs > mostRuns)
      fault(path + "/Sweep", "makes " + countText(runs) + " runs; a method has at most " +
                                 countText(mostRuns) + ". Take fewer values, or fewer dimensions.");
    if (m.sweep.empty())
      fault(path + "/Sweep",
            "is empty. Add a list with a Parameter and its Values, or leave Sweep out.");
    return m;
  }

  Published readPublished(const Teuchos::ParameterList& list, const std::string& name) {
    Published p{labelOf(list, name), numbers(list, "CPU Time"), numbers(list, "Error"),
                texts(list, "Points")};
    const auto matches = [&](const char* what, std::size_t count) {
      if (list.isParameter(what) && count != p.cpu.size())
        fault("Study/Published/" + name + "/" + what,
              "has " + std::to_string(count) + " entries, CPU Time has " +
                  std::to_string(p.cpu.size()) + ". Give one for each point.");
    };
    matches("Error", p.error.size());
    matches("Points", p.points.size());
    return p;
  }

  void distinctLabels(const std::vector<Method>& methods) {
    std::map<std::string, std::string> seen;
    for (const auto& m : methods) {
      const auto [it, fresh] = seen.emplace(m.label, m.name);
      if (!fresh)
        fault("Study/Methods/" + m.name, "has the label " + inQuotes(m.label) + " of the method " +
                                             inQuotes(it->second) + ". Labels must differ.");
    }
  }

  Texts faults_;
};

}  // namespace

ListSpec parameters() {
  ListSpec spec("Study",
                "Speed against error: many runs of this deck against one tight reference run "
                "(tooljoint study; other commands leave it aside).");
  spec.real("Window", "s", deck::Optional{}, Range::positive(),
            "Length of the window of pointwise errors, from the start of the motion; beyond it "
            "motions are compared by statistics. By default 3 s, or "
            "the whole motion where that is shorter.")
      .real("End Time", "s", deck::Optional{}, Range::any(),
            "End time of every run; by default that of Transient.")
      .integer("Repeats", 3, Range{1, 1000, false, false},
               "How often each run is timed; all runs once, then all again. Tables show the "
               "shortest time and the spread.")
      .boolean(
          "Statistics", true,
          "Compare bit speeds, contact duty, lateral motion and its spectrum beyond the window.")
      .expert()
      .text("Baseline", deck::Optional{},
            "Label of the run whose time is divided by that of each run: a method's label, with "
            "the values of its sweep when it has several runs.")
      .real("Perturbation", "m", 1e-10, Range::nonNegative(),
            "Size of the change of the initial displacements whose growth is the sensitivity of "
            "the reference; 0 for none.")
      .real("Time Limit", "s", deck::Optional{}, Range::positive(),
            "CPU time after which a run is given up and counts as failed; the reference has none.")
      .integer("Frequencies", 0, Range{0, 1000, false, false},
               "How many of the lowest frequencies of the full model are sought in each reduced "
               "one, by shape (largest MAC); their errors stand in the table with those of the "
               "motion. Their cost is in no column. 0 for none.")
      .boolean("Pictures", true, "Draw the plots when the study is done.");
  ListSpec reference(
      "Reference",
      "The reference run, on the full model. By default generalized-alpha with a quarter of the "
      "shortest step of the runs; RK4 at half its stability limit where all runs are explicit or "
      "choose their steps themselves, or where a Check alone is given.");
  reference.textArray("Set", deck::Required{}, {},
                      std::string("Changes of the deck by the reference. ") + overrideDoc);
  ListSpec check("Check",
                 "A second run, tighter than the reference or different from it: their difference "
                 "is the error of the reference. By default half the step of the reference.");
  check.textArray("Set", deck::Required{}, {},
                  std::string("What it changes in the deck of the reference. ") + overrideDoc);
  ListSpec methods("Methods", "Methods to compare, one list for each.");
  methods.namedLists(method());
  ListSpec others("Published",
                  "Published points to show with the runs, for example those of another machine.");
  others.namedLists(published());
  return spec.list(reference).list(check).requiredList(methods).list(others);
}

StudySettings readStudy(const Teuchos::ParameterList& list) { return Reader().read(list); }

}  // namespace tooljoint::study
