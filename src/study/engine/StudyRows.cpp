// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/StudyRows.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "study/reference/FittedReference.hpp"

namespace tooljoint::study {
namespace {

/// If the reference and its companions take longer than this CPU time [s], advice on a cheaper one
/// is printed.
constexpr double longReference = 60.0;
constexpr int kStoreFormat = 4;  ///< raised when the meaning of a stored row changes

void again(StudyRow& row, const PreparedModel& prepared, const Execution& execution) {
  row.cpu.push_back(execution.cpu);
  row.wall.push_back(execution.wall);
  row.setupCpu = std::min(row.setupCpu, prepared.setupCpu + execution.setupCpu);
  row.setupWall = std::min(row.setupWall, prepared.setupWall + execution.setupWall);
}

}  // namespace

StudyRows::StudyRows(const StudyPlan& plan, const std::string& folder, const Timing& timing)
    : plan_(plan),
      timing_(timing),
      result_{plan, nullptr, {}, ""},
      timed_(plan.runs.size(), 0),
      comparison_(plan) {
  for (const auto& run : plan_.runs) {
    StudyRow row;
    row.plan = run.plan;
    result_.rows.push_back(row);
  }
  parallel::agree([&] {
    store_.emplace(folder);
    result_.machine = machineName();
  });
  makeKeys();
  find();
}

/// Data that determine a row: the deck of its run and that of the reference, the program and the
/// ranks, and the compared quantities.
void StudyRows::makeKeys() {
  keys_.assign(plan_.runs.size(), "");
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    const auto program = std::to_string(kStoreFormat) + "\n" + cases::programStamp() + "\n" +
                         std::to_string(timing_.ranks) + "\n";
    const auto reference = sha256(program + contentOf(*plan_.runs[0].scene));
    const auto common = reference + "\n" + formatNumber(plan_.windowEnd) + "\n" +
                        (plan_.hasStatistics() ? "statistics\n" : "\n");
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
      const auto& run = plan_.runs[i];
      if (!run.scene) continue;
      auto kind = kindName(run.plan.kind);
      if (run.plan.kind == RunKind::Sensitivity) kind += formatNumber(plan_.settings.perturbation);
      if (run.plan.reduced) kind += std::to_string(plan_.settings.frequencies);
      keys_[i] = sha256(common + kind + "\n" + contentOf(*run.scene));
    }
  });
}

/// Times depend on the machine and on other work on it.
bool StudyRows::usable(const StudyRow& row) const {
  const auto limit = plan_.settings.timeLimit;
  if (row.givenUpAfter > 0.0 && (!limit || *limit > row.givenUpAfter)) return false;
  const bool quiet = !timing_.beside || (row.beside && *row.beside <= *timing_.beside);
  return timing_.anyMachine || (row.machine == result_.machine && quiet);
}

/// Reads the stored rows on rank 0 and distributes the result.
void StudyRows::find() {
  std::vector<int> found;
  for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
    auto& row = result_.rows[i];
    if (plan_.runs[i].scene && store_->restore(keys_[i], row) &&
        row.plan.kind != RunKind::Reference && !usable(row))
      forget(row);
    found.push_back(row.status == "failed" ? -1 : static_cast<int>(row.cpu.size()));
  }
  history_ = store_->restoreHistory(keys_[0]);
  if (!history_) found[0] = 0;
  if (found[0] == 0 && parallel::rank() == 0) forget(result_.rows[0]);
  parallel::broadcast(found);
  timed_ = found;
}

int StudyRows::wantedRepeats(std::size_t i) const {
  return plan_.runs[i].plan.kind == RunKind::Method ? plan_.settings.repeats : 1;
}

bool StudyRows::isComplete(std::size_t i) const {
  return timed_[i] < 0 || timed_[i] >= wantedRepeats(i);
}

std::size_t StudyRows::completed() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < timed_.size(); ++i) count += isComplete(i) ? 1 : 0;
  return count;
}

void StudyRows::computeReference() {
  try {
    moveReference();
  } catch (const Error& error) {
    for (auto passed :
         {ExitCode::Interrupted, ExitCode::Files, ExitCode::Internal, ExitCode::InvalidDeck})
      if (error.code() == passed) throw;
    result_.rows[0].status = "failed";
    result_.rows[0].reason = error.what();
    throw ConvergenceError(
        std::string("The reference run failed, so there is nothing to compare with. ") +
        error.what() + " Change the deck, or Study/Reference/Set.");
  }
}

void StudyRows::computeCompanions() {
  for (std::size_t i = 1; i < plan_.referenceRuns(); ++i)
    if (!isComplete(i)) run(i, result_.rows[i].plan.label);
}

void StudyRows::takeReference() {
  if (timed_[0] <= 0)
    throw FileError(
        "The reference run of the study is not known yet. Compute it first: the same "
        "command with --row reference.");
  setReference();
}

void StudyRows::setReference() {
  result_.rest = plan_.runs[0].scene->atRest();
  parallel::agree([&] {
    if (parallel::rank() == 0) comparison_.setReference(*result_.rest, std::move(*history_));
  });
}

void StudyRows::moveReference() {
  if (timed_[0] > 0) return setReference();
  const auto& first = plan_.runs[0];
  result_.rest = first.scene->atRest();
  const auto prepared = runner_.prepare(*first.scene, 0);
  sayCost(prepared);
  auto execution = runner_.move(*first.scene, prepared, {"reference", true, 0.0, std::nullopt});
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    comparison_.setReference(*result_.rest, std::move(execution.history));
    store_->keepHistory(keys_[0], comparison_.reference());
    comparison_.book(first, prepared, execution, result_.rows[0]);
    sign(result_.rows[0]);
    store_->keep(keys_[0], result_.rows[0]);
  });
  timed_[0] = 1;
}

/// The check uses the same model; the perturbed run uses the steps of the reference.
void StudyRows::sayCost(const PreparedModel& prepared) {
  result_.predictedCpu = runner_.predictedCpu(*plan_.runs[0].scene, prepared);
  const auto check = runner_.predictedCpu(*plan_.runs[1].scene, prepared);
  if (!result_.predictedCpu || !check) return;
  const double all =
      *check + static_cast<double>(plan_.referenceRuns() - 1) * *result_.predictedCpu;
  log::info("reference   " + describeReference(plan_.settings, plan_.runs[0].scene->transient()) +
            fmt::format(": about {:.2g} s of CPU time, {:.2g} s with the runs that check it",
                        *result_.predictedCpu, all) +
            (all > longReference ? ". Study/Reference and Study/Check make it cheaper." : ""));
}

void StudyRows::copyRepeatedRows() {
  for (std::size_t i = plan_.referenceRuns(); i < plan_.runs.size(); ++i) {
    if (isFirst(i)) continue;
    const auto plan = result_.rows[i].plan;
    result_.rows[i] = result_.rows[plan_.runs[i].twin];
    result_.rows[i].plan = plan;
    timed_[i] = timed_[plan_.runs[i].twin];
  }
}

void StudyRows::run(std::size_t i, const std::string& title) {
  try {
    execute(i, title);
    ++timed_[i];
  } catch (const TimeLimitError& error) {
    fail(i, error.what(), plan_.settings.timeLimit.value_or(0.0));
  } catch (const Error& error) {
    const auto code = error.code();
    if (code != ExitCode::InvalidDeck && code != ExitCode::ModelNotBuilt &&
        code != ExitCode::NotConverged)
      throw;
    fail(i, error.what(), 0.0);
  }
  sign(result_.rows[i]);
  parallel::agree([&] {
    if (parallel::rank() == 0) store_->keep(keys_[i], result_.rows[i]);
  });
}

void StudyRows::execute(std::size_t i, const std::string& title) {
  const auto& one = plan_.runs[i];
  const bool first = timed_[i] == 0;
  const double perturbation =
      one.plan.kind == RunKind::Sensitivity ? plan_.settings.perturbation : 0.0;
  const auto limit = one.plan.kind == RunKind::Method ? plan_.settings.timeLimit : std::nullopt;
  const auto prepared = runner_.prepare(*one.scene, first ? plan_.settings.frequencies : 0);
  if (first) bookModel(prepared, result_.rows[i]);
  const auto execution = runner_.move(*one.scene, prepared, {title, first, perturbation, limit});
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    if (first)
      comparison_.book(one, prepared, execution, result_.rows[i]);
    else
      again(result_.rows[i], prepared, execution);
  });
}

/// Records the machine and the number of other rows running there during the timing: none for the
/// reference, for which all groups wait.
void StudyRows::sign(StudyRow& row) const {
  row.machine = result_.machine;
  row.beside = row.plan.kind == RunKind::Reference ? 0 : timing_.beside;
}

/// Keeps the results known before the motion.
void StudyRows::fail(std::size_t i, const std::string& reason, double givenUpAfter) {
  StudyRow row;
  auto& old = result_.rows[i];
  row.plan = old.plan, row.basis = old.basis, row.modes = old.modes, row.dofs = old.dofs,
  row.modeErrors = old.modeErrors;
  row.status = "failed";
  row.reason = reason;
  row.givenUpAfter = givenUpAfter;
  old = row;
  timed_[i] = -1;
}

}  // namespace tooljoint::study
