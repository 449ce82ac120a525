// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The program `tooljoint`: reads the command line, runs one command, and converts every error to a
/// sentence and an exit code.
#include <CLI/CLI.hpp>
#include <Tpetra_Core.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include "app/commands/Command.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Version.hpp"
#include "common/ranks/QuickStart.hpp"
#include "common/report/Terminal.hpp"
#include "linalg/blocks/LargePages.hpp"
#include "texts/UnknownWords.hpp"

namespace {

using tooljoint::ExitCode, tooljoint::app::print;

int code(ExitCode exit) { return static_cast<int>(exit); }

/// Text printed without a command.
constexpr const char* kFirstWords =
    "Tooljoint: component mode synthesis, and the drillstring simulator built on it.\n\n"
    "Begin with a folder of your own:\n\n"
    "  tooljoint new my_well           a deck that runs, its survey and a README\n"
    "  cd my_well\n"
    "  tooljoint check my_well.xml     what is modelled\n"
    "  tooljoint run my_well.xml       static state and motion, into results/my_well\n"
    "  xdg-open results/my_well/report.html    figures, plots and the motion in a browser\n\n"
    "or with a deck to edit:\n\n"
    "  tooljoint template well > mine.xml\n\n"
    "tooljoint --help lists the commands, tooljoint COMMAND --help what each takes, and\n"
    "tooljoint doc the parameters of a deck.\n";

/// Prints the error that ended the command, after all ranks have ended with it.
int failed(ExitCode why, const std::string& sentence) {
  using tooljoint::terminal::Colour;
  tooljoint::parallel::meetFailing(why, sentence);
  print(std::cerr, tooljoint::terminal::labelled("tooljoint:", Colour::Red, sentence) + "\n");
  return code(why);
}

/// Runs the command and handles every error it throws.
int guarded(const tooljoint::app::Action& command) {
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

/// Reads the command line; returns an exit code if there is nothing to run (help, or an error that
/// has been printed).
std::optional<ExitCode> parse(CLI::App& program, int argc, char** argv) {
  using tooljoint::terminal::wrapped;
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 handles --help before unknown words.
    if (const auto unknown = program.remaining(true); !unknown.empty()) {
      print(std::cerr,
            wrapped("tooljoint: " + tooljoint::texts::describeUnknown(program, unknown)) + "\n");
      return ExitCode::Usage;
    }
    std::ostringstream out;
    std::ostringstream err;
    const int cliCode = program.exit(error, out, err);
    print(std::cout, wrapped(out.str()));
    if (!err.str().empty()) print(std::cerr, wrapped("tooljoint: " + err.str()));
    return cliCode == 0 ? ExitCode::Done : ExitCode::Usage;
  }
  return std::nullopt;
}

int run(int argc, char** argv) {
  CLI::App program{
      "Tooljoint: component mode synthesis, and the drillstring simulator built on it."};
  program.name("tooljoint");
  program.require_subcommand(0, 1);
  bool version = false;
  program.add_flag("--version", version,
                   "print versions: program, git, Trilinos, MPI, HDF5, SUNDIALS, BLAS");
  const auto actions = tooljoint::app::addCommands(program);

  if (const auto ended = parse(program, argc, argv)) return code(*ended);
  if (version) {
    print(std::cout, tooljoint::versionText());
    return code(ExitCode::Done);
  }
  const auto given = program.get_subcommands();
  if (given.empty()) {
    print(std::cerr, kFirstWords);
    return code(ExitCode::Usage);
  }
  return guarded(actions.at(given.front()));
}

/// Checks that the standard output was written; it fails on a full disk, for example.
int afterOutput(int exit) {
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  if (written || exit != code(ExitCode::Done)) return exit;
  print(std::cerr, "tooljoint: The standard output could not be written; its disk may be full.\n");
  return code(ExitCode::Files);
}

}  // namespace

int main(int argc, char** argv) {
  tooljoint::installInterruptHandlers();
  tooljoint::linalg::shareLargePages();
  // Neither MPI nor Kokkos gets arguments from the command line: Kokkos would answer --help itself.
  int none = 0;
  char* end = nullptr;
  char** nothing = &end;
  std::optional<tooljoint::parallel::QuickStart> quick(std::in_place);
  const Tpetra::ScopeGuard scope(&none, &nothing);
  quick.reset();
  return afterOutput(run(argc, argv));
}
