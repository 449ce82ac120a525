// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/SignalFigures.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::cases {

void SignalFigures::add(double value) {
  min_ = samples_ == 0 ? value : std::min(min_, value);
  max_ = samples_ == 0 ? value : std::max(max_, value);
  sum_ += value;
  squares_ += value * value;
  ++samples_;
}

double SignalFigures::mean() const {
  return samples_ == 0 ? 0.0 : sum_ / static_cast<double>(samples_);
}

double SignalFigures::rms() const {
  return samples_ == 0 ? 0.0 : std::sqrt(squares_ / static_cast<double>(samples_));
}

double SignalFigures::fluctuationIndex() const {
  return mean() == 0.0 ? 0.0 : (max_ - min_) / (2.0 * std::abs(mean()));
}

void SignalFigures::summarise(const std::string& key, double scale, io::Summary& summary) const {
  summary.set(key + ".mean", scale * mean());
  summary.set(key + ".rms", scale * rms());
  summary.set(key + ".min", scale * min());
  summary.set(key + ".max", scale * max());
}

void SignalFigures::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {static_cast<double>(samples_), sum_, squares_, min_, max_});
}

void SignalFigures::restore(const double*& memory) {
  samples_ = static_cast<long>(*memory++);
  for (double* value : {&sum_, &squares_, &min_, &max_}) *value = *memory++;
}

WorstPlace worst(const Vector& values) {
  WorstPlace place;
  place.value = values.maxCoeff(&place.row);
  return place;
}

void MagnitudeFigures::add(const Vector& magnitudes) {
  squares_ += magnitudes.cwiseAbs2();
  peak_ = peak_.cwiseMax(magnitudes);
  ++samples_;
}

Vector MagnitudeFigures::rms() const {
  if (samples_ == 0) return squares_;
  return (squares_ / static_cast<double>(samples_)).cwiseSqrt();
}

double MagnitudeFigures::overallRms() const {
  return samples_ == 0 || squares_.size() == 0
             ? 0.0
             : std::sqrt(squares_.mean() / static_cast<double>(samples_));
}

void MagnitudeFigures::save(std::vector<double>& memory) const {
  memory.push_back(static_cast<double>(samples_));
  saveVector(squares_, memory);
  saveVector(peak_, memory);
}

void MagnitudeFigures::restore(const double*& memory) {
  samples_ = static_cast<long>(*memory++);
  restoreVector(squares_, memory);
  restoreVector(peak_, memory);
}

void saveVector(const Vector& values, std::vector<double>& memory) {
  memory.insert(memory.end(), values.data(), values.data() + values.size());
}

void restoreVector(Vector& values, const double*& memory) {
  std::copy_n(memory, values.size(), values.data());
  memory += values.size();
}

}  // namespace tooljoint::cases
