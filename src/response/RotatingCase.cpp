// SPDX-License-Identifier: BSD-3-Clause
#include "response/RotatingCase.hpp"

#include <algorithm>

#include "cases/ModesReport.hpp"
#include "cases/run/Report.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "estimate/PartResidual.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "model/DofNames.hpp"
#include "model/HarmonicTangent.hpp"
#include "model/SteadyRotation.hpp"
#include "stability/StateStability.hpp"

namespace tooljoint::response {

RotatingCase::RotatingCase(const cases::Case& one, bool friction, bool announce)
    : case_(one),
      friction_(friction),
      time_(cases::timeOfLaws(one)),
      rest_(announce ? one.atRest() : one.solveStatic()) {
  const auto text = rest_->describe();
  if (announce && !text.empty()) log::info(text);
  if (!one.reduces()) {
    full();
    return;
  }
  reduced_ = cases::reduce(one, *rest_);
  if (announce) log::info(cases::describeCoupling(reduced_->coupled()));
  for (const auto& remark : reduced_->coupled().remarks) log::warn(remark);
  const auto& synthesis = reduced_->outcome.synthesis;
  rounding_ = estimate::roundingOfParts(parts(), synthesis);
  if (estimate::isRitz(synthesis) && !synthesis.coupled.wholeInterfaces)
    error_ = std::make_unique<estimate::DynamicError>(parts(), synthesis, partsAt(0.0));
}

const model::SecondOrderModel& RotatingCase::model() const {
  return reduced_ ? reduced_->model() : full();
}

const std::vector<model::Substructure>& RotatingCase::parts() const {
  static const std::vector<model::Substructure> none;
  return reduced_ ? reduced_->unreduced.parts : none;
}

const model::SecondOrderModel& RotatingCase::full() const {
  if (!full_) full_ = rest_->full();
  return full_->model;
}

model::SecondOrderModel RotatingCase::turning(const model::SecondOrderModel& model,
                                              double speed) const {
  return model::atSpeed(model, speed, friction_);
}

std::vector<model::Substructure> RotatingCase::turningParts(double speed) const {
  auto turned = parts();
  for (auto& part : turned) part.model = turning(part.model, speed);
  return turned;
}

template <class Models>
auto RotatingCase::linearised(const Models& models, std::optional<double> omega) const {
  return omega ? estimate::linearise(models, time_, *omega) : estimate::linearise(models, time_);
}

estimate::Linearised RotatingCase::at(double speed, std::optional<double> omega) const {
  return linearised(turning(model(), speed), omega);
}

estimate::Linearised RotatingCase::fullAt(double speed, std::optional<double> omega) const {
  return linearised(turning(full(), speed), omega);
}

std::vector<estimate::Linearised> RotatingCase::partsAt(double speed,
                                                        std::optional<double> omega) const {
  return linearised(turningParts(speed), omega);
}

linalg::QuadraticModes RotatingCase::modes(const estimate::Linearised& m, int count) const {
  const int most = std::min(count, 2 * model().size());
  return reduced_ ? estimate::physicalDampedModes(model(), m, most, rounding_)
                  : linalg::lowestDampedModes(m.mass, m.damping, m.stiffness, most,
                                              model::namer(model()));
}

linalg::QuadraticModes RotatingCase::modes(const estimate::Linearised& m,
                                           const linalg::DampedTarget& target) const {
  return reduced_ ? estimate::physicalDampedModes(model(), m, target, rounding_)
                  : linalg::dampedModesNear(m.mass, m.damping, m.stiffness, target);
}

template <class Which>
std::vector<estimate::ModeComparison> RotatingCase::compareAt(double speed,
                                                              const Which& which) const {
  auto synthesis = reduced_->outcome.synthesis;
  synthesis.coupled.model = turning(synthesis.coupled.model, speed);
  const auto whole = turning(full(), speed);
  return estimate::compareDampedModes(whole, turningParts(speed), synthesis, which, time_,
                                      full_->maps);
}

std::vector<estimate::ModeComparison> RotatingCase::compare(double speed, int count) const {
  return compareAt(speed, count);
}

std::vector<estimate::ModeComparison> RotatingCase::compare(
    double speed, const linalg::DampedTarget& target) const {
  return compareAt(speed, target);
}

double RotatingCase::rounding(const estimate::Linearised& m, const Eigen::VectorXcd& y) const {
  if (rounding_) return rounding_(y);
  const Vector size = y.cwiseAbs();
  return linalg::roundingOf(m.stiffness) * size.dot(Sparse(m.stiffness.cwiseAbs()) * size);
}

void RotatingCase::announceHeldStates() const { stability::warnOfHeldStates(model(), time_); }

void RotatingCase::announceUnknownStates() const {
  const auto unknown = model::setsWithUnknownStates(model(), time_);
  if (!unknown.empty())
    log::warn(
        "The laws of " + quotedList(unknown) +
        " do not say how their states respond to a harmonic motion. These states stay as they "
        "are at rest in the responses.");
}

void RotatingCase::announceLaws() const {
  const auto followed = model::matrixLaws(model(), true), held = model::matrixLaws(model(), false);
  if (followed.empty())
    log::warn(
        "No matrix of this scene depends on the rotary speed, so its modes are the same at all "
        "speeds. A string needs the list Rotary Speed, parts need terms with the law \"Omega\".");
  else
    log::info("speed       the matrices change with the laws " + quotedList(followed));
  if (!held.empty())
    log::info("            " + quotedList(held) +
              " have their values of t = " + formatNumber(time_) + " s");
}

}  // namespace tooljoint::response
