// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "app/commands/Command.hpp"
#include "cases/PartsExport.hpp"

namespace tooljoint::app {

namespace {

struct ExportOptions : DeckOptions {
  std::string format = "hdf5";
};

Action prepareExport(CLI::App& line) {
  static const std::map<std::string, io::ExportFormat> formats{
      {"hdf5", io::ExportFormat::Hdf5},
      {"mtx", io::ExportFormat::MatrixMarket},
      {"dmig", io::ExportFormat::NastranDmig},
      {"extptfm", io::ExportFormat::ExtPtfm}};
  auto options = std::make_shared<ExportOptions>();
  addDeckOptions(line, *options, Output::Always);
  line.add_option("--format", options->format,
                  "hdf5 (one file a part), mtx (a folder of Matrix Market files a part), dmig "
                  "(Nastran punch file) or extptfm (superelement of OpenFAST)")
      ->check(CLI::IsMember(formats));
  return [options] {
    cases::exportCase(*readCase(*options), formats.at(options->format), options->output);
  };
}

const bool exportRegistered =
    addCommand({Group::Results, "export",
                "reduce the parts of a deck and write them with their bases as part files, to be "
                "imported by other decks",
                prepareExport});

}  // namespace

}  // namespace tooljoint::app
