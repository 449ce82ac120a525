// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Estimated against true errors over the scenes of xml/, and tolerances met there.
#include "tests/support/Scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cases/CaseKinds.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "estimate/ModeComparison.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"
#include "tests/support/TrackedDecks.hpp"

namespace ScenesTest {

using namespace tooljoint;

std::string folder() { return testing_::sourceFolder() + "/xml/"; }

/// Largest number of free dofs: twenty modes of a string of 5 km take minutes.
constexpr int mostDofs = 20000;
/// The limit without TOOLJOINT_THOROUGH in the environment (target `thorough`): strings of a
/// kilometre take half a minute.
constexpr int mostDofsInShort = 3000;

/// Every deck of the project in xml/ that is a string with a Reduction list, except for strings of
/// several kilometres, and for maps and studies of strings with their own deck.
std::vector<std::string> scenes() {
  const int most = std::getenv("TOOLJOINT_THOROUGH") != nullptr ? mostDofs : mostDofsInShort;
  std::vector<std::string> files;
  for (const auto& name : testing_::trackedDecks(folder())) {
    if (name.rfind("map_", 0) == 0 || name.rfind("study_", 0) == 0) continue;
    const auto one = cases::readCase(folder() + name, {});
    if (one->reduces() && one->freeDofs() < most &&
        dynamic_cast<const drillstring::DrillstringCase*>(one.get()) != nullptr)
      files.push_back(name);
  }
  return files;
}

/// A scene at rest with its full model.
struct Rest {
  drillstring::StaticStage stage;
  model::SecondOrderModel full;
};

/// Computed once for all tests: none of them changes inputs of the state at rest.
const Rest& restOf(const std::string& file) {
  static std::map<std::string, Rest> found;
  const auto it = found.find(file);
  if (it != found.end()) return it->second;
  Rest rest{drillstring::solveStatic(drillstring::readScene(file, {})), {}};
  Rest& kept = found.emplace(file, std::move(rest)).first->second;
  kept.full = drillstring::fullModel(kept.stage);
  return kept;
}

/// A scene taken through reductions that differ in the choice of modes, and motions.
struct Case {
  std::string file;
  std::vector<std::string> overrides;
  drillstring::Scene scene;
  const drillstring::StaticStage& stage;
  const model::SecondOrderModel& full;

  Case(const std::string& name, const std::vector<std::string>& more = {})
      : file(folder() + name),
        overrides(more),
        scene(drillstring::readScene(file, more)),
        stage(restOf(file).stage),
        full(restOf(file).full) {}

  /// The scene with another Reduction list.
  drillstring::Scene with(const std::vector<std::string>& reduction) const {
    std::vector<std::string> all = overrides;
    all.emplace_back("!Reduction");
    all.insert(all.end(), reduction.begin(), reduction.end());
    return drillstring::readScene(file, all);
  }
};

/// Estimate over true error of every frequency whose error is above rounding.
std::vector<double> ratios(const Case& c, const std::string& choice, int count) {
  const auto scene = c.with({"Reduction/Mode Selection/" + choice});
  const auto parts = drillstring::cut(scene, c.stage);
  const auto outcome = estimate::synthesise(parts, scene.list().sublist("Reduction"));
  std::vector<double> all;
  for (const auto& mode : estimate::compareModes(c.full, parts, outcome.synthesis, count))
    if (mode.error > 1e-9 && mode.mac > 0.9) all.push_back(mode.estimate / mode.error);
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  if (!all.empty())
    std::printf("%-28s %zu of %d frequencies: estimate over error %.3f to %.3f\n", choice.c_str(),
                all.size(), count, *low, *high);
  return all;
}

TEST(FrequencyEstimates, AreWithinAFactorOfThreeOfTheTrueErrors) {
  int counted = 0;
  const auto look = [&](const Case& c, const std::string& choice) {
    for (double ratio : ratios(c, choice, 20)) {
      EXPECT_GT(ratio, 1.0 / 3.0) << choice;
      EXPECT_LT(ratio, 3.0) << choice;
      ++counted;
    }
  };
  const Case parts("helical_170m.xml");
  for (const char* cutOff : {"10", "25", "100", "400"})
    look(parts, std::string("Cut-off Frequency=") + cutOff);
  const Case single("helical_170m_source.xml");
  for (const char* modes : {"30", "60", "180"}) look(single, std::string("Modes=") + modes);
  EXPECT_GT(counted, 100);
}

TEST(FrequencyTolerance, IsMetOnEveryScene) {
  ASSERT_GE(scenes().size(), 2u);
  for (const auto& file : scenes()) {
    const Case c(file);
    const Vector full = linalg::lowestModes(coupling::undampedStiffness(c.full),
                                            reduction::symmetricPart(c.full.mass), 20)
                            .values;
    for (double tolerance : {1e-2, 1e-4}) {
      char choice[64];
      std::snprintf(choice, sizeof choice, "Reduction/Mode Selection/Frequency Tolerance=%g",
                    tolerance);
      const auto scene = c.with({choice});
      const auto parts = drillstring::cut(scene, c.stage);
      const auto outcome = estimate::synthesise(parts, scene.list().sublist("Reduction"));
      // By number, not by shape: the i-th coupled frequency is the i-th full one.
      double worst = 0;
      for (int i = 0; i < 20; ++i)
        worst =
            std::max(worst, std::abs(outcome.frequencies[static_cast<std::size_t>(i)].frequency() *
                                         constants::twoPi / reduction::signedOmega(full[i]) -
                                     1.0));
      std::printf(
          "%-24s tolerance %.0e: %d modes in %zu rounds, %d of %d dofs, error %.1e, estimate "
          "%.1e\n",
          file.c_str(), tolerance, outcome.rounds.back().modes, outcome.rounds.size(),
          outcome.synthesis.coupled.model.size(), c.full.size(), worst,
          outcome.rounds.back().frequencyError);
      EXPECT_LE(worst, tolerance) << file;
    }
  }
}

/// |(u, v) - (u, v)_ref| / |(u, v)_ref - (u, v)_static|.
double vibration(const std::vector<Vector>& motion, const std::vector<Vector>& reference,
                 const Vector& rest) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (Eigen::Index row = 0; row < rest.size(); ++row)
      if (row % 6 < 2) {
        error += std::pow(motion.at(i)[row] - reference[i][row], 2);
        size += std::pow(reference[i][row] - rest[row], 2);
      }
  return std::sqrt(error / size);
}

/// Records a motion and estimates its error.
class Watched : public transient::SampleSink {
 public:
  Watched(const std::vector<model::Substructure>& parts, const coupling::Synthesis& synthesis,
          const Vector& rest)
      : history_(synthesis.coupled.model), estimator_(parts, synthesis, rest) {}
  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    history_.sample(t, q, qDot, qDDot);
    estimator_.sample(t, q, qDot, qDDot);
  }
  const std::vector<Vector>& columns() const { return history_.columns(); }
  estimate::MotionEstimate result() const { return estimator_.result(); }

 private:
  testing_::History history_;
  estimate::MotionEstimator estimator_;
};

/// Half a second, before neighbouring motions separate (later the difference is not that of the
/// reduction), in steps that resolve the truncated modes: at 1 ms and 200 Hz, 1.3 rad per step, the
/// full model does not move as its modes do. The phase correction is off, because its noise (3e-4
/// between two models at 1 ms) equals the truncation error at 400 Hz. The iteration tolerance is
/// small enough to add no error (with the default of 1e-5 it decides which contact acts first: 1e-3
/// and more).
const std::vector<std::string> window{"Transient/End Time=0.5", "Transient/Step=2.5e-4",
                                      "Transient/Progress=false",
                                      "Transient/Generalized-alpha/Phase Correction=false",
                                      "Transient/Generalized-alpha/Tolerance=1e-7"};

/// The full model of the reference scene in this window.
const std::vector<Vector>& referenceMotion(const Case& c) {
  static const auto motion = testing_::move(c.scene, c.full);
  return motion;
}

/// Measured: 0.48 to 0.80 times the true error. If a part lacks a mode that the motion excites (25
/// Hz), the response is not static and the estimate is too large; it is then above 5 %.
TEST(MotionEstimate, IsWithinAFactorOfThreeOfDynOnTheReferenceScene) {
  const Case c("helical_170m.xml", window);
  const Vector rest = c.stage.state.displacement;
  const auto& reference = referenceMotion(c);
  int counted = 0;
  for (const char* cutOff : {"25", "50", "100", "200", "400"}) {
    const auto scene =
        c.with({std::string("Reduction/Mode Selection/Cut-off Frequency=") + cutOff});
    const auto parts = drillstring::cut(scene, c.stage);
    const auto outcome = estimate::synthesise(parts, scene.list().sublist("Reduction"));
    Watched watched(parts, outcome.synthesis, rest);
    const auto report = transient::integrate(outcome.synthesis.coupled.model,
                                             scene.list().sublist("Transient"), watched);
    const double truth = vibration(watched.columns(), reference, rest);
    const auto estimate = watched.result();
    std::printf(
        "cut-off %3s Hz: vibration error %.2e, estimated %.2e (%.2f times), %.2f of %.2f s\n",
        cutOff, truth, estimate.error, estimate.error / truth, estimate.wall, report.wall);
    EXPECT_GT(estimate.error, truth / 3.0) << cutOff;
    if (estimate.error > 0.05) continue;
    EXPECT_LT(estimate.error, truth * 3.0) << cutOff;
    ++counted;
  }
  EXPECT_GE(counted, 4);
}

/// vibration error of a scene with as many modes as the tolerance takes, against the full model.
double chosen(const Case& c, const std::vector<Vector>& reference, double tolerance) {
  const Vector rest = c.stage.state.displacement;
  char choice[64];
  std::snprintf(choice, sizeof choice, "Reduction/Mode Selection/Motion Tolerance=%g", tolerance);
  const auto scene = c.with({choice});
  const auto& transient = scene.list().sublist("Transient");
  const auto parts = drillstring::cut(scene, c.stage);
  const auto outcome = estimate::synthesise(
      parts, scene.list().sublist("Reduction"),
      [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
        estimate::MotionEstimator estimator(parts, synthesis, rest);
        return estimate::watchMotion(estimator, synthesis.coupled.model,
                                     transient::readOptions(transient), limit);
      });
  const double truth =
      vibration(testing_::move(scene, outcome.synthesis.coupled.model), reference, rest);
  std::printf("tolerance %.0e: %d modes in %zu rounds, estimate %.1e, vibration error %.1e\n",
              tolerance, outcome.rounds.back().modes, outcome.rounds.size(),
              outcome.rounds.back().motionError, truth);
  return truth;
}

TEST(MotionTolerance, IsMetOnTheReferenceScene) {
  const Case c("helical_170m.xml", window);
  const auto& reference = referenceMotion(c);
  for (double tolerance : {5e-2, 5e-3}) EXPECT_LE(chosen(c, reference, tolerance), tolerance);
}

/// The reference takes the same steps, so coarse steps have no effect.
TEST(MotionTolerance, IsMetAtTheStartOfEveryOtherScene) {
  ASSERT_GE(scenes().size(), 2u);
  for (const auto& file : scenes()) {
    if (file == "helical_170m.xml") continue;
    if (file == "stick_slip_2500m.xml")
      continue;  // laws with states have no estimate of the motion
    const Case c(file, {"Transient/End Time=0.1", "Transient/Progress=false",
                        "Transient/Step Error Limit=1000"});
    std::printf("%s, 0.1 s: ", file.c_str());
    EXPECT_LE(chosen(c, testing_::move(c.scene, c.full), 2e-2), 2e-2) << file;
  }
}

}  // namespace ScenesTest
