// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The files of an analysis of a case: its folder, tables, NAME.h5 and summary.json.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cases/Case.hpp"
#include "cases/run/Run.hpp"
#include "common/Error.hpp"
#include "common/report/Stopwatch.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::cases {

/// The folder `given` on the command line, else that of the deck or results/NAME for NAME.xml,
/// with "_<analysis>" behind it.
std::string analysisFolder(const Case& one, const std::string& given, const std::string& analysis);

/// What becomes of the finished results of another command in the folder.
enum class Beside {
  Nothing,  ///< they go
  Results   ///< they stay: their summary gets the group of this analysis
};

class AnalysisFiles {
 public:
  /// Opens the folder. FileError. Collective. The case must outlive the object.
  AnalysisFiles(const Case& one, const std::string& given, const std::string& analysis,
                Beside beside = Beside::Nothing);

  io::OutputFolder& folder() { return *folder_; }
  io::Summary& summary() { return summary_; }

  /// Runs `work`, then writes with `write` (tables into the folder, groups into NAME.h5, figures
  /// into the summary) and publishes; an error leaves a summary that says what happened, and is
  /// thrown on. Collective.
  void complete(const std::function<void()>& work,
                const std::function<void(io::ResultsFile&)>& write);

 private:
  void keepOthers();
  void stageSummary();
  void stamp(const std::string& status, const std::string& message);
  void leave(const Error& error);

  const Case& case_;
  std::string name_;  ///< of the analysis
  Stopwatch watch_;
  std::unique_ptr<io::OutputFolder> folder_;
  io::Summary summary_;
  bool beside_ = false;  ///< results of another command
};

/// An analysis from its results to its files: announces the case, computes the results, prints and
/// writes the report of them, and returns them. `reportOf(results)` has print(),
/// write(OutputFolder&, ResultsFile&) and summarise(Summary&). Errors: those of
/// AnalysisFiles::complete. Collective.
template <class Compute, class ReportOf>
auto completeReport(const Case& one, const std::string& given, const std::string& analysis,
                    const Compute& compute, const ReportOf& reportOf) {
  AnalysisFiles files(one, given, analysis);
  decltype(compute()) results;
  files.complete(
      [&] {
        announce(one);
        results = compute();
        reportOf(results).print();
      },
      [&](io::ResultsFile& file) {
        const auto report = reportOf(results);
        report.write(files.folder(), file);
        report.summarise(files.summary());
      });
  return results;
}

}  // namespace tooljoint::cases
