// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Commands of the program: each file of this folder registers one, with its options and what it
/// does. Nothing else names it.
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

/// What a command does once its line has been read. It throws tooljoint::Error.
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

/// Numbers an option takes.
CLI::Validator anyNumber();
CLI::Validator aboveZero();
CLI::Validator zeroOrMore();

/// Options of the commands that read a deck.
struct DeckOptions {
  std::string deck;                    ///< file
  std::vector<std::string> overrides;  ///< "PATH=VALUE"
  std::vector<std::string> without;    ///< lists taken out before the overrides
  std::string output;                  ///< results folder; empty: results/<name of the deck>
  std::string units = "si";            ///< of printed results: "si" or "field"
  bool quiet = false;
  bool verbose = false;
};

/// Whether a command writes no results, writes them where a folder is given, or always.
enum class Output { None, Wanted, Always };

/// A deck on the command line with its overrides and where results go.
/// \param suffix of the default folder
void addDeckOptions(CLI::App& line, DeckOptions& options, Output output,
                    const std::string& suffix = "");
/// More lines, of a command that ends with a screen.
void addVerbose(CLI::App& line, DeckOptions& options);
/// Sets what the log prints and its units, and reads the deck.
std::unique_ptr<cases::Case> readCase(const DeckOptions& options);

/// Options of the commands that run many rows.
struct RowOptions : DeckOptions {
  bool fresh = false;   ///< forget the rows of an earlier command
  int ranksPerRow = 0;  ///< 0: all
  std::string plan;     ///< folder for a command for each row
  std::string collect;  ///< folder of rows that tables are made of
  std::string row;      ///< the only one to run
};

/// They exclude each other where one has no effect beside another. `row` says what a row is.
void addRowOptions(CLI::App& line, RowOptions& options, const std::string& row);
/// Path of this program, for the commands of --plan.
std::string programPath();

/// A command that solves for many states and can be gone on with: the action of one whose work is
/// `analyse(case, output folder, fresh)`. `steps`: what an earlier command may have left.
Action analysis(CLI::App& line, const std::string& steps,
                void (*analyse)(const cases::Case&, const std::string&, bool));
/// The string of a case; DeckError of another kind of case: `what` needs a string in its well.
const drillstring::DrillstringCase& stringOf(const cases::Case& one, const std::string& what);

/// Prints a text once, whatever the number of ranks.
void print(std::ostream& out, const std::string& text);

/// The report of an analysis ("torque_drag"), then its screen. `output`: folder of the command
/// line.
void endAnalysis(const std::string& analysis, const cases::Case& one, const std::string& output);
/// The report at the end of a run, a study, a map or torque and drag. What goes wrong is a warning
/// with the command to write it later; TOOLJOINT_REPORT=off in the environment leaves it out. A
/// report of an earlier run is removed.
void reportAtEnd(const std::string& folder, bool wanted);

}  // namespace tooljoint::app
