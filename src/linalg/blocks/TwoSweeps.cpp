// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "common/Index.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "linalg/blocks/BlockKernels.hpp"

namespace tooljoint::linalg {

bool BlockFactor::hasTwoSweeps() const {
  if (cut_ || pivots_.size() < 3) return false;
  const int meeting = pivots_.back().block;
  if (meeting == 0 || meeting + 1 == static_cast<int>(pivots_.size())) return false;
  for (std::size_t k = 0; k + 1 < pivots_.size(); ++k) {
    const Pivot& p = pivots_[k];
    if (!p.inverted() || p.couplingEnd != p.couplingBegin + 1) return false;
    if (couplings_[at(p.couplingBegin)].block != p.block + (p.block < meeting ? 1 : -1))
      return false;
  }
  return pivots_.back().inverted();
}

TOOLJOINT_CLONES int BlockFactor::factorPivots(const std::vector<int>& pivots) {
  double* values = values_.data();
  for (const int k : pivots) {  // size of each row before elimination
    const Pivot& p = pivots_[at(k)];
    const double* D = values + eliminations_[at(k)].diagonal;
    for (int i = 0; i < p.width; ++i) {
      double size = 0;
      for (int j = 0; j < p.width; ++j) size = std::max(size, std::abs(D[j * p.width + i]));
      if (!(size > 0)) return p.start + i;
      scale_[at(p.start + i)] = size;
    }
  }
  for (const int k : pivots) {
    const Pivot& p = pivots_[at(k)];
    double* D = values + eliminations_[at(k)].diagonal;
    const int bad = kernel::factorBlock(p.width, D, &scale_[at(p.start)], workScale_.data(),
                                        &swaps_[at(p.start)], panel_.data());
    if (bad >= 0) return p.start + bad;
    eliminate(at(k));
  }
  return -1;
}

/// A_mm -= A_mk W_km
TOOLJOINT_CLONES void BlockFactor::addToMeeting(std::size_t k) {
  const Pivot& p = pivots_[k];
  const Update& update = updates_[at(eliminations_[k].updateBegin)];
  const Coupling& m = couplings_[at(update.i)];
  kernel::multiplySubtract(m.width, p.width, m.width, values_.data() + places_[at(update.i)].lower,
                           up_.data() + m.up, values_.data() + update.target);
}

TOOLJOINT_CLONES int BlockFactor::factorMeeting() {
  const Pivot& p = pivots_.back();
  double* D = values_.data() + eliminations_.back().diagonal;
  const int bad = kernel::factorBlock(p.width, D, &scale_[at(p.start)], workScale_.data(),
                                      &swaps_[at(p.start)], panel_.data());
  if (bad >= 0) return p.start + bad;
  eliminate(pivots_.size() - 1);
  return -1;
}

BlockFactor::TwoSweeps::TwoSweeps(BlockFactor& factor) : factor_(factor) {
  const int meeting = factor.pivots_.back().block;
  for (std::size_t k = 0; k + 1 < factor.pivots_.size(); ++k)
    pivots_[factor.pivots_[k].block < meeting ? 0 : 1].push_back(static_cast<int>(k));
  lasts_ = {pivots_[0].back(), pivots_[1].back()};
  std::sort(lasts_.begin(), lasts_.end());
}

std::size_t BlockFactor::TwoSweeps::factorsLength(int sweep) const {
  return 3 * at(last(sweep).width) * at(factor_.pivots_.back().width);
}

/// A_mk, W_km and L_mk.
void BlockFactor::TwoSweeps::copyFactors(int sweep, double* to) const {
  const auto c = at(last(sweep).couplingBegin);
  const auto size = factorsLength(sweep) / 3;
  std::copy_n(factor_.values_.data() + factor_.places_[c].lower, size, to);
  std::copy_n(factor_.up_.data() + factor_.couplings_[c].up, size, to + size);
  std::copy_n(factor_.down_.data() + factor_.couplings_[c].down, size, to + 2 * size);
}

void BlockFactor::TwoSweeps::takeFactors(int sweep, const double* from) {
  const auto c = at(last(sweep).couplingBegin);
  const auto size = factorsLength(sweep) / 3;
  std::copy_n(from, size, factor_.values_.data() + factor_.places_[c].lower);
  std::copy_n(from + size, size, factor_.up_.data() + factor_.couplings_[c].up);
  std::copy_n(from + 2 * size, size, factor_.down_.data() + factor_.couplings_[c].down);
}

void BlockFactor::TwoSweeps::keepMeeting() {
  const auto width = at(factor_.pivots_.back().width);
  const double* D = factor_.values_.data() + factor_.eliminations_.back().diagonal;
  diagonal_.assign(D, D + width * width);
}

/// The sizes of the rows are those before elimination.
bool BlockFactor::TwoSweeps::factorMeeting() {
  const Pivot& m = factor_.pivots_.back();
  double* D = factor_.values_.data() + factor_.eliminations_.back().diagonal;
  std::copy(diagonal_.begin(), diagonal_.end(), D);
  for (const int k : lasts_) factor_.addToMeeting(at(k));
  for (int i = 0; i < m.width; ++i) {
    double size = 0;
    for (int j = 0; j < m.width; ++j)
      size = std::max(size, std::abs(diagonal_[at(j * m.width + i)]));
    if (!(size > 0)) return false;
    factor_.scale_[at(m.start + i)] = size;
  }
  return factor_.factorMeeting() < 0;
}

void BlockFactor::TwoSweeps::down(int sweep, double* x) const {
  factor_.downPivots(pivots_[at(sweep)], x);
}

}  // namespace tooljoint::linalg
