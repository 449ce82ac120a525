// SPDX-License-Identifier: BSD-3-Clause
#include "io/OutputParameters.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "common/Error.hpp"

namespace tooljoint::io {

bool OutputSettings::hasField(const std::string& name) const {
  return std::find(fields.begin(), fields.end(), name) != fields.end();
}

namespace {

deck::ListSpec figureParameters() {
  using deck::Range;
  deck::ListSpec list("Figures",
                      "Figures of merit of the motion in summary.json: stick-slip, accelerations, "
                      "whirl, contact, bending cycles. They are those of the samples of a window.");
  list.real("Begin", "s", deck::Optional{}, Range::any(),
            "Begin of the window; by default the middle of the motion.")
      .real("End", "s", deck::Optional{}, Range::any(),
            "End of the window; by default that of the motion.")
      .real("Stuck Speed", "rad/s", FigureSettings().stuckSpeed, Range::positive(),
            "The bit counts as stuck where its speed is smaller.")
      .expert();
  deck::ListSpec line("S-N Line",
                      "Life of the pipe under bending: N = Cycles (Stress Range/S)^Slope cycles of "
                      "the stress range S at the outer wall. The damage of all cycles is their sum "
                      "of 1/N, without an effect of the mean stress.");
  line.real("Slope", "", deck::Required{}, Range::positive(), "Exponent m of the line.")
      .real("Stress Range", "Pa", deck::Required{}, Range::positive(),
            "Stress range (peak less valley) at one point of the line.")
      .real("Cycles", "", deck::Required{}, Range::positive(), "Life there.");
  return list.list(line);
}

FigureSettings readFigures(const Teuchos::ParameterList& list) {
  FigureSettings s;
  if (list.isParameter("Begin")) s.begin = list.get<double>("Begin");
  if (list.isParameter("End")) s.end = list.get<double>("End");
  if (list.isParameter("Stuck Speed")) s.stuckSpeed = list.get<double>("Stuck Speed");
  if (!list.isSublist("S-N Line")) return s;
  const auto& line = list.sublist("S-N Line");
  s.snLine = SnLine{line.get<double>("Slope"), line.get<double>("Stress Range"),
                    line.get<double>("Cycles")};
  return s;
}

}  // namespace

deck::ListSpec parameters() {
  using deck::Range;
  const OutputSettings defaults;
  return deck::ListSpec("Output",
                        "Files that a run writes; results.h5 and summary.json are always written.")
      .text("Folder", deck::Optional{},
            "Folder for the results, relative to where the program runs; --output on the command "
            "line goes first.")
      .textArray("Fields", defaults.fields,
                 {"displacement", "velocity", "acceleration", "normal_force"},
                 "Motions and forces of nodes recorded at every sample; {} records none.")
      .realArray("Depths", "m", deck::Optional{}, Range::nonNegative(),
                 "For a string: measured depths whose nearest nodes are recorded. By default all "
                 "nodes are recorded.")
      .textArray("Nodes", deck::Optional{}, {},
                 "For parts: nodes that are recorded, each as part:node. By default all nodes are "
                 "recorded.")
      .boolean("CSV", defaults.csv, "Write tables for spreadsheets in addition to results.h5.")
      .boolean("Report", defaults.report,
               "Write report.html at the end of `tooljoint run` and of the analyses: figures, "
               "plots and a 3-D view of the results in one file.")
      .boolean("XDMF", defaults.xdmf,
               "Write results.xdmf for ParaView: the string in its well, coloured by contact force "
               "and speed.")
      .real("XDMF Interval", "s", defaults.xdmfInterval, Range::positive(),
            "Time between two pictures in results.xdmf, at least the sampling interval.")
      .expert()
      .boolean("Reduced Bases", defaults.reducedBases,
               "Store the basis of every reduced part in results.h5.")
      .expert()
      .choice(
          "Export Parts", std::string("None"),
          {"None", "HDF5", "Matrix Market", "Nastran DMIG", "ExtPtfm"},
          "Write every reduced part into the folder parts of the results: with its basis as one "
          "HDF5 file or a folder of Matrix Market files, to be used again as an imported part; "
          "or its matrices for another code, as DMIG entries of a Nastran punch file or as a "
          "superelement of the OpenFAST module ExtPtfm.")
      .expert()
      .integer(
          "Compression", defaults.compression, Range::between(0, 9),
          "Deflate level of the time series in results.h5; 0 is off. Level 1 takes a tenth to a "
          "fifth off the file for up to 10 % of the CPU time of a run. Any HDF5 reads it.")
      .expert()
      .list(figureParameters());
}

OutputSettings readOutput(const Teuchos::ParameterList& list) {
  OutputSettings s;
  if (list.isParameter("Folder")) s.folder = list.get<std::string>("Folder");
  s.fields = list.get<Teuchos::Array<std::string>>("Fields").toVector();
  for (auto it = s.fields.begin(); it != s.fields.end(); ++it) {
    if (std::find(s.fields.begin(), it, *it) != it)
      throw DeckError("Output/Fields names \"" + *it + "\" twice.");
  }
  s.csv = list.get<bool>("CSV");
  s.report = list.get<bool>("Report");
  s.xdmf = list.get<bool>("XDMF");
  s.xdmfInterval = list.get<double>("XDMF Interval");
  s.reducedBases = list.get<bool>("Reduced Bases");
  const auto& kind = list.get<std::string>("Export Parts");
  s.exportFormat = kind == "HDF5"            ? ExportFormat::Hdf5
                   : kind == "Matrix Market" ? ExportFormat::MatrixMarket
                   : kind == "Nastran DMIG"  ? ExportFormat::NastranDmig
                   : kind == "ExtPtfm"       ? ExportFormat::ExtPtfm
                                             : ExportFormat::None;
  s.compression = list.get<int>("Compression");
  if (list.isSublist("Figures")) s.figures = readFigures(list.sublist("Figures"));
  return s;
}

}  // namespace tooljoint::io
