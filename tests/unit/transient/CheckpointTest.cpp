// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The file of a checkpoint: all contents are restored, changed bytes are refused, and only
/// matching models and steps are accepted.
#include <functional>
#include <gtest/gtest.h>
#include <map>

#include "Models.hpp"
#include "common/Error.hpp"
#include "common/Sha256.hpp"
#include "io/TextFile.hpp"
#include "tests/support/ErrorText.hpp"
#include "tests/unit/io/Scratch.hpp"
#include "transient/ModelIdentity.hpp"

namespace tooljoint::transient::testing {
namespace CheckpointTest {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Checkpoint full() {
  Checkpoint point;
  point.run = "Transient/End Time = 2\n";
  point.program = "1.2.3 abc";
  point.integrator = "RK4";
  point.model = sha256("model");
  point.ranks = 4;
  point.figures = {1.5, -0.25};
  point.state.t = 0.1;
  point.state.q = Vector::LinSpaced(3, 0.1, 0.3);
  point.state.v = Vector::LinSpaced(4, 1.1, 1.4);
  point.state.a = Vector::LinSpaced(5, 2.1, 2.5);
  point.counters = {1, 2, 3, 4, 5, 6, 7, {11, 12, 13, 14, 15, 16, 17, 18}, 0.8, 0.9};
  point.contactEvaluations = 8;
  point.samples = 9;
  point.runawaySamples = 10;
  point.memory = {0.1, -0.0, 1e-310};
  point.recorder = {7.5};
  point.rows = {{"/transient/time", 21}, {"/xdmf/time", 3}};
  return point;
}

TEST(Checkpoints, comeBackWhole) {
  const test::Scratch scratch;
  const auto before = full();
  before.write(scratch / "checkpoint.bin");
  const auto after = Checkpoint::read(scratch / "checkpoint.bin");
  EXPECT_EQ(after.run, before.run);
  EXPECT_EQ(after.program, before.program);
  EXPECT_EQ(after.integrator, before.integrator);
  EXPECT_EQ(after.model, before.model);
  EXPECT_EQ(after.ranks, before.ranks);
  EXPECT_EQ(after.figures, before.figures);
  EXPECT_EQ(after.state.t, before.state.t);
  EXPECT_EQ(after.state.q, before.state.q);
  EXPECT_EQ(after.state.v, before.state.v);
  EXPECT_EQ(after.state.a, before.state.a);
  const auto& c = after.counters;
  EXPECT_EQ((std::vector<long>{c.steps, c.rejected, c.halved, c.newtonIterations,
                               c.unconvergedSteps, c.factorisations, c.rightHandSides}),
            (std::vector<long>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(c.strategies, (StrategyCounts{11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(c.minStep, 0.8);
  EXPECT_EQ(c.maxStep, 0.9);
  EXPECT_EQ(after.contactEvaluations, 8);
  EXPECT_EQ(after.samples, 9);
  EXPECT_EQ(after.runawaySamples, 10);
  EXPECT_EQ(after.memory, before.memory);
  EXPECT_EQ(after.recorder, before.recorder);
  EXPECT_EQ(after.rows, before.rows);
  EXPECT_FALSE(std::filesystem::exists(scratch / "checkpoint.bin.part"));
}

TEST(Checkpoints, areRefusedWithAnyBitChanged) {
  const auto bytes = full().encode();
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const int bit : {0, 3, 7}) {
      auto changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
      EXPECT_THROW(Checkpoint::decode(changed, "a file"), FileError)
          << "byte " << i << ", bit " << bit;
    }
}

TEST(Checkpoints, areRefusedWithAnotherLength) {
  const auto bytes = full().encode();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(Checkpoint::decode(bytes.substr(0, length), "a file"), FileError) << length;
  EXPECT_THROW(Checkpoint::decode(bytes + '\0', "a file"), FileError);
  EXPECT_THROW(Checkpoint::decode(bytes + bytes, "a file"), FileError);
}

TEST(Checkpoints, sayWhatIsWrongWithAFile) {
  const auto bytes = full().encode();
  const auto said = [](const std::string& content) {
    return errorText([&] { Checkpoint::decode(content, "DIR/checkpoint.bin"); });
  };
  EXPECT_TRUE(says(said("something else entirely, and long enough to be read as numbers"),
                   "\"DIR/checkpoint.bin\" is not a checkpoint."));
  EXPECT_TRUE(says(said(""), "is not a checkpoint"));
  EXPECT_TRUE(says(said(std::string("\x16\0\0\0\0\0\0\0", 8) + "Tooljoint checkpoint 5" +
                        std::string(200, '\0')),
                   "has the layout 5 of another version of the program; this one reads layout 26"));
  auto changed = bytes;
  changed[20] = 99;  // the layout follows the magic
  EXPECT_TRUE(says(said(changed), "has the layout 99 of another version")) << said(changed);
  EXPECT_TRUE(says(said(bytes.substr(0, bytes.size() - 5)), "is damaged: its header promises"))
      << said(bytes.substr(0, bytes.size() - 5));
  changed = bytes;
  changed.back() = static_cast<char>(changed.back() ^ 1);
  EXPECT_TRUE(says(said(changed), "is damaged: its SHA-256 does not match its content"))
      << said(changed);
  EXPECT_TRUE(
      says(errorText([] { Checkpoint::read("/nowhere/checkpoint.bin"); }), "cannot be read"));
  EXPECT_TRUE(
      says(errorText([] { full().write("/nowhere/checkpoint.bin"); }), "cannot be written"));
}

TEST(Checkpoints, comeAtMultiplesOfTheirInterval) {
  const auto model = eventful();
  auto o = options("Generalized-alpha", 0.3, 1e-3, 0.005);
  o.checkpointInterval = 0.1;
  std::vector<Checkpoint> points;
  RunHooks hooks;
  hooks.keep = [&](const Checkpoint& c) { points.push_back(c); };
  Keep samples;
  integrate(model, o, samples, hooks);
  ASSERT_EQ(points.size(), 2u);  // none at the end
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(points[i].state.t, 0.1 * static_cast<double>(i + 1), 1.1e-3);
  // a continued run has the remaining ones
  const auto first = points.front();
  points.clear();
  hooks.resume = &first;
  integrate(model, o, samples, hooks);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].state.t, 0.2, 1.1e-3);
  points.clear();
  hooks.resume = nullptr;
  o.checkpointInterval = 0;
  integrate(model, o, samples, hooks);
  EXPECT_TRUE(points.empty());
}

/// With another number of ranks, rounding of the static state is accepted, a relevant change is
/// not.
TEST(Identity, inFiguresLetsRoundingPass) {
  const auto o = wayToStep("Generalized-alpha", 0.3);
  const auto same = identityOf(eventful(), o).figures;
  auto rounded = eventful();
  rounded.stiffness.own()[0].matrix.coeffRef(0, 0) *= 1 + 1e-11;
  rounded.initialDisplacement[0] *= 1 + 1e-11;
  EXPECT_TRUE(agree(same, identityOf(rounded, o).figures));
  auto changed = eventful();
  changed.stiffness.own()[0].matrix.coeffRef(0, 0) *= 1 + 1e-5;
  EXPECT_FALSE(agree(same, identityOf(changed, o).figures));
  changed = eventful();
  std::swap(changed.initialVelocity[0], changed.initialVelocity[1]);
  changed.initialVelocity[1] += 0.1;
  EXPECT_FALSE(agree(same, identityOf(changed, o).figures));
  auto longer = o;
  longer.end *= 1.001;
  EXPECT_FALSE(agree(same, identityOf(eventful(), longer).figures));
}

/// The identity compared with a checkpoint: every input that affects the motion changes it.
TEST(Identity, differsForEveryInput) {
  const auto o = wayToStep("Generalized-alpha", 0.3);
  const auto same = identityOf(eventful(), o).digest;
  EXPECT_EQ(identityOf(eventful(), o).digest, same);
  EXPECT_EQ(same.size(), 64u);
  using Model = model::SecondOrderModel;
  const std::map<std::string, std::function<void(Model&)>> changes{
      {"mass", [](Model& m) { m.mass.coeffRef(2, 2) *= 1 + 1e-9; }},
      {"damping", [](Model& m) { m.damping.own()[0].matrix.coeffRef(1, 1) *= 1 + 1e-9; }},
      {"stiffness", [](Model& m) { m.stiffness.own()[0].matrix.coeffRef(0, 0) += 1e-9; }},
      {"law of damping", [](Model& m) { m.damping.own()[0].law = 0; }},
      {"law of stiffness", [](Model& m) { m.stiffness.own()[0].law = 1; }},
      {"load", [](Model& m) { m.loads[1].vector[3] += 1e-9; }},
      {"law of load", [](Model& m) { m.loads[1].law = 0; }},
      {"a load more", [](Model& m) { m.loads.push_back(m.loads[0]); }},
      {"law in time",
       [](Model& m) {
         m.laws.own()[1].value = [](double t) { return 1 + 0.5 * std::sin(40.0001 * t); };
       }},
      {"stiffness of points",
       [](Model& m) { m.points[0].law = std::make_shared<Floor>(6, 1.000001e6, 2e3, 7e11); }},
      {"damping of points",
       [](Model& m) { m.points[0].law = std::make_shared<Floor>(6, 1e6, 2.000001e3, 7e11); }},
      {"rows of points", [](Model& m) { m.points[0].rows.coeffRef(4, 4) = 1 + 1e-9; }},
      {"offset of points", [](Model& m) { m.points[0].offset[5] = 1e-9; }},
      {"initial displacement", [](Model& m) { m.initialDisplacement[0] += 1e-12; }},
      {"initial velocity", [](Model& m) { m.initialVelocity[0] += 1e-12; }},
  };
  for (const auto& [what, change] : changes) {
    auto other = eventful();
    change(other);
    EXPECT_NE(identityOf(other, o).digest, same) << what;
  }
  const std::map<std::string, std::function<void(TransientOptions&)>> steps{
      {"integrator", [](TransientOptions& p) { p.integrator = "RK4"; }},
      {"start", [](TransientOptions& p) { p.start = 1e-9; }},
      {"end", [](TransientOptions& p) { p.end += 1e-9; }},
      {"step", [](TransientOptions& p) { p.step = 1e-3; }},
      {"sampling", [](TransientOptions& p) { p.sampling = 0.001; }},
      {"ledger", [](TransientOptions& p) { p.ledger = false; }},
      {"parameter of the integrator",
       [](TransientOptions& p) { p.own.set("Spectral Radius", 0.80000001); }},
  };
  for (const auto& [what, change] : steps) {
    auto other = o;
    change(other);
    EXPECT_NE(identityOf(eventful(), other).digest, same) << what;
  }
  auto shown = o;
  shown.progress = true;
  shown.checkpointInterval = 3;
  shown.own.set("Spectral Radius", 0.8);  // its default
  EXPECT_EQ(identityOf(eventful(), shown).digest, same);
}

TEST(Identity, isAskedForByARestart) {
  auto model = eventful();
  Checkpoint kept;
  RunHooks hooks, again;
  hooks.stop = [&, calls = 0]() mutable { return ++calls > 5; };
  hooks.keep = [&](const Checkpoint& c) { kept = c; };
  Keep samples;
  const auto o = options("RK4", 0.3, 1e-4, 0.005);
  integrate(model, o, samples, hooks);
  again.resume = &kept;
  EXPECT_TRUE(says(errorText([&] {
                     integrate(model, options("Generalized-alpha", 0.3, 1e-4, 0.005), samples,
                               again);
                   }),
                   "written by the integrator \"RK4\""));
  EXPECT_TRUE(
      says(errorText([&] { integrate(model, options("RK4", 0.3, 2e-4, 0.005), samples, again); }),
           "the steps of the checkpoint"));
  model.loads[1].vector[3] += 1e-9;
  EXPECT_TRUE(says(errorText([&] { integrate(model, o, samples, again); }),
                   "The model or the steps of the checkpoint differ"));
}

}  // namespace CheckpointTest
}  // namespace tooljoint::transient::testing
