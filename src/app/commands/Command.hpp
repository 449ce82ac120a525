// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Commands of the program. Each file of this folder registers one command with its options and its
/// action; no other file names it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"

namespace tooljoint::app {

/// The action of a command after its line has been read. Throws tooljoint::Error.
using Action = std::function<void()>;

/// Headings of `tooljoint --help`, in their order.
enum class Group { Begin, Runs, Analyses, Results };

struct Command {
  Group group;
  const char* name;
  const char* help;
  Action (*prepare)(CLI::App& line);  ///< adds the options to the command's line
};

/// Registers a command.
bool addCommand(const Command& command);
/// Adds all commands to the program, by group and name, and returns the action of each line.
std::map<const CLI::App*, Action> addCommands(CLI::App& program);

/// Accepts any number as the value of an option.
CLI::Validator anyNumber();
CLI::Validator aboveZero();
CLI::Validator zeroOrMore();

/// Options of the commands that read a deck.
struct DeckOptions {
  std::string deck;                    ///< file name
  std::vector<std::string> overrides;  ///< "PATH=VALUE"
  std::vector<std::string> without;    ///< lists removed before the overrides
  std::string output;                  ///< results folder; empty: results/<name of the deck>
  std::string units = "si";            ///< of printed results: "si" or "field"
  bool quiet = false;
  bool verbose = false;
};

/// Whether a command writes no results, writes them if a folder is given, or always writes them.
enum class Output { None, Wanted, Always };

/// Adds a deck with its overrides and the results folder to the command line.
/// \param suffix  of the default folder
void addDeckOptions(CLI::App& line, DeckOptions& options, Output output,
                    const std::string& suffix = "");
/// Adds --verbose, for a command with a final screen.
void addVerbose(CLI::App& line, DeckOptions& options);
/// Sets the verbosity of the log and its units, and reads the deck.
std::unique_ptr<cases::Case> readCase(const DeckOptions& options);

/// Options of the commands that run many rows.
struct RowOptions : DeckOptions {
  bool fresh = false;   ///< discard the rows of an earlier command
  int ranksPerRow = 0;  ///< 0: all
  std::string plan;     ///< folder for a plan with one command per row
  std::string collect;  ///< folder of rows for the tables
  std::string row;      ///< run only this row
};

/// Options that would have no effect together exclude each other. `row` describes a row.
void addRowOptions(CLI::App& line, RowOptions& options, const std::string& row);
/// Path of this program, for the commands of --plan.
std::string programPath();

/// A resumable command that solves for many states: the action whose work is `analyse(case, output
/// folder, fresh)`. `steps`: results that an earlier command may have left.
Action analysis(CLI::App& line, const std::string& steps,
                void (*analyse)(const cases::Case&, const std::string&, bool));
/// The string of a case. DeckError for another kind of case: `what` needs a string in its well.
const drillstring::DrillstringCase& stringOf(const cases::Case& one, const std::string& what);

/// Prints a text once, for any number of ranks.
void print(std::ostream& out, const std::string& text);

/// Writes the report of an analysis ("torque_drag") and prints its screen. `output`: folder of the
/// command line.
void endAnalysis(const std::string& analysis, const cases::Case& one, const std::string& output);
/// The report at the end of a run, a study, a map or torque and drag. A failure is a warning with
/// the command to write the report later. TOOLJOINT_REPORT=off in the environment disables it. A
/// report of an earlier run is removed.
void reportAtEnd(const std::string& folder, bool wanted);

}  // namespace tooljoint::app
