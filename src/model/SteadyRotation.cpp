// SPDX-License-Identifier: BSD-3-Clause
#include "model/SteadyRotation.hpp"

#include <fmt/format.h>
#include <set>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "model/SpeedLaw.hpp"
#include "model/laws/Friction.hpp"
#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

SecondOrderModel atSpeed(SecondOrderModel model, double speed, bool friction) {
  for (auto& law : model.laws.own()) {
    const auto* follows = speedLaw(law);
    if (follows == nullptr) continue;
    const double value = follows->order == 0 ? follows->steady(speed).real() : 0.0;
    law.value = [value](double /*t*/) { return value; };
  }
  for (auto& set : model.points)
    set.law = atSpeed(friction ? set.law : withoutFriction(set.law), speed);
  return model;
}

Eigen::VectorXcd turningLoad(const SecondOrderModel& model, double speed) {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(model.size());
  for (const auto& load : model.loads) {
    const auto* follows = speedLaw(model.laws[at(load.law)]);
    if (follows != nullptr && follows->order == 1)
      sum += follows->steady(speed) * load.vector.cast<std::complex<double>>();
  }
  return sum;
}

std::vector<std::string> matrixLaws(const SecondOrderModel& model, bool ofSpeed) {
  std::set<std::string> names;
  for (const auto* terms : {&model.damping, &model.stiffness})
    for (const auto& term : *terms) {
      const auto& law = model.laws[at(term.law)];
      if (!law.isOne() && (speedLaw(law) != nullptr) == ofSpeed) names.insert(law.name);
    }
  return {names.begin(), names.end()};
}

std::vector<std::string> matrixLawsBeyond(const SecondOrderModel& model, double least,
                                          double most) {
  std::set<std::string> found;
  for (const auto* terms : {&model.damping, &model.stiffness})
    for (const auto& term : *terms) {
      const auto* law = speedLaw(model.laws[at(term.law)]);
      if (law != nullptr && (least < law->least || most > law->most))
        found.insert(fmt::format("\"{}\" ({:.4g} to {:.4g} rpm)", model.laws[at(term.law)].name,
                                 law->least * constants::rpmPerRadianPerSecond,
                                 law->most * constants::rpmPerRadianPerSecond));
    }
  return {found.begin(), found.end()};
}

}  // namespace tooljoint::model
