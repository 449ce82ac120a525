// SPDX-License-Identifier: BSD-3-Clause
#include "transient/TransientParameters.hpp"

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

namespace {

/// Limits of the errors of a motion.
void addLimits(deck::ListSpec& spec) {
  const TransientOptions usual;
  spec.real("Step Error Warning", "", usual.stepErrorWarning, deck::Range::positive(),
            "With equal steps, a step error above this is a warning. The step error is an estimate "
            "of the error of the vibration after 3 s or the whole motion, whichever is shorter.")
      .expert()
      .real("Step Error Limit", "", usual.stepErrorLimit, deck::Range::positive(),
            "With equal steps, a run with a step error above this fails. Where the estimate is "
            "above half of this, or contact rests on walls too stiff for the step, the first 3 s "
            "of the motion are integrated again in half the step, or in shorter ones that resolve "
            "such contact. The step error is then the difference of both motions, or, where the "
            "motion is chaotic, that of their speeds over 2.5. A limit of 1 and more compares "
            "nothing: it is one of the estimate.")
      .formerly("Generalized-alpha/Accept Coarse Steps")
      .expert()
      .real("Energy Residual Warning", "", usual.energyResidualWarning, deck::Range::positive(),
            "With the energy ledger: an energy residual of larger size at the end of the motion is "
            "a warning.")
      .expert()
      .real("Energy Residual Limit", "", usual.energyResidualLimit, deck::Range::positive(),
            "With the energy ledger: a run fails when the energy residual is larger in size at the "
            "end of the motion, or for ten samples in a row that are a tenth of all.")
      .expert();
}

}  // namespace

deck::ListSpec parameters() {
  const auto& registry = IntegratorRegistry::instance();
  deck::ListSpec spec("Transient",
                      "Motion in time. Without this list a run stops at the static state.");
  spec.choice("Integrator", std::string("Generalized-alpha"), registry.names(),
              "Time integration method; its own parameters stand in the sublist of that name.")
      .real("Start Time", "s", 0.0, deck::Range::any(), "Time at which the motion starts.")
      .expert()
      .real("End Time", "s", deck::Required{}, deck::Range::any(),
            "Time at which the motion ends; later than Start Time.")
      .real("Step", "s", deck::Optional{}, deck::Range::positive(),
            "Fixed step, or with Generalized-alpha/Step Tolerance the longest; shortened so that "
            "it divides the sampling interval. "
            "By default 0.001 s for Generalized-alpha and 0.9 of the stability limit for RK4; RK4 "
            "adaptive chooses its own.")
      .real("Sampling Interval", "s", 0.005, deck::Range::positive(),
            "Time between two recorded states; both ends of the motion are recorded when they fall "
            "on it.")
      .boolean("Progress", true,
               "Show a progress bar, or a line per 10 % when the output is not a terminal.")
      .expert()
      .boolean("Energy Ledger", true,
               "Keep account of kinetic, strain and contact energy, of the work of all loads and "
               "of every dissipation.")
      .expert()
      .real("Checkpoint Interval", "s", 1.0, deck::Range::nonNegative(),
            "Simulated time between two states saved for a restart; 0 saves one only when the run "
            "is interrupted. The integrators of SUNDIALS begin "
            "anew at each of them and go on only from there.")
      .expert()
      .choice("Ranks", std::string("Automatic"), {"Automatic", "Divide", "Alike"},
              "Work of several MPI ranks: each computes a piece of the model (Divide), or all do "
              "the same (Alike). Automatic divides models of 1500 dofs and more. The integrators "
              "of SUNDIALS do not divide a motion and refuse Divide.")
      .expert();
  addLimits(spec);
  for (const auto& [name, entry] : registry.entries()) {
    deck::ListSpec own(name, entry.doc);
    own.merge(entry.parameters);
    spec.list(own);
  }
  return spec;
}

namespace {

/// More steps than this would take years, and more samples would fill any disk: such values are
/// typing errors.
constexpr double mostSteps = 1e12;
constexpr double mostSamples = 1e8;

void requireCounts(const TransientOptions& options) {
  const double duration = options.end - options.start;
  const auto require = [&](const char* what, double interval, double most) {
    const double count = duration / interval;
    if (count <= most) return;
    throw DeckError(std::string("Transient/") + what + " is " + formatNumber(interval) +
                    " s, which gives " + countText(count) + " intervals in the " +
                    formatNumber(duration) + " s from Start Time to End Time. The limit is " +
                    countText(most) + ". Give a longer one, or an earlier End Time.");
  };
  if (options.step > 0.0) require("Step", options.step, mostSteps);
  require("Sampling Interval", options.sampling, mostSamples);
}

}  // namespace

bool isExplicit(const Teuchos::ParameterList& transient) {
  const auto list = withDefaults(transient, parameters());
  const auto& name = list.get<std::string>("Integrator");
  const auto own = list.isSublist(name) ? list.sublist(name) : Teuchos::ParameterList(name);
  return IntegratorRegistry::instance().make(name, own)->isExplicit();
}

TransientOptions readOptions(const Teuchos::ParameterList& given) {
  const Teuchos::ParameterList list = withDefaults(given, parameters());
  TransientOptions options;
  options.integrator = list.get<std::string>("Integrator");
  options.start = list.get<double>("Start Time");
  if (!list.isParameter("End Time"))
    throw DeckError("Transient/End Time is required: the time in s at which the motion ends.");
  options.end = list.get<double>("End Time");
  if (list.isParameter("Step")) options.step = list.get<double>("Step");
  options.sampling = list.get<double>("Sampling Interval");
  options.progress = list.get<bool>("Progress");
  options.ledger = list.get<bool>("Energy Ledger");
  options.checkpointInterval = list.get<double>("Checkpoint Interval");
  const auto& ranks = list.get<std::string>("Ranks");
  options.ranks = ranks == "Divide"  ? RankUse::Divide
                  : ranks == "Alike" ? RankUse::Alike
                                     : RankUse::Automatic;
  options.stepErrorWarning = list.get<double>("Step Error Warning");
  options.stepErrorLimit = list.get<double>("Step Error Limit");
  options.energyResidualWarning = list.get<double>("Energy Residual Warning");
  options.energyResidualLimit = list.get<double>("Energy Residual Limit");
  if (list.isSublist(options.integrator)) options.own = list.sublist(options.integrator);
  if (!(options.end > options.start))
    throw DeckError("Transient/End Time (" + formatNumber(options.end) +
                    " s) must be later than Transient/Start Time (" + formatNumber(options.start) +
                    " s).");
  requireCounts(options);
  IntegratorRegistry::instance()
      .make(options.integrator, options.own)
      ->checkParameters(options.step);
  return options;
}

}  // namespace tooljoint::transient
