// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/EnergyVerdict.hpp"

#include <cmath>
#include <sstream>

#include "common/Error.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient {
namespace {

/// A run is refused after this many consecutive wrong samples. If the balance is open but no energy
/// is generated, they must also be this fraction of all samples, because little energy has been
/// exchanged at the start.
constexpr int sustained = 10;
constexpr double sustainedPart = 0.1;

std::string describe(const EnergyAccount& account, double t, const std::string& advice) {
  const double made = -account.numerical();
  std::ostringstream text;
  text << "Energy " << (made > 0 ? "grew by " : "of ") << std::abs(made) << " J "
       << (made > 0 ? "without work being done" : "was lost by the integration")
       << " until t = " << t << " s, ";
  if (account.runaway())
    text << "more than the " << account.supplied << " J that were supplied: ";
  else
    text << 100.0 * std::abs(account.residual()) << " % of the energy exchanged: ";
  text << (made > 0 ? "the integration is unstable" : "the steps are too large for the motion")
       << ". " << (made > 0 ? advice : "Reduce Transient/Step, or the tolerance of the integrator")
       << ".";
  return text.str();
}

}  // namespace

bool EnergyVerdict::isWrong(const EnergyAccount& account) const {
  return account.runaway() || std::abs(account.residual()) > options_.energyResidualLimit;
}

bool EnergyVerdict::refuses(const EnergyAccount& account) {
  wrongSamples = isWrong(account) ? wrongSamples + 1 : 0;
  if (wrongSamples < sustained) return false;
  const double all = (options_.end - options_.start) / options_.sampling;
  return account.runaway() || wrongSamples >= sustainedPart * all;
}

void EnergyVerdict::judge(const EnergyAccount& account, double t, const std::string& advice) const {
  if (isWrong(account)) refuse(account, t, advice);
  if (std::abs(account.residual()) > options_.energyResidualWarning)
    log::warn(describe(account, t, advice));
}

void EnergyVerdict::refuse(const EnergyAccount& account, double t,
                           const std::string& advice) const {
  throw ConvergenceError(describe(account, t, advice));
}

}  // namespace tooljoint::transient
