// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What each subcommand does. All of them throw tooljoint::Error; main turns that into the exit
/// code.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/OutputParameters.hpp"

namespace tooljoint::app {

/// Options of the commands that read a deck.
struct RunOptions {
  std::string deck;                    ///< file
  std::vector<std::string> overrides;  ///< "PATH=VALUE", or "!PATH" for a list taken out
  std::vector<std::string> without;    ///< lists taken out before the other overrides
  std::string output;                  ///< results folder; empty: results/<name of the deck>
  std::string units = "si";            ///< of printed results: "si" or "field"
  bool cost = false;    ///< `check` also solves for the state at rest and reduces, to compare
                        ///< the cost of a step
  bool fresh = false;   ///< `study`, `map`, `torque-drag` forget what they have done before
  int ranksPerRow = 0;  ///< of `study` and `map`; 0: all
  std::string timing = "alone";  ///< of `study`: "alone" or "shared"
  std::string plan;              ///< folder for the commands of the rows of `study` or `map`
  std::string collect;           ///< folder of rows that tables are made of
  std::string row;               ///< the only one that `study` or `map` runs
  std::string reported;          ///< folder that `report` is made of
  std::string restart;           ///< folder of an interrupted run; empty: start anew
  int modeCount = 20;            ///< frequencies listed by `modes`
  bool coupledOnly = false;      ///< `modes` leaves the full model out
  bool bases = false;            ///< `modes` lists the vectors of the bases, too
  std::string format = "hdf5";   ///< files of `export`: a name of exportFormats()
  std::optional<double>
      modeTime;  ///< when `modes` looks at the laws of time [s]; the end of the motion
};

/// `tooljoint paraview`: options of the command line, as texts; empty: the default of the script.
struct ParaviewOptions {
  std::string folder;    ///< of a run
  std::string output;    ///< folder of the files
  std::string magnify;   ///< factor of the displacements
  std::string pictures;  ///< of the motion, at most
};

/// Two results folders, the window of time to compare them in [s], and how the result is told.
struct CompareOptions {
  std::string folder;
  std::string reference;
  double begin = 0.0;
  std::optional<double> end;        ///< by default 3 s after the beginning
  std::optional<double> failAbove;  ///< largest vibration error that is accepted
  bool json = false;                ///< print JSON in the place of the line for people
};

/// `tooljoint run`: the whole way of the data, ending in results.h5, summary.json and a printed
/// summary.
void run(const RunOptions& options);
/// `tooljoint study`: many runs of one deck against a reference run; study.csv, study.h5,
/// summary.json and plots of speed against error.
void study(const RunOptions& options);
/// `tooljoint map`: numbers of summary.json over a grid of parameters of the deck; map.csv, map.h5,
/// summary.json and pictures.
void map(const RunOptions& options);
/// `tooljoint check`: validates, prints what will and will not be modelled, sizes and estimates;
/// runs nothing. With options.cost: path, static state and reduction are computed, and the cost of
/// a step of both models predicted.
void check(const RunOptions& options);
/// `tooljoint modes`: bases of the parts; undamped and damped modes of the full and the coupled
/// model with MAC values, true and estimated errors; modes.csv and damped_modes.csv in the output
/// folder, if one is given.
void modes(const RunOptions& options);
/// `tooljoint torque-drag`: hook load, surface torque, buckling and yield margins of a string
/// against the depth of its bit; torque_drag.csv, torque_drag_profile.csv, torque_drag.h5 and
/// summary.json.
void torqueDrag(const RunOptions& options);
/// `tooljoint bha`: the lower part of a string at rest, against weight on bit, inclination and tool
/// face.
void bha(const RunOptions& options);
/// `tooljoint buckling`: static states under a growing weight on bit, past buckling.
void buckling(const RunOptions& options);
/// `tooljoint campbell`: damped modes against the rotary speed, and critical speeds.
void campbell(const RunOptions& options);
/// `tooljoint response`: amplitude and phase under harmonic loads against speed or frequency.
void response(const RunOptions& options);
/// `tooljoint export`: reduces the parts of the deck and writes each with its basis as a part file,
/// to be imported elsewhere.
void exportReduced(const RunOptions& options);
/// Values of `export --format`.
const std::map<std::string, io::ExportFormat>& exportFormats();
/// `tooljoint compare`: eps_t, eps_n ((45) and (46) of Nguyen et al. 2020) and the vibration error
/// of one run against another, and the window of the samples that were compared. FileError;
/// UsageError: the folders hold different scenes or different times in the window, or the reference
/// does not move in it; ConvergenceError: the vibration error is above options.failAbove.
void compare(const CompareOptions& options);
/// `tooljoint report`: report.html in `folder`, or the file `output`, of what a run, a study,
/// a map, `torque-drag` or `modes` left there. FileError: nothing to report on, a file that cannot
/// be read, or no python3 with the modules that are needed. Collective.
void report(const std::string& folder, const std::string& output);
/// The report at the end of a run, a study, a map or torque and drag. What goes wrong is a warning
/// with the command to write it later; TOOLJOINT_REPORT=off in the environment leaves it out. A
/// report of an earlier run is removed.
void reportAtEnd(const std::string& folder, bool wanted);
/// `tooljoint paraview`: what a run left, as polydata files and their times. Errors as report().
void paraview(const ParaviewOptions& options);
/// `tooljoint doc`: the parameter manual (format "md" or "json"), or one topic of it.
std::string manual(const std::string& topic, const std::string& format);
/// `tooljoint template`: a deck to start from: "well", "parts" (of the file "part"), "study",
/// "scene" (every list, with `all` the parameters for experts too) or "components". UsageError for
/// another kind, and for `all` beside another than "scene".
std::string deckTemplate(const std::string& kind, bool all);
/// The kinds of deckTemplate().
const std::vector<std::string>& templateKinds();
/// `tooljoint new`: a folder with a deck of the name of the folder, survey.csv and README.md.
/// UsageError: no name of a deck; FileError: the folder holds something, or cannot be written.
/// Collective.
void newFolder(const std::string& path);

}  // namespace tooljoint::app
