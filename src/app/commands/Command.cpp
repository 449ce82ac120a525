// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <tuple>

#include "cases/CaseKinds.hpp"
#include "cases/run/AnalysisFiles.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Detail.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "texts/AnalysisScreens.hpp"

namespace tooljoint::app {

namespace {

std::vector<Command>& registeredCommands() {
  static std::vector<Command> commands;
  return commands;
}

const char* heading(Group group) {
  switch (group) {
    case Group::Begin:
      return "To begin";
    case Group::Runs:
      return "Runs";
    case Group::Analyses:
      return "Analyses";
    case Group::Results:
      return "Results and parts";
  }
  return "";
}

/// The validators of CLI11 print their bounds with 300 digits, and accept "nan".
CLI::Validator finiteNumber(const std::string& expected, bool (*good)(double)) {
  return CLI::Validator(
      [expected, good](std::string& text) {
        double value = 0.0;
        const bool read = CLI::detail::lexical_cast(text, value);
        return read && std::isfinite(value) && good(value)
                   ? std::string()
                   : inQuotes(text) + " was given; expected is " + expected + ".";
      },
      "");
}

/// "torque_drag" for the command torque-drag.
std::string analysisName(const CLI::App& line) {
  std::string name = line.get_name();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace

bool addCommand(const Command& command) {
  registeredCommands().push_back(command);
  return true;
}

std::map<const CLI::App*, Action> addCommands(CLI::App& program) {
  auto& commands = registeredCommands();
  std::sort(commands.begin(), commands.end(), [](const Command& a, const Command& b) {
    return std::pair(a.group, std::string(a.name)) < std::pair(b.group, std::string(b.name));
  });
  std::map<const CLI::App*, Action> actions;
  for (const auto& command : commands) {
    auto* line = program.add_subcommand(command.name, command.help);
    line->group(heading(command.group));
    actions[line] = command.prepare(*line);
  }
  return actions;
}

CLI::Validator anyNumber() {
  return finiteNumber("a number", [](double) { return true; });
}

CLI::Validator aboveZero() {
  return finiteNumber("a number above 0", [](double value) { return value > 0.0; });
}

CLI::Validator zeroOrMore() {
  return finiteNumber("a number from 0 on", [](double value) { return value >= 0.0; });
}

void addDeckOptions(CLI::App& line, DeckOptions& options, Output output,
                    const std::string& suffix) {
  line.add_option("DECK", options.deck, "scene in Teuchos XML")->type_name("FILE")->required();
  line.add_option("--set", options.overrides,
                  "override one parameter: PATH=VALUE, e.g. --set \"Transient/End Time=5\"")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  line.add_option("--without", options.without,
                  "take a list out of the deck before --set, e.g. --without Mud: what it describes "
                  "is not modelled")
      ->type_name("LIST")
      ->allow_extra_args(false);
  line.add_option("--units", options.units,
                  "units of printed results: si (with kN, rpm, deg) or field (ft, klbf, kft-lbf, "
                  "psi); files hold SI units")
      ->type_name("{" + join(deck::printedSystemNames(), ",") + "}");
  if (output != Output::None)
    line.add_option(
            "--output,-o", options.output,
            output == Output::Always
                ? "folder for the results (default: results/<name of the deck>" + suffix + ")"
                : "folder for the tables (default: none are written)")
        ->type_name("DIR");
  line.add_flag("--quiet,-q", options.quiet, "print warnings and errors only");
}

void addVerbose(CLI::App& line, DeckOptions& options) {
  line.add_flag("--verbose,-v", options.verbose,
                "print the times of the stages, counters and memory, too")
      ->excludes("--quiet");
}

std::unique_ptr<cases::Case> readCase(const DeckOptions& options) {
  log::setQuiet(options.quiet);
  log::setVerbose(options.verbose);
  deck::printIn(deck::printedSystemOf(options.units));
  if (deck::printedSystem() == deck::PrintedSystem::Field)
    log::info("units       of the field in print; files hold SI units");
  std::vector<std::string> edits;
  for (const auto& list : options.without) edits.push_back("!" + list);
  edits.insert(edits.end(), options.overrides.begin(), options.overrides.end());
  return cases::readCase(options.deck, edits);
}

void addRowOptions(CLI::App& line, RowOptions& options, const std::string& row) {
  auto* fresh = line.add_flag("--fresh", options.fresh,
                              "forget the rows an earlier command left in the folder");
  auto* width = line.add_option("--ranks-per-row", options.ranksPerRow,
                                "ranks that work on a row together; the others take other rows")
                    ->check(aboveZero());
  auto* output = line.get_option("--output");
  auto* plan = line.add_option("--plan", options.plan,
                               "run nothing: write one command for each row into this folder")
                   ->type_name("DIR");
  auto* collect = line.add_option("--collect", options.collect,
                                  "run nothing: tables and plots of the rows in this folder")
                      ->type_name("DIR");
  auto* only = line.add_option("--row", options.row, "run this row only: " + row);
  plan->excludes(collect)->excludes(only)->excludes(fresh)->excludes(output);
  collect->excludes(only)->excludes(fresh)->excludes(output);
  only->excludes(fresh)->excludes(width);
}

std::string programPath() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

Action analysis(CLI::App& line, const std::string& steps,
                void (*analyse)(const cases::Case&, const std::string&, bool)) {
  struct Options : DeckOptions {
    bool fresh = false;
  };
  const auto name = analysisName(line);
  auto options = std::make_shared<Options>();
  addDeckOptions(line, *options, Output::Always, "_" + name);
  addVerbose(line, *options);
  line.add_flag("--fresh", options->fresh,
                "forget the " + steps + " an earlier command left in the folder");
  return [options, name, analyse] {
    const auto one = readCase(*options);
    analyse(*one, options->output, options->fresh);
    endAnalysis(name, *one, options->output);
  };
}

const drillstring::DrillstringCase& stringOf(const cases::Case& one, const std::string& what) {
  const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(&one);
  if (string == nullptr)
    throw DeckError(one.deck().file() + ": " + what +
                    " needs a string in its well. Give a deck with the lists Well and "
                    "Drillstring.");
  return *string;
}

void print(std::ostream& out, const std::string& text) {
  if (parallel::rank() == 0) out << text << std::flush;
}

void endAnalysis(const std::string& analysis, const cases::Case& one, const std::string& output) {
  const auto folder = cases::analysisFolder(one, output, analysis);
  reportAtEnd(folder, one.output().report);
  texts::analysisScreen(analysis, folder, one.deck());
}

}  // namespace tooljoint::app
