// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The program `tooljoint`: reads the command line, runs one command, and turns every error into a
/// sentence and its exit code.
#include <CLI/CLI.hpp>
#include <Tpetra_Core.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include "app/commands/Commands.hpp"
#include "app/text/FirstWords.hpp"
#include "app/text/ManualPages.hpp"
#include "app/text/UnknownWords.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/ranks/QuickStart.hpp"
#include "common/report/Detail.hpp"
#include "common/report/Log.hpp"
#include "common/report/Terminal.hpp"
#include "deck/PrintedUnits.hpp"
#include "linalg/blocks/LargePages.hpp"

namespace {

using tooljoint::ExitCode;

int code(ExitCode exit) { return static_cast<int>(exit); }

/// Prints a message once, whatever the number of ranks.
void say(std::ostream& out, const std::string& text) {
  if (tooljoint::parallel::rank() == 0) out << text << std::flush;
}

/// Numbers that an option takes; the validators of CLI tell their bounds with 300 digits, and take
/// "nan".
CLI::Validator finiteNumber(const std::string& expected, bool (*good)(double)) {
  return CLI::Validator(
      [expected, good](std::string& text) {
        double value = 0.0;
        const bool read = CLI::detail::lexical_cast(text, value);
        return read && std::isfinite(value) && good(value)
                   ? std::string()
                   : tooljoint::inQuotes(text) + " was given; expected is " + expected + ".";
      },
      "");
}
const auto anyNumber = finiteNumber("a number", [](double) { return true; });
const auto aboveZero = finiteNumber("a number above 0", [](double value) { return value > 0.0; });
const auto zeroOrMore =
    finiteNumber("a number from 0 on", [](double value) { return value >= 0.0; });

/// Prints what has ended the command, once all ranks have ended with it.
int failed(ExitCode why, const std::string& sentence) {
  using tooljoint::terminal::Colour;
  tooljoint::parallel::meetFailing(why, sentence);
  say(std::cerr, tooljoint::terminal::labelled("tooljoint:", Colour::Red, sentence) + "\n");
  return code(why);
}

/// Runs the command; every error that leaves it ends here.
int guarded(const std::function<void()>& command) {
  try {
    command();
    return code(ExitCode::Done);
  } catch (const tooljoint::Error& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(ExitCode::Internal,
                  "out of memory. Use fewer nodes, fewer modes or a longer sampling interval.");
  } catch (const std::exception& error) {
    return failed(ExitCode::Internal,
                  std::string("internal error, please report it: ") + error.what());
  } catch (...) {  // thrown by an extension
    return failed(ExitCode::Internal, "internal error: what was thrown is no std::exception.");
  }
}

/// Whether a command writes no results, writes them where a folder is given, or always.
enum class Output { None, Wanted, Always };

/// Options of the commands that read a deck, and how much they say.
struct Options : tooljoint::app::RunOptions {
  bool quiet = false;
  bool verbose = false;
};

/// A deck on the command line with its overrides and where results go.
/// \param suffix of the default folder
void addDeckOptions(CLI::App& command, Options& options, Output output,
                    const std::string& suffix = "") {
  command.add_option("DECK", options.deck, "scene in Teuchos XML")->type_name("FILE")->required();
  command
      .add_option("--set", options.overrides,
                  "override one parameter: PATH=VALUE, e.g. --set \"Transient/End Time=5\"")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--without", options.without,
                  "take a list out of the deck before --set, e.g. --without Mud: what it describes "
                  "is not modelled")
      ->type_name("LIST")
      ->allow_extra_args(false);
  command
      .add_option("--units", options.units,
                  "units of printed results: si (with kN, rpm, deg) or field (ft, klbf, kft-lbf, "
                  "psi); files hold SI units")
      ->type_name("{" + tooljoint::join(tooljoint::deck::printedSystemNames(), ",") + "}");
  if (output != Output::None)
    command
        .add_option(
            "--output,-o", options.output,
            output == Output::Always
                ? "folder for the results (default: results/<name of the deck>" + suffix + ")"
                : "folder for the tables (default: none are written)")
        ->type_name("DIR");
  command.add_flag("--quiet,-q", options.quiet, "print warnings and errors only");
}

/// More lines, of a command that ends with a screen.
void addVerbose(CLI::App& command, Options& options) {
  command
      .add_flag("--verbose,-v", options.verbose,
                "print the times of the stages, counters and memory, too")
      ->excludes("--quiet");
}

/// Reads the command line; an exit code where nothing is left to do (help, or an error that has
/// been told).
std::optional<ExitCode> parse(CLI::App& program, int argc, char** argv) {
  using tooljoint::terminal::wrapped;
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 takes --help before it looks at words it does not know.
    if (const auto unknown = program.remaining(true); !unknown.empty()) {
      say(std::cerr,
          wrapped("tooljoint: " + tooljoint::app::describeUnknown(program, unknown)) + "\n");
      return ExitCode::Usage;
    }
    std::ostringstream out;
    std::ostringstream err;
    const int cliCode = program.exit(error, out, err);
    say(std::cout, wrapped(out.str()));
    if (!err.str().empty()) say(std::cerr, wrapped("tooljoint: " + err.str()));
    return cliCode == 0 ? ExitCode::Done : ExitCode::Usage;
  }
  return std::nullopt;
}

/// Options of the commands that run many rows; they exclude each other where one has no effect
/// beside another. `row` says what a row is.
void addRowOptions(CLI::App& command, Options& options, const std::string& row) {
  auto* fresh = command.add_flag("--fresh", options.fresh,
                                 "forget the rows an earlier command left in the folder");
  auto* width = command
                    .add_option("--ranks-per-row", options.ranksPerRow,
                                "ranks that work on a row together; the others take other rows")
                    ->check(aboveZero);
  auto* output = command.get_option("--output");
  auto* plan = command
                   .add_option("--plan", options.plan,
                               "run nothing: write one command for each row into this folder")
                   ->type_name("DIR");
  auto* collect = command
                      .add_option("--collect", options.collect,
                                  "run nothing: tables and plots of the rows in this folder")
                      ->type_name("DIR");
  auto* only = command.add_option("--row", options.row, "run this row only: " + row);
  plan->excludes(collect)->excludes(only)->excludes(fresh)->excludes(output);
  collect->excludes(only)->excludes(fresh)->excludes(output);
  only->excludes(fresh)->excludes(width);
}

/// The commands `study` and `map`.
void addStudies(CLI::App& program, Options& options, std::function<void()>& command) {
  auto* study = program.add_subcommand(
      "study", "speed against error: the runs of the deck's Study list against its reference run");
  addDeckOptions(*study, options, Output::Always, "_study");
  addVerbose(*study, options);
  addRowOptions(*study, options, "\"reference\", or its number (the commands of --plan)");
  study
      ->add_option(
          "--timing", options.timing,
          "alone: refuse to time rows that share a machine; shared: time them all the same")
      ->check(CLI::IsMember({"alone", "shared"}));
  study->callback([&] { command = [&] { tooljoint::app::study(options); }; });

  auto* map = program.add_subcommand(
      "map", "figures over a grid of parameters: the deck's Map list as table and coloured maps");
  addDeckOptions(*map, options, Output::Always, "_map");
  addVerbose(*map, options);
  addRowOptions(*map, options, "its number in map.csv (the commands of --plan)");
  map->callback([&] { command = [&] { tooljoint::app::map(options); }; });
}

/// The command `report` with its options.
void addReport(CLI::App& program, Options& options, std::function<void()>& command) {
  auto* report = program.add_subcommand(
      "report", "one HTML file with figures, plots and a 3-D view of a results folder");
  report
      ->add_option("DIR", options.reported,
                   "folder of run, study or map, or the --output of torque-drag, bha, buckling, "
                   "campbell, response or modes")
      ->type_name("DIR")
      ->required();
  report->add_option("--output,-o", options.output, "file to write (default: DIR/report.html)")
      ->type_name("FILE");
  report->add_flag("--quiet,-q", options.quiet, "print warnings and errors only");
  report->callback(
      [&] { command = [&] { tooljoint::app::report(options.reported, options.output); }; });
}

/// The command `paraview` with its options.
void addParaview(CLI::App& program, tooljoint::app::ParaviewOptions& options,
                 std::function<void()>& command) {
  auto* paraview = program.add_subcommand(
      "paraview", "files of ParaView of a run: the motion in space with forces and stresses");
  paraview->add_option("DIR", options.folder, "folder of a run")->type_name("DIR")->required();
  paraview->add_option("--output,-o", options.output, "folder to write (default: DIR/paraview)")
      ->type_name("DIR");
  paraview
      ->add_option("--magnify", options.magnify,
                   "factor of the displacements and of the clearance (default 1)")
      ->check(aboveZero);
  paraview
      ->add_option("--pictures", options.pictures, "pictures of the motion, at most (default 200)")
      ->check(aboveZero);
  paraview->callback([&] { command = [&] { tooljoint::app::paraview(options); }; });
}

/// The command `run`.
void addRun(CLI::App& program, Options& options, std::function<void()>& command) {
  auto* runCommand = program.add_subcommand(
      "run", "path, static state, reduction, transient: from deck to results");
  addDeckOptions(*runCommand, options, Output::Always);
  addVerbose(*runCommand, options);
  runCommand->add_option("--restart", options.restart, "folder of an interrupted run to go on from")
      ->type_name("DIR");
  runCommand->callback([&] { command = [&] { tooljoint::app::run(options); }; });
}

/// The commands that look at a deck.
void addLooks(CLI::App& program, Options& options, std::function<void()>& command) {
  auto* checkCommand =
      program.add_subcommand("check", "validate a deck and say what will be modelled; run nothing");
  addDeckOptions(*checkCommand, options, Output::None);
  checkCommand->add_flag(
      "--cost", options.cost,
      "compute static state and reduction too, and predict which model is faster");
  checkCommand->callback([&] { command = [&] { tooljoint::app::check(options); }; });

  auto* modesCommand = program.add_subcommand(
      "modes", "eigenfrequencies and damping of the full and the coupled model; bases on request");
  addDeckOptions(*modesCommand, options, Output::Wanted);
  addVerbose(*modesCommand, options);
  modesCommand->add_option("--count", options.modeCount, "number of frequencies to list")
      ->check(aboveZero);
  modesCommand->add_flag("--coupled", options.coupledOnly,
                         "undamped modes of the coupled model and their estimated errors only: the "
                         "full model is not solved");
  modesCommand->add_flag("--bases", options.bases,
                         "the vectors of the basis of each part too, behind the frequencies");
  modesCommand
      ->add_option("--time", options.modeTime,
                   "time at which damped modes take the laws of time (rotary speed) "
                   "[s] (default: the end of the motion)")
      ->check(anyNumber);
  modesCommand->callback([&] { command = [&] { tooljoint::app::modes(options); }; });
}

/// A command that solves for many states and can be gone on with.
struct Analysis {
  const char* name;
  const char* words;
  const char* steps;  ///< what an earlier command may have left
  void (*command)(const tooljoint::app::RunOptions&);
};

void addAnalysis(CLI::App& program, Options& options, std::function<void()>& command,
                 const Analysis& analysis) {
  auto* added = program.add_subcommand(analysis.name, analysis.words);
  std::string suffix = std::string("_") + analysis.name;
  std::replace(suffix.begin(), suffix.end(), '-', '_');
  addDeckOptions(*added, options, Output::Always, suffix);
  addVerbose(*added, options);
  added->add_flag(
      "--fresh", options.fresh,
      std::string("forget the ") + analysis.steps + " an earlier command left in the folder");
  added->callback([&options, &command, run = analysis.command] {
    command = [&options, run] { run(options); };
  });
}

/// The commands that solve for many states.
void addAnalyses(CLI::App& program, Options& options, std::function<void()>& command) {
  using namespace tooljoint::app;
  addAnalysis(program, options, command,
              {"torque-drag",
               "hook load, surface torque, buckling and yield margins against the depth of the bit",
               "depths", torqueDrag});
  addAnalysis(
      program, options, command,
      {"bha",
       "side force and tilt at the bit, contacts, bending and sag of a bottom-hole assembly "
       "against weight on bit, inclination and tool face",
       "states", bha});
  addAnalysis(program, options, command,
              {"buckling",
               "static states under a growing weight on bit, past buckling into the bore, beside "
               "theory (list Buckling)",
               "path", buckling});
  addAnalysis(
      program, options, command,
      {"campbell", "damped modes against the rotary speed, and critical speeds (list Campbell)",
       "speeds", campbell});
  addAnalysis(program, options, command,
              {"response",
               "amplitude and phase under unbalance or harmonic loads, transfer functions (list "
               "Response)",
               "points", response});
}

/// The command `export`.
void addExport(CLI::App& program, Options& options, std::function<void()>& command) {
  auto* exportCommand =
      program.add_subcommand("export",
                             "reduce the parts of a deck and write them with their bases as part "
                             "files, to be imported by other decks");
  addDeckOptions(*exportCommand, options, Output::Always);
  exportCommand
      ->add_option("--format", options.format,
                   "hdf5 (one file a part), mtx (a folder of Matrix Market files a part), dmig "
                   "(Nastran punch file) or extptfm (superelement of OpenFAST)")
      ->check(CLI::IsMember(tooljoint::app::exportFormats()));
  exportCommand->callback([&] { command = [&] { tooljoint::app::exportReduced(options); }; });
}

/// The command `compare`.
void addCompare(CLI::App& program, tooljoint::app::CompareOptions& comparison,
                std::function<void()>& command) {
  auto* compareCommand = program.add_subcommand(
      "compare", "errors eps_t, eps_n and the vibration error of one run against a reference run");
  compareCommand->add_option("DIR", comparison.folder, "results folder")
      ->type_name("DIR")
      ->required();
  compareCommand
      ->add_option("REFERENCE", comparison.reference, "results folder of the reference run")
      ->type_name("DIR")
      ->required();
  compareCommand->add_option("--from", comparison.begin, "start of the window [s]")
      ->check(anyNumber);
  compareCommand
      ->add_option("--to", comparison.end, "end of the window [s] (default: 3 s after --from)")
      ->check(anyNumber);
  compareCommand
      ->add_option("--fail-above", comparison.failAbove,
                   "end with exit code 4 when the vibration error is larger than this")
      ->check(zeroOrMore);
  compareCommand->add_flag("--json", comparison.json, "print the errors and the window as JSON");
  compareCommand->callback([&] { command = [&] { tooljoint::app::compare(comparison); }; });
}

/// Options of the commands that write texts to start from, or about the program.
struct Texts {
  std::string topic;
  std::string format = "md";
  std::string kind, folder;
  bool all = false;
};

/// The commands `doc`, `template` and `new`.
void addTexts(CLI::App& program, Texts& texts, std::function<void()>& command) {
  auto* docCommand = program.add_subcommand(
      "doc", "print the parameter manual, or what describes the command line");
  docCommand->add_option("TOPIC", texts.topic,
                         "a list of the deck, e.g. Contact, or units; of man a command");
  docCommand
      ->add_option("--format", texts.format,
                   "md or json: parameters; man: manual page; bash or zsh: completion function")
      ->check(CLI::IsMember({"md", "json", "man", "bash", "zsh"}));
  docCommand->callback([&] {
    command = [&] {
      say(std::cout, tooljoint::app::isPageFormat(texts.format)
                         ? tooljoint::app::page(program, texts.topic, texts.format)
                         : tooljoint::app::manual(texts.topic, texts.format));
    };
  });

  auto* templateCommand =
      program.add_subcommand("template", "print a commented deck to start from");
  templateCommand
      ->add_option(
          "KIND", texts.kind,
          "a surveyed well, parts, the part file of parts, a study, a scene with every list, "
          "or a library of components")
      ->type_name("{" + tooljoint::join(tooljoint::app::templateKinds(), ",") + "}")
      ->required();
  templateCommand->add_flag("--all", texts.all, "of scene: parameters for experts, too");
  templateCommand->callback([&] {
    command = [&] { say(std::cout, tooljoint::app::deckTemplate(texts.kind, texts.all)); };
  });

  auto* newCommand = program.add_subcommand(
      "new", "write a folder with a deck that runs, its survey and a README");
  newCommand->add_option("NAME", texts.folder, "folder to make; its deck has the same name")
      ->type_name("DIR")
      ->required();
  newCommand->callback([&] { command = [&] { tooljoint::app::newFolder(texts.folder); }; });
}

int run(int argc, char** argv) {
  namespace app = tooljoint::app;
  CLI::App program{
      "Tooljoint: component mode synthesis, and the drillstring simulator built on it."};
  program.name("tooljoint");
  program.require_subcommand(0, 1);
  bool version = false;
  program.add_flag("--version", version,
                   "print versions: program, git, Trilinos, MPI, HDF5, SUNDIALS, BLAS");

  Options options;
  std::function<void()> command;

  addRun(program, options, command);
  addStudies(program, options, command);

  addLooks(program, options, command);
  addAnalyses(program, options, command);
  addExport(program, options, command);
  app::CompareOptions comparison;
  addCompare(program, comparison, command);
  addReport(program, options, command);
  app::ParaviewOptions shown;
  addParaview(program, shown, command);

  Texts texts;
  addTexts(program, texts, command);

  if (const auto ended = parse(program, argc, argv)) return code(*ended);
  if (version) {
    say(std::cout, tooljoint::versionText());
    return code(ExitCode::Done);
  }
  if (!command) {
    say(std::cerr, app::firstWords);
    return code(ExitCode::Usage);
  }
  std::vector<std::string> edits;
  for (const auto& list : options.without) edits.push_back("!" + list);
  options.overrides.insert(options.overrides.begin(), edits.begin(), edits.end());
  tooljoint::log::setQuiet(options.quiet);
  tooljoint::log::setVerbose(options.verbose);
  return guarded([&] {
    namespace deck = tooljoint::deck;
    deck::printIn(deck::printedSystemOf(options.units));
    if (deck::printedSystem() == deck::PrintedSystem::Field)
      tooljoint::log::info("units       of the field in print; files hold SI units");
    command();
  });
}

/// What went to the standard output may not have arrived: a full disk, say.
int afterOutput(int exit) {
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  if (written || exit != code(ExitCode::Done)) return exit;
  say(std::cerr, "tooljoint: The standard output could not be written; its disk may be full.\n");
  return code(ExitCode::Files);
}

}  // namespace

int main(int argc, char** argv) {
  tooljoint::installInterruptHandlers();
  tooljoint::linalg::shareLargePages();
  // Neither MPI nor Kokkos takes arguments from the command line: Kokkos would answer --help with
  // its own.
  int none = 0;
  char* end = nullptr;
  char** nothing = &end;
  std::optional<tooljoint::parallel::QuickStart> quick(std::in_place);
  const Tpetra::ScopeGuard scope(&none, &nothing);
  quick.reset();
  return afterOutput(run(argc, argv));
}
