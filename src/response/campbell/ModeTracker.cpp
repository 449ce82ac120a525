// SPDX-License-Identifier: BSD-3-Clause
#include "response/campbell/ModeTracker.hpp"

#include <algorithm>
#include <utility>

#include "common/Index.hpp"
#include "estimate/ModeMatching.hpp"

namespace tooljoint::response {

namespace {

/// A MAC above the first needs no smaller step; a mode with a MAC below the second is lost.
constexpr double sure = 0.9, lost = 0.3;
constexpr int mostHalvings = 5;

Eigen::MatrixXcd columns(const Eigen::MatrixXcd& all, const std::vector<int>& which) {
  Eigen::MatrixXcd some(all.rows(), static_cast<Eigen::Index>(which.size()));
  for (std::size_t j = 0; j < which.size(); ++j)
    some.col(static_cast<Eigen::Index>(j)) = all.col(which[j]);
  return some;
}

}  // namespace

ModeTracker::ModeTracker(Modes modes, const Sparse& mass) : modes_(std::move(modes)), mass_(mass) {}

void ModeTracker::advance(double speed) {
  for (auto& mode : at_.now) mode.mac = 1.0;
  if (at_.started) {
    step(speed, 0);
    return;
  }
  at_.started = true;
  at_.speed = speed;
  start(modes_(speed, 0), {});
}

void ModeTracker::step(double speed, int halvings) {
  const auto candidates = modes_(speed, sizeOf(at_.now));
  const Partners found = match(candidates);
  if (found.least < sure && halvings < mostHalvings) {
    const double middle = 0.5 * (at_.speed + speed);
    step(middle, halvings + 1);
    step(speed, halvings + 1);
    return;
  }
  std::vector<TrackedMode> next;
  std::vector<int> taken;
  for (std::size_t i = 0; i < at_.now.size(); ++i) {
    const int j = found.candidate[i];
    if (j < 0 || found.mac[i] < lost) continue;
    taken.push_back(j);
    next.push_back({at_.now[i].track, candidates.values[j], candidates.shapes.col(j),
                    std::min(at_.now[i].mac, found.mac[i]), contains(candidates.edge, j)});
  }
  at_.now = std::move(next);
  at_.speed = speed;
  start(candidates, taken);
}

ModeTracker::Partners ModeTracker::match(const VibratingModes& candidates) const {
  Partners found;
  found.candidate.assign(at_.now.size(), -1);
  found.mac.assign(at_.now.size(), 0.0);
  Eigen::VectorXcd values(static_cast<Eigen::Index>(at_.now.size()));
  Eigen::MatrixXcd shapes(mass_.rows(), values.size());
  for (std::size_t i = 0; i < at_.now.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = at_.now[i].s;
    shapes.col(static_cast<Eigen::Index>(i)) = at_.now[i].shape;
  }
  const Matrix mac = estimate::modalAssurance(mass_, shapes, candidates.shapes);
  // single modes first; close values are assigned by their shapes
  std::vector<int> modesLeft, candidatesLeft = range(candidates.values.size());
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    Eigen::Index j = 0;
    const double best = mac.cols() > 0 ? mac.row(i).maxCoeff(&j) : 0.0;
    const auto place = std::find(candidatesLeft.begin(), candidatesLeft.end(), static_cast<int>(j));
    if (best >= sure && place != candidatesLeft.end()) {
      found.candidate[at(i)] = static_cast<int>(j);
      found.mac[at(i)] = std::min(1.0, best);
      candidatesLeft.erase(place);
    } else {
      modesLeft.push_back(i);
    }
  }
  Eigen::VectorXcd valuesLeft(static_cast<Eigen::Index>(modesLeft.size()));
  for (std::size_t k = 0; k < modesLeft.size(); ++k)
    valuesLeft[static_cast<Eigen::Index>(k)] = values[modesLeft[k]];
  const auto rest = estimate::matchModes(mass_, valuesLeft, columns(shapes, modesLeft),
                                         Eigen::VectorXcd(candidates.values(candidatesLeft)),
                                         columns(candidates.shapes, candidatesLeft));
  for (std::size_t k = 0; k < modesLeft.size(); ++k) {
    if (rest[k].partner < 0) continue;
    found.candidate[at(modesLeft[k])] = candidatesLeft[at(rest[k].partner)];
    found.mac[at(modesLeft[k])] = rest[k].mac;
  }
  for (std::size_t i = 0; i < at_.now.size(); ++i)
    if (!at_.now[i].edge) found.least = std::min(found.least, found.mac[i]);
  return found;
}

void ModeTracker::start(const VibratingModes& candidates, const std::vector<int>& taken) {
  for (const int j : candidates.wanted)
    if (!contains(taken, j))
      at_.now.push_back({++at_.tracks, candidates.values[j], candidates.shapes.col(j), 1.0, false});
  std::stable_sort(at_.now.begin(), at_.now.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.s) < std::abs(b.s); });
}

}  // namespace tooljoint::response
