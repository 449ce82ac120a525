// SPDX-License-Identifier: BSD-3-Clause
// Motions as arrays.
#include "transient/Transient.hpp"

#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Lists.hpp"
#include "Models.hpp"
#include "common/Message.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"

namespace tooljoint::python {

namespace {

using Values = std::vector<double>;

/// Keeps all samples: rows of a time, dofs of the model.
struct Samples : transient::SampleSink {
  Values time, displacement, velocity, acceleration;

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    time.push_back(t);
    displacement.insert(displacement.end(), q.begin(), q.end());
    velocity.insert(velocity.end(), qDot.begin(), qDot.end());
    acceleration.insert(acceleration.end(), qDDot.begin(), qDDot.end());
  }
};

py::dict energiesOf(const transient::EnergyAccount& energy) {
  py::dict row;
  row["kinetic"] = energy.kinetic;
  row["strain"] = energy.strain;
  row["contact"] = energy.contact;
  row["initial"] = energy.initial;
  row["loads"] = energy.loads;
  row["drive"] = energy.drive;
  row["friction"] = energy.friction;
  row["contact_damping"] = energy.contactDamping;
  row["circulatory"] = energy.circulatory;
  py::dict damping;  // of each group of damping terms
  for (std::size_t i = 0; i < energy.damping.size(); ++i)
    damping[py::str(energy.dampingNames[i])] = energy.damping[i];
  row["damping"] = damping;
  row["residual"] = energy.residual();
  return row;
}

py::dict reportOf(const transient::TransientReport& report) {
  py::dict row;
  row["integrator"] = report.integrator;
  row["ranks"] = report.ranks;
  row["steps"] = report.counters.steps;
  row["rejected"] = report.counters.rejected;
  row["newton_iterations"] = report.counters.newtonIterations;
  row["right_hand_sides"] = report.counters.rightHandSides;
  row["wall_s"] = report.wall;
  row["cpu_s"] = report.cpu;
  row["real_time_factor"] = report.realTimeFactor;
  row["step_error"] = report.stepError > 0 ? py::object(py::float_(report.stepError)) : py::none();
  if (report.hasEnergy) row["energy"] = energiesOf(report.energy);
  return row;
}

py::tuple integrate(const ModelPointer& model, const List& list) {
  Samples samples;
  const auto report = longCall([&] {
    auto done = transient::integrate(*model, *list, samples);
    if (done.interrupted)
      throw InterruptedError("The motion was interrupted at t = " + formatNumber(done.end) + " s.");
    return done;
  });
  const auto count = static_cast<py::ssize_t>(samples.time.size());
  const std::vector<py::ssize_t> shape{count, model->size()};
  return py::make_tuple(toNumpy(std::move(samples.time)),
                        toNumpy(std::move(samples.displacement), shape),
                        toNumpy(std::move(samples.velocity), shape),
                        toNumpy(std::move(samples.acceleration), shape), reportOf(report));
}

}  // namespace

void bindTransient(py::module_& module) {
  module.def("integrate", &integrate, py::arg("model"), py::arg("transient"),
             "Time, displacement, velocity and acceleration (samples x dofs), and a report.");
}

}  // namespace tooljoint::python
