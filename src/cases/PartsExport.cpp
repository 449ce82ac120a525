// SPDX-License-Identifier: BSD-3-Clause
#include "cases/PartsExport.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "cases/ReducedCase.hpp"
#include "cases/run/Run.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "parts/ReducedPart.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::cases {

namespace {

namespace fs = std::filesystem;

/// Converts a part name to a file name.
std::string fileName(std::string name) {
  for (char& c : name)
    if (c == '/' || c == '\\' || c == ':') c = '_';
  return name;
}

struct ExportKind {
  parts::FileKind kind;
  const char* ending;
  bool whole;  ///< the file contains the complete part
};

ExportKind kindOf(io::ExportFormat format) {
  switch (format) {
    case io::ExportFormat::MatrixMarket:
      return {parts::FileKind::MatrixMarket, "/", true};
    case io::ExportFormat::NastranDmig:
      return {parts::FileKind::NastranDmig, ".pch", false};
    case io::ExportFormat::ExtPtfm:
      return {parts::FileKind::ExtPtfm, ".dat", false};
    default:
      return {parts::FileKind::Hdf5, ".h5", true};
  }
}

/// Files and folders of rank 0 under temporary names until all of them are written. A failure
/// leaves none of them and keeps the previous ones.
class StagedFiles {
 public:
  StagedFiles() = default;
  ~StagedFiles() {
    std::error_code ignored;
    for (const auto& one : open_)  // and unfinished files of a writer
      for (const char* ending : {"", ".part"})
        fs::remove_all(one.staged.string() + ending, ignored);
  }
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Temporary path for the final `path`. FileError if a folder has the name of the file, or vice
  /// versa.
  std::string add(const fs::path& path, bool folder) {
    if (parallel::rank() == 0 && fs::exists(path) && fs::is_directory(path) != folder)
      throw FileError("The part cannot be written to " + path.string() + ": that is a " +
                      (folder ? "file" : "folder") + ". Remove it, or name another folder.");
    auto staged = path;
    staged += ".part";
    if (parallel::rank() == 0) open_.push_back({staged, path});
    return staged.string();
  }

  void finish() {
    for (const auto& one : open_) {
      std::error_code failed;
      if (fs::is_directory(one.staged)) {  // other files in that folder remain
        fs::create_directories(one.path, failed);
        for (const auto& file : fs::directory_iterator(one.staged))
          if (!failed) fs::rename(file.path(), one.path / file.path().filename(), failed);
      } else {
        fs::rename(one.staged, one.path, failed);
      }
      if (failed)
        throw FileError("The part " + one.staged.string() + " cannot be renamed to " +
                        one.path.string() + ": " + failed.message() + ".");
    }
  }

 private:
  struct Staged {
    fs::path staged, path;
  };
  std::vector<Staged> open_;
};

}  // namespace

parts::LoadTimes loadTimes(const Case& one) {
  if (!one.moves()) return {};
  const auto options = transient::readOptions(one.transient());
  return {options.start, options.end, options.step > 0.0 ? options.step : options.sampling};
}

std::vector<std::string> exportedFiles(const std::vector<std::string>& parts,
                                       io::ExportFormat format) {
  std::set<std::string> names;
  std::vector<std::string> files;
  for (const auto& part : parts) {
    const std::string name = fileName(part);
    if (!names.insert(name).second)
      throw DeckError(
          "Two parts would be exported into the file " + inQuotes(name) +
          ": their names differ only in characters that file names cannot hold. Rename one.");
    files.push_back(name + kindOf(format).ending);
  }
  return files;
}

void exportParts(const std::vector<parts::PartContent>& originals,
                 const std::vector<reduction::ReducedSubstructure>& reduced,
                 io::ExportFormat format, const std::string& folder,
                 const parts::LoadTimes& times) {
  if (format == io::ExportFormat::None) return;
  std::vector<std::string> names;
  for (const auto& part : reduced) names.push_back(part.name);
  const auto written = exportedFiles(names, format);
  parallel::agree([&] {
    if (parallel::rank() == 0) {
      std::error_code failed;
      fs::create_directories(folder, failed);
      if (failed)
        throw FileError("The folder \"" + folder +
                        "\" for exported parts cannot be made: " + failed.message() + ".");
    }
    StagedFiles files;
    const bool folders = format == io::ExportFormat::MatrixMarket;
    for (std::size_t p = 0; p < reduced.size(); ++p) {
      const auto content = parts::reducedContent(originals[p], reduced[p]);
      for (const auto& law : content.omitted)
        log::warn("Part \"" + reduced[p].name + "\" is exported without its point law \"" + law +
                  "\", which a part file cannot hold.");
      if (format == io::ExportFormat::ExtPtfm && originals[p].turned)
        log::warn(
            "Part \"" + reduced[p].name +
            "\" is written in its own axes, without its rotation in the scene. OpenFAST takes "
            "them for those of the platform.");
      auto path = fs::path(folder) / written[p];
      if (folders) path = path.parent_path();  // without the final slash
      parts::writePart(content, files.add(path, folders), kindOf(format).kind, times);
    }
    files.finish();
  });
  log::info("exported    " + folder + ": " + join(written, ", "));
  if (!kindOf(format).whole)
    log::info(
        "            matrices and loads alone: basis, interface sets and initial state are not "
        "part of this format");
}

void exportCase(const Case& one, io::ExportFormat format, const std::string& folder) {
  const auto& deck = one.deck();
  if (!one.reduces())
    throw DeckError(deck.file() + ": /" + deck.name() +
                    " has no Reduction list, so there is no reduced part to export. Add one.");
  announce(one);
  const auto rest = one.atRest();
  const auto text = rest->describe();
  if (!text.empty()) log::info(text);
  const auto reduced = reduce(one, *rest);
  log::info(reduction::summaryTable(reduced.parts()));
  if (reduced.coupled().dependent > 0)
    log::warn(std::to_string(reduced.coupled().dependent) +
              " coordinates of the parts depend on the others in this model (\"Residual "
              "Coordinates\" = \"Tied\"). In part files they are free: coupled again, the parts "
              "are the model of \"Free\".");
  exportParts(rest->contents(reduced.unreduced.parts), reduced.parts(), format,
              folder.empty()
                  ? (fs::path("results") / fs::path(deck.file()).stem() / "parts").string()
                  : folder,
              loadTimes(one));
}

}  // namespace tooljoint::cases
