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

/// The folder `given` on the command line, otherwise that of the deck or results/NAME for NAME.xml,
/// with "_<analysis>" appended.
std::string analysisFolder(const Case& one, const std::string& given, const std::string& analysis);

/// Treatment of the finished results of another command in the folder.
enum class Beside {
  Nothing,  ///< they are removed
  Results   ///< they remain, and their summary gets the group of this analysis
};

class AnalysisFiles {
 public:
  /// Opens the folder. FileError. Collective. The case must outlive the object.
  AnalysisFiles(const Case& one, const std::string& given, const std::string& analysis,
                Beside beside = Beside::Nothing);

  io::OutputFolder& folder() { return *folder_; }
  io::Summary& summary() { return summary_; }

  /// Runs `work`, then writes with `write` (tables into the folder, groups into NAME.h5, values
  /// into the summary) and publishes. After an error the summary describes it, and the error is
  /// rethrown. Collective.
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

/// Runs an analysis and writes its files: announces the case, computes the results, prints and
/// writes their report, and returns them. `reportOf(results)` has print(), write(OutputFolder&,
/// ResultsFile&) and summarise(Summary&). Errors: those of AnalysisFiles::complete. Collective.
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
