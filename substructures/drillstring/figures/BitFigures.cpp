// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/figures/BitFigures.hpp"

#include <cmath>
#include <string>

#include "common/Constants.hpp"

namespace tooljoint::drillstring {

namespace {

/// Range of speed over speed that counts as rounding: equations at rest leave motions of 1e-12.
constexpr double roundingOfSpeeds = 1e-10;

double range(const cases::SignalFigures& signal) { return signal.max() - signal.min(); }

}  // namespace

void BitFigures::add(const BitSample& sample, bool late) {
  speed_.add(sample.speed);
  (late ? late_ : early_).add(sample.speed - sample.imposed);
  if (sample.imposed != 0.0) turned_ += 1.0;
  if (std::abs(sample.speed) < stuckSpeed_) stuck_ += 1.0;
  if (sample.weight) weight_.add(*sample.weight);
  if (sample.torque) torque_.add(*sample.torque);
  if (!sample.advance) return;
  advance_.add(*sample.advance);
  if (sample.speed < 0.0) backward_ += *sample.advance;
  power_ +=
      sample.weight.value_or(0.0) * *sample.advance + sample.torque.value_or(0.0) * sample.speed;
}

std::optional<double> BitFigures::stickSlipIndex() const {
  if (turned_ == 0.0) return std::nullopt;
  return speed_.fluctuationIndex();
}

std::optional<double> BitFigures::stuckShare() const {
  if (turned_ == 0.0) return std::nullopt;
  return stuck_ / static_cast<double>(speed_.samples());
}

std::optional<double> BitFigures::growth() const {
  if (turned_ == 0.0 || !(range(early_) > 0.0)) return std::nullopt;
  if (!(range(late_) > roundingOfSpeeds * speed_.rms())) return std::nullopt;
  return range(late_) / range(early_);
}

std::optional<double> BitFigures::rateOfPenetration() const {
  if (advance_.samples() == 0) return std::nullopt;
  return advance_.mean();
}

std::optional<double> BitFigures::backwardAdvance() const {
  const double advance = advance_.mean() * static_cast<double>(advance_.samples());
  if (!(advance > 0.0)) return std::nullopt;
  return backward_ / advance;
}

std::optional<double> BitFigures::specificEnergy() const {
  const double advance = advance_.mean() * static_cast<double>(advance_.samples());
  if (!(advance > 0.0) || !(area_ > 0.0)) return std::nullopt;
  return power_ / (area_ * advance);
}

void BitFigures::summarise(io::Summary& summary) const {
  const std::string key = "transient.figures.";
  constexpr double rpm = constants::rpmPerRadianPerSecond;
  speed_.summarise(key + "bit_speed_rpm", rpm, summary);
  if (const auto index = stickSlipIndex()) summary.set(key + "stick_slip_index", *index);
  if (const auto share = stuckShare()) summary.set(key + "stuck_share", *share);
  summary.set(key + "stuck_speed_rpm", stuckSpeed_ * rpm);
  if (const auto ratio = growth()) summary.set(key + "bit_speed_growth", *ratio);
  if (weight_.samples() > 0) weight_.summarise(key + "weight_on_bit", 1.0, summary);
  if (torque_.samples() > 0) torque_.summarise(key + "torque_on_bit", 1.0, summary);
  if (const auto rate = rateOfPenetration()) summary.set(key + "rate_of_penetration", *rate);
  if (const auto energy = specificEnergy()) summary.set(key + "specific_energy", *energy);
}

void BitFigures::save(std::vector<double>& memory) const {
  for (const auto* signal : {&speed_, &weight_, &torque_, &advance_, &early_, &late_})
    signal->save(memory);
  memory.insert(memory.end(), {stuck_, turned_, backward_, power_});
}

void BitFigures::restore(const double*& memory) {
  for (auto* signal : {&speed_, &weight_, &torque_, &advance_, &early_, &late_})
    signal->restore(memory);
  stuck_ = *memory++;
  turned_ = *memory++;
  backward_ = *memory++;
  power_ = *memory++;
}

}  // namespace tooljoint::drillstring
