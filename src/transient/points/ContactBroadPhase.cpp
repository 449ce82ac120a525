// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/ContactBroadPhase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
namespace {

/// For points with fewer entries than this, the clearance costs no more than the bound.
constexpr int cheapPoint = 12;

}  // namespace

ContactBroadPhase::ContactBroadPhase(const std::vector<int>& points, int width, int reach,
                                     const std::vector<int>& rowBegin,
                                     const std::vector<int>& column,
                                     const std::vector<double>& value,
                                     const linalg::BlockPattern& pattern)
    : reach_(reach), all_(points), isActive_((rowBegin.size() - 1) / at(width), 1) {
  std::map<std::vector<int>, std::vector<int>> byBlocks;  // points that depend on the same blocks
  for (int p : all_) {
    std::vector<int> blocks;
    for (int i = rowBegin[at(p * width)]; i < rowBegin[at((p + 1) * width)]; ++i)
      blocks.push_back(pattern.blockOf(column[at(i)]));
    if (static_cast<int>(blocks.size()) < cheapPoint) continue;
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    byBlocks[blocks].push_back(p);
  }
  for (auto& [blocks, members] : byBlocks) {
    if (members.size() < 2) continue;
    Group group;
    std::map<int, std::vector<double>> largest;
    for (int p : members)
      for (int c = 0; c < reach; ++c)
        for (int i = rowBegin[at(p * width + c)]; i < rowBegin[at(p * width + c + 1)]; ++i) {
          auto& r =
              largest.emplace(column[at(i)], std::vector<double>(at(reach), 0.0)).first->second;
          r[at(c)] = std::max(r[at(c)], std::abs(value[at(i)]));
        }
    for (const auto& [position, r] : largest) {
      group.columns.push_back(position);
      group.bound.insert(group.bound.end(), r.begin(), r.end());
    }
    group.reference.assign(group.columns.size(), 0.0);
    group.points = std::move(members);
    groups_.push_back(std::move(group));
  }
  active_.reserve(all_.size());
  activated_.reserve(all_.size());
  collect();
}

void ContactBroadPhase::collect() {
  active_.clear();
  for (int p : all_)
    if (isActive_[at(p)]) active_.push_back(p);
}

/// B(q) = sqrt(sum_c (sum_j r_cj |q_j - q_0j|)^2)
double ContactBroadPhase::bound(const Group& group, const double* q) const {
  double square = 0;
  for (int c = 0; c < reach_; ++c) {
    double sum = 0;
    const double* r = group.bound.data() + c;
    for (std::size_t j = 0; j < group.columns.size(); ++j, r += reach_)
      sum += *r * std::abs(q[group.columns[j]] - group.reference[j]);
    square += sum * sum;
  }
  return std::sqrt(square);
}

void ContactBroadPhase::activate(const double* q) {
  activated_.clear();
  for (Group& group : groups_) {
    if (group.least >= 0) {
      group.steps += 1;
      group.reached = bound(group, q);
    }
    group.moved = !(group.reached < group.least);
    if (!group.moved) continue;
    for (int p : group.points)
      if (!isActive_[at(p)]) isActive_[at(p)] = 1, activated_.push_back(p);
  }
  if (activated_.empty()) return;
  std::sort(activated_.begin(), activated_.end());
  collect();
}

void ContactBroadPhase::deactivate(const double* q, const double* clearance) {
  bool any = false;
  for (Group& group : groups_) {
    if (!group.moved) continue;
    any = true;
    const double margin = group.steps > 0 ? Tuned::lookAhead * group.reached / group.steps : 0.0;
    group.least = std::numeric_limits<double>::infinity();
    group.steps = group.reached = 0;
    for (std::size_t j = 0; j < group.columns.size(); ++j) group.reference[j] = q[group.columns[j]];
    for (int p : group.points) {
      isActive_[at(p)] = clearance[p] > margin ? 0 : 1;
      if (!isActive_[at(p)]) group.least = std::min(group.least, clearance[p]);
    }
  }
  if (any) collect();
}

void ContactBroadPhase::save(std::vector<double>& memory) const {
  for (const Group& group : groups_) {
    memory.insert(memory.end(), group.reference.begin(), group.reference.end());
    memory.insert(memory.end(), {group.least, group.steps, group.reached});
  }
  for (char on : isActive_) memory.push_back(on);
}

void ContactBroadPhase::restore(const double*& memory) {
  for (Group& group : groups_) {
    for (double& x : group.reference) x = *memory++;
    group.least = *memory++;
    group.steps = *memory++;
    group.reached = *memory++;
  }
  for (char& on : isActive_) on = *memory++ != 0.0 ? 1 : 0;
  collect();
}

}  // namespace tooljoint::transient
