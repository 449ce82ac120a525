// SPDX-License-Identifier: BSD-3-Clause
#include "transient/Integrator.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::transient {

void State::save(std::vector<double>& memory) const {
  memory.push_back(t);
  for (const Vector* each : {&q, &v, &a, &x, &xDot})
    memory.insert(memory.end(), each->begin(), each->end());
}

void State::restore(const double*& memory) {
  t = *memory++;
  for (Vector* each : {&q, &v, &a, &x, &xDot})
    for (double& number : *each) number = *memory++;
}

void Counters::accept(double h) {
  minStep = steps == 0 ? h : std::min(minStep, h);
  maxStep = steps == 0 ? h : std::max(maxStep, h);
  ++steps;
}

void Integrator::prepareRetaking(const Integrator&, CompiledModel& model, const Window& window,
                                 const State& start) {
  State state = start;
  prepare(model, window, state);
}

double fittedStep(const Window& window, double asked) {
  const double duration = window.end - window.begin;
  const double unit =
      window.sampling > 0 && asked <= window.sampling * (1 + 1e-9) ? window.sampling : duration;
  return unit / std::max(1.0, std::ceil(unit / asked * (1 - 1e-9)));
}

Teuchos::ParameterList withDefaults(const Teuchos::ParameterList& given,
                                    const deck::ListSpec& spec) {
  Teuchos::ParameterList list(given);
  for (const auto& parameter : spec.parameters()) {
    if (list.isParameter(parameter.name)) continue;
    if (const auto* b = std::get_if<bool>(&parameter.value)) list.set(parameter.name, *b);
    if (const auto* i = std::get_if<int>(&parameter.value)) list.set(parameter.name, *i);
    if (const auto* x = std::get_if<double>(&parameter.value)) list.set(parameter.name, *x);
    if (const auto* s = std::get_if<std::string>(&parameter.value)) list.set(parameter.name, *s);
  }
  return list;
}

int worstPosition(const Vector& x) {
  int worst = 0;
  for (int i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i])) return i;
    if (std::abs(x[i]) > std::abs(x[worst])) worst = i;
  }
  return worst;
}

}  // namespace tooljoint::transient
