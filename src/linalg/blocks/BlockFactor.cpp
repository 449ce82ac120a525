// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/BlockFactor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/blocks/BlockKernels.hpp"

namespace tooljoint::linalg {
namespace {

constexpr std::size_t word = 64;  // bits

void set(std::vector<std::uint64_t>& bits, std::size_t i) {
  bits[i / word] |= std::uint64_t{1} << (i % word);
}
void clear(std::vector<std::uint64_t>& bits, std::size_t i) {
  bits[i / word] &= ~(std::uint64_t{1} << (i % word));
}

/// act(i) for each set bit i, upwards or downwards, including bits that act() sets further ahead.
template <class Act>
TOOLJOINT_INLINED void upwards(const std::vector<std::uint64_t>& bits, const Act& act) {
  for (std::size_t w = 0; w < bits.size(); ++w)
    for (std::uint64_t left = ~std::uint64_t{0}; (bits[w] & left) != 0;) {
      const auto bit = static_cast<std::size_t>(__builtin_ctzll(bits[w] & left));
      left = bit == word - 1 ? 0 : ~std::uint64_t{0} << (bit + 1);
      act(w * word + bit);
    }
}
template <class Act>
TOOLJOINT_INLINED void downwards(const std::vector<std::uint64_t>& bits, const Act& act) {
  for (std::size_t w = bits.size(); w-- > 0;)
    for (std::uint64_t left = ~std::uint64_t{0}; (bits[w] & left) != 0;) {
      const auto bit = word - 1 - static_cast<std::size_t>(__builtin_clzll(bits[w] & left));
      left = (std::uint64_t{1} << bit) - 1;
      act(w * word + bit);
    }
}

}  // namespace

/// Blocks are eliminated by least work, width * (width of the later neighbours)^2. Of equal ones
/// the one that has waited longest comes first. So a chain is eliminated from both ends in turn,
/// which gives the processor two independent sweeps.
void BlockFactor::order(const BlockPattern& pattern, std::vector<int>& sequence,
                        std::vector<std::vector<int>>& later) const {
  const int n = pattern.blocks(), interior = pattern.interiorBlocks();
  std::vector<std::set<int>> graph(at(n));
  for (int b = 0; b < n; ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e)
      if (pattern.column(e) != b) graph[at(b)].insert(pattern.column(e));
  const auto work = [&](int b) {
    double neighbours = 0;
    for (int c : graph[at(b)]) neighbours += pattern.width(c);
    return static_cast<long>(graph[at(b)].size() < 2 ? 0
                                                     : pattern.width(b) * neighbours * neighbours);
  };
  std::set<std::tuple<long, int, int>> queue;  // work, waiting since, block
  std::vector<std::tuple<long, int, int>> key(at(n));
  for (int b = 0; b < interior; ++b) queue.insert(key[at(b)] = {work(b), b, b});
  later.assign(at(n), {});
  for (int clock = n; !queue.empty(); ++clock) {
    const int b = std::get<2>(*queue.begin());
    queue.erase(queue.begin());
    sequence.push_back(b);
    later[at(b)].assign(graph[at(b)].begin(), graph[at(b)].end());
    for (int i : later[at(b)]) {
      graph[at(i)].erase(b);
      for (int j : later[at(b)])
        if (i != j) graph[at(i)].insert(j);
    }
    for (int i : later[at(b)]) {
      if (i >= interior) continue;
      queue.erase(key[at(i)]);
      queue.insert(key[at(i)] = {work(i), clock, i});
    }
  }
  for (int b = interior; b < n; ++b) sequence.push_back(b);
}

BlockFactor::BlockFactor(const BlockPattern& pattern) {
  std::vector<int> sequence;
  std::vector<std::vector<int>> later;
  order(pattern, sequence, later);

  std::map<std::pair<int, int>, std::size_t> fill;
  std::size_t storage = patternStorage_ = pattern.storage();
  const auto place = [&](int i, int j) {
    const int entry = pattern.find(i, j);
    if (entry >= 0) return pattern.offset(entry);
    const auto [it, fresh] = fill.emplace(std::make_pair(i, j), storage);
    if (fresh) storage += (at(pattern.width(i)) * at(pattern.width(j)) + 3) / 4 * 4;
    return it->second;
  };

  int widest = 0;
  std::size_t panel = 0;
  for (int k : sequence) {
    Pivot pivot{k, pattern.start(k), pattern.width(k), static_cast<int>(couplings_.size()), 0, 0};
    Elimination elimination{place(k, k), static_cast<int>(updates_.size()), 0};
    widest = std::max(widest, pivot.width);
    for (int i : later[at(k)]) {
      couplings_.push_back({i, pattern.start(i), pattern.width(i), 0, 0});
      places_.push_back({place(i, k), place(k, i)});
      panel = std::max(panel, at(pattern.width(i)) * at(pivot.width));
      solveWork_ += 2.0 * pivot.width * pattern.width(i);
    }
    solveWork_ += static_cast<double>(pivot.width) * pivot.width;
    pivot.couplingEnd = static_cast<int>(couplings_.size());
    for (int a = pivot.couplingBegin; a < pivot.couplingEnd; ++a)
      for (int b = pivot.couplingBegin; b < pivot.couplingEnd; ++b)
        updates_.push_back({place(later[at(k)][at(a - pivot.couplingBegin)],
                                  later[at(k)][at(b - pivot.couplingBegin)]),
                            a, b});
    elimination.updateEnd = static_cast<int>(updates_.size());
    pivots_.push_back(pivot);
    eliminations_.push_back(elimination);
  }
  eliminated_ = at(pattern.interiorBlocks());
  size_ = pattern.size();
  if (pattern.cut().isDivided()) {
    cut_ = std::make_unique<CutFactor>(pattern.sharedCut());
    listCut(pattern, fill);
  }
  pack();
  findEarlier();
  far_ = storage > kernel::nearCache;
  values_.assign(storage, 0.0);
  scale_.assign(at(pattern.size()), 0.0);
  swaps_.assign(at(pattern.size()), 0);
  workScale_.assign(at(widest), 0.0);
  work_.assign(at(widest), 0.0);
  const std::size_t inverted = at(std::min(widest, kernel::largestInverse));
  panel_.assign(std::max(panel, inverted * inverted), 0.0);
}

/// Lists the blocks between blocks of the cut: those of the pattern and the fill.
void BlockFactor::listCut(const BlockPattern& pattern,
                          const std::map<std::pair<int, int>, std::size_t>& fill) {
  const auto add = [&](int i, int j, std::size_t offset) {
    if (i >= static_cast<int>(eliminated_) && j >= static_cast<int>(eliminated_))
      cutBlocks_.push_back(
          {offset, pattern.start(i), pattern.start(j), pattern.width(i), pattern.width(j)});
  };
  for (int i = static_cast<int>(eliminated_); i < pattern.blocks(); ++i)
    for (int e = pattern.rowBegin(i); e < pattern.rowBegin(i + 1); ++e)
      add(i, pattern.column(e), pattern.offset(e));
  for (const auto& [blocks, offset] : fill) add(blocks.first, blocks.second, offset);
}

/// Storage order: the forward sweep reads L pivot by pivot, the backward sweep D^-1 and W from the
/// last pivot to the first.
void BlockFactor::pack() {
  std::size_t down = 0, up = 0;
  const auto take = [](std::size_t& next, int rows, int columns) {
    if (next > std::numeric_limits<Offset>::max())
      throw ModelError(
          "The factors of the matrix would take more than 32 GB. Use a coarser mesh, fewer modes "
          "or fewer retained nodes.");
    const auto here = static_cast<Offset>(next);
    next += (at(rows) * at(columns) + 3) / 4 * 4;
    return here;
  };
  for (const Pivot& p : pivots_)
    for (int c = p.couplingBegin; c < p.couplingEnd; ++c)
      couplings_[at(c)].down = take(down, couplings_[at(c)].width, p.width);
  for (auto p = pivots_.rbegin(); p != pivots_.rend(); ++p) {
    p->up = take(up, p->width, p->width);
    for (int c = p->couplingBegin; c < p->couplingEnd; ++c)
      couplings_[at(c)].up = take(up, p->width, couplings_[at(c)].width);
  }
  down_.assign(down, 0.0);
  up_.assign(up, 0.0);
}

void BlockFactor::findEarlier() {
  pivotOf_.resize(pivots_.size());
  for (std::size_t k = 0; k < pivots_.size(); ++k)
    pivotOf_[at(pivots_[k].block)] = static_cast<int>(k);
  std::vector<std::vector<int>> earlier(pivots_.size());
  for (std::size_t k = 0; k < pivots_.size(); ++k)
    for (int c = pivots_[k].couplingBegin; c < pivots_[k].couplingEnd; ++c)
      earlier[at(pivotOf_[at(couplings_[at(c)].block)])].push_back(static_cast<int>(k));
  near_.begin.push_back(0);
  for (const auto& each : earlier) {
    near_.earlier.insert(near_.earlier.end(), each.begin(), each.end());
    near_.begin.push_back(static_cast<int>(near_.earlier.size()));
  }
  near_.reached.assign(pivots_.size() / word + 1, 0);
}

bool BlockFactor::Pivot::inverted() const { return width <= kernel::largestInverse; }

static_assert(BlockFactor::vanished == kernel::smallestPivot);

int BlockFactor::factor(double smallest) {
  const int bad = factorInterior(smallest);
  return cut_ ? factorCut(bad) : bad;
}

TOOLJOINT_CLONES int BlockFactor::factorInterior(double smallest) {
  double* values = values_.data();
  std::fill(values + patternStorage_, values + values_.size(), 0.0);
  for (std::size_t k = 0; k < pivots_.size(); ++k) {  // size of each row before elimination
    const Pivot& p = pivots_[k];
    const double* D = values + eliminations_[k].diagonal;
    for (int i = 0; i < p.width; ++i) {
      double size = 0;
      for (int j = 0; j < p.width; ++j) size = std::max(size, std::abs(D[j * p.width + i]));
      // an empty row, or NaN; at the cut another rank may have entries
      if (!(size > 0) && k < eliminated_) return p.start + i;
      scale_[at(p.start + i)] = size * (smallest / kernel::smallestPivot);
    }
  }
  for (std::size_t k = 0; k < eliminated_; ++k) {
    const Pivot& p = pivots_[k];
    double* D = values + eliminations_[k].diagonal;
    const int bad = kernel::factorBlock(p.width, D, &scale_[at(p.start)], workScale_.data(),
                                        &swaps_[at(p.start)], panel_.data());
    if (bad >= 0) return p.start + bad;
    eliminate(k);
  }
  return -1;
}

int BlockFactor::factorCut(int bad) {
  cut_->clear();
  for (std::size_t k = eliminated_; k < pivots_.size(); ++k)
    for (int i = pivots_[k].start; i < pivots_[k].start + pivots_[k].width; ++i)
      cut_->sizeOf(i) = scale_[at(i)];
  for (const CutBlock& block : cutBlocks_)
    for (int j = 0; j < block.columns; ++j)
      for (int i = 0; i < block.rows; ++i)
        cut_->at(block.row + i, block.column + j) = values_[block.offset + at(j * block.rows + i)];
  if (cut_->factor(bad >= 0)) return -1;
  return bad >= 0 ? bad : size_;
}

/// W_kj = D_k^-1 A_kj;  A_ij -= A_ik W_kj;  L_ik = A_ik D_k^-1
TOOLJOINT_CLONES void BlockFactor::eliminate(std::size_t k) {
  const Pivot& p = pivots_[k];
  double* values = values_.data();
  const double* D = values + eliminations_[k].diagonal;
  std::copy(D, D + p.width * p.width, up_.data() + p.up);
  for (int c = p.couplingBegin; c < p.couplingEnd; ++c) {
    const Coupling& far = couplings_[at(c)];
    const double* upper = values + places_[at(c)].upper;
    double* W = up_.data() + far.up;
    if (p.inverted()) {
      kernel::multiplySmall(p.width, p.width, far.width, D, upper, W);
    } else {
      std::copy(upper, upper + p.width * far.width, W);
      kernel::solveLarge(p.width, far.width, D, &swaps_[at(p.start)], W);
    }
  }
  for (int u = eliminations_[k].updateBegin; u < eliminations_[k].updateEnd; ++u) {
    const Update& update = updates_[at(u)];
    const Coupling& i = couplings_[at(update.i)];
    const Coupling& j = couplings_[at(update.j)];
    kernel::multiplySubtract(i.width, p.width, j.width, values + places_[at(update.i)].lower,
                             up_.data() + j.up, values + update.target);
  }
  for (int c = p.couplingBegin; c < p.couplingEnd; ++c) {
    const Coupling& far = couplings_[at(c)];
    const double* lower = values + places_[at(c)].lower;
    double* L = down_.data() + far.down;
    if (p.inverted())
      kernel::multiplySmall(far.width, p.width, p.width, lower, D, L);
    else
      std::copy(lower, lower + far.width * p.width, L);
  }
}

namespace {

/// even + odd += sign A x, A 6 x 6: kernel::addPairs() without its loop.
template <int sign>
TOOLJOINT_INLINED void addNode(const double* A, const double* x, kernel::Six& even,
                               kernel::Six& odd) {
  even.addColumn(A, sign * x[0]), odd.addColumn(A + 6, sign * x[1]);
  even.addColumn(A + 12, sign * x[2]), odd.addColumn(A + 18, sign * x[3]);
  even.addColumn(A + 24, sign * x[4]), odd.addColumn(A + 30, sign * x[5]);
}

}  // namespace

/// b_i -= L_ik b_k
TOOLJOINT_INLINED void BlockFactor::sweepDown(const Pivot& p, double* x) const {
  double* target = x + p.start;
  if (!p.inverted())
    kernel::solveLarge(p.width, 1, up_.data() + p.up, &swaps_[at(p.start)], target);
  const Coupling* couplings = couplings_.data();
  for (int c = p.couplingBegin; c < p.couplingEnd; ++c) {
    const double* L = down_.data() + couplings[c].down;
    if (far_) kernel::fetchAhead(L, couplings[c].width * p.width);
    if (couplings[c].width == 6 && p.width == 6) {
      kernel::Six even(x + couplings[c].start), odd;
      addNode<-1>(L, target, even, odd);
      even.a += odd.a, even.b += odd.b;
      even.to(x + couplings[c].start);
    } else {
      kernel::multiplySubtract(couplings[c].width, p.width, L, target, x + couplings[c].start);
    }
  }
}

/// x_k = D_k^-1 b_k - sum_j W_kj x_j
TOOLJOINT_INLINED void BlockFactor::sweepUp(const Pivot& p, double* x) const {
  const Coupling* couplings = couplings_.data();
  double* target = x + p.start;
  if (p.width == 6) {
    kernel::Six even, odd;
    if (far_) kernel::fetchAhead(up_.data() + p.up, 36);
    addNode<1>(up_.data() + p.up, target, even, odd);
    for (int c = p.couplingBegin; c < p.couplingEnd; ++c) {
      if (far_) kernel::fetchAhead(up_.data() + couplings[c].up, 6 * couplings[c].width);
      const double *W = up_.data() + couplings[c].up, *source = x + couplings[c].start;
      if (couplings[c].width == 6)
        addNode<-1>(W, source, even, odd);
      else
        kernel::addPairs<-1>(couplings[c].width, W, source, even, odd);
    }
    even.a += odd.a, even.b += odd.b;
    even.to(target);
    return;
  }
  if (p.inverted()) {
    double* copy = work_.data();
    for (int i = 0; i < p.width; ++i) copy[i] = target[i], target[i] = 0;
    kernel::multiplyAdd(p.width, p.width, up_.data() + p.up, copy, target);
  }
  for (int c = p.couplingBegin; c < p.couplingEnd; ++c)
    kernel::multiplySubtract(p.width, couplings[c].width, up_.data() + couplings[c].up,
                             x + couplings[c].start, target);
}

TOOLJOINT_CLONES void BlockFactor::solve(double* x) const {
  for (std::size_t k = 0; k < eliminated_; ++k) sweepDown(pivots_[k], x);
  if (cut_) cut_->solve(x);
  for (std::size_t k = eliminated_; k-- > 0;) sweepUp(pivots_[k], x);
}

TOOLJOINT_CLONES void BlockFactor::solveNear(double* x, std::vector<int>& live,
                                             const double* weight, double small) const {
  const auto isSmall = [&](const Pivot& p, bool weighted) __attribute__((always_inline)) {
    double size = 0;
    for (int i = p.start; i < p.start + p.width; ++i)
      size = std::max(size, std::abs(x[i]) * (weighted ? weight[i] : 1.0));
    return size <= small;
  };
  const auto drop = [&](std::size_t k) {
    std::fill(x + pivots_[k].start, x + pivots_[k].start + pivots_[k].width, 0.0);
    clear(near_.reached, k);
  };
  for (int block : live) set(near_.reached, at(pivotOf_[at(block)]));
  upwards(
      near_.reached, [&](std::size_t k) __attribute__((always_inline)) {
        const Pivot& p = pivots_[k];
        if (k >= eliminated_) return;
        if (isSmall(p, true)) return drop(k);
        sweepDown(p, x);
        for (int c = p.couplingBegin; c < p.couplingEnd; ++c)
          set(near_.reached, at(pivotOf_[at(couplings_[at(c)].block)]));
      });
  if (cut_) {
    cut_->solve(x);
    for (std::size_t k = eliminated_; k < pivots_.size(); ++k) set(near_.reached, k);
  }
  live.clear();
  downwards(
      near_.reached, [&](std::size_t k) __attribute__((always_inline)) {
        if (k < eliminated_) sweepUp(pivots_[k], x);
        if (isSmall(pivots_[k], false)) return drop(k);
        live.push_back(pivots_[k].block);
        for (int e = near_.begin[k]; e < near_.begin[k + 1]; ++e)
          set(near_.reached, at(near_.earlier[at(e)]));
      });
  std::fill(near_.reached.begin(), near_.reached.end(), 0);
}

void BlockFactor::reserveInverse() {
  if (!inverse_.empty()) return;
  inverse_.assign(values_.size(), 0.0);
  std::size_t widest = 0;
  for (const Pivot& p : pivots_) widest = std::max(widest, at(p.width) * at(p.width));
  panel_.resize(std::max(panel_.size(), widest));
  inverted_.reserve(pivots_.size());
}

void BlockFactor::invert(const std::vector<char>& wanted) {
  reserveInverse();
  // A pivot is needed if it is wanted or couples to an earlier needed one.
  std::vector<char>& needed = inverted_;
  needed.assign(wanted.begin(), wanted.end());
  for (const Pivot& p : pivots_)
    if (needed[at(p.block)])
      for (int c = p.couplingBegin; c < p.couplingEnd; ++c) needed[at(couplings_[at(c)].block)] = 1;
  if (cut_) {
    cut_->invert();
    for (const CutBlock& block : cutBlocks_)
      for (int j = 0; j < block.columns; ++j)
        for (int i = 0; i < block.rows; ++i)
          inverse_[block.offset + at(j * block.rows + i)] =
              cut_->inverse(block.row + i, block.column + j);
  }
  for (std::size_t k = eliminated_; k-- > 0;)
    if (needed[at(pivots_[k].block)]) invertPivot(k);
}

TOOLJOINT_CLONES void BlockFactor::invertPivot(std::size_t k) {
  const Pivot& p = pivots_[k];
  double* Z = inverse_.data();
  const int w = p.width;
  // D_k^-1
  double* diagonal = Z + eliminations_[k].diagonal;
  if (w <= kernel::largestInverse) {
    std::copy(up_.data() + p.up, up_.data() + p.up + w * w, diagonal);
  } else {
    std::fill(diagonal, diagonal + w * w, 0.0);
    for (int i = 0; i < w; ++i) diagonal[i * (w + 1)] = 1.0;
    kernel::solveLarge(w, w, up_.data() + p.up, &swaps_[at(p.start)], diagonal);
  }
  const int count = p.couplingEnd - p.couplingBegin;
  const Update* updates = updates_.data() + eliminations_[k].updateBegin;  // count x count, by rows
  for (int a = 0; a < count; ++a) {
    const std::size_t c = at(p.couplingBegin + a);
    const int size = couplings_[c].width * w;
    std::fill(Z + places_[c].lower, Z + places_[c].lower + size, 0.0);
    std::fill(Z + places_[c].upper, Z + places_[c].upper + size, 0.0);
  }
  // Z_ak = -sum_b Z_ab (A_bk D_k^-1),  Z_kb = -sum_a W_ka Z_ab
  for (int b = 0; b < count; ++b) {
    const Coupling& from = couplings_[at(p.couplingBegin + b)];
    const double* L = down_.data() + from.down;
    if (!p.inverted()) {  // diagonal is still D_k^-1
      std::fill(panel_.begin(), panel_.begin() + from.width * w, 0.0);
      kernel::multiplyAddTo(from.width, w, w, L, diagonal, panel_.data());
      L = panel_.data();
    }
    for (int a = 0; a < count; ++a) {
      const Coupling& to = couplings_[at(p.couplingBegin + a)];
      const double* Zab = Z + updates[a * count + b].target;
      kernel::multiplySubtract(to.width, from.width, w, Zab, L,
                               Z + places_[at(p.couplingBegin + a)].lower);
      kernel::multiplySubtract(w, to.width, from.width, up_.data() + to.up, Zab,
                               Z + places_[at(p.couplingBegin + b)].upper);
    }
  }
  // Z_kk = D_k^-1 - sum_b W_kb Z_bk
  for (int b = 0; b < count; ++b) {
    const Coupling& far = couplings_[at(p.couplingBegin + b)];
    kernel::multiplySubtract(w, far.width, w, up_.data() + far.up,
                             Z + places_[at(p.couplingBegin + b)].lower, diagonal);
  }
}

/// Forward sweep, without the contribution of the last pivot to the meeting block.
TOOLJOINT_CLONES void BlockFactor::downPivots(const std::vector<int>& pivots, double* x) const {
  for (std::size_t k = 0; k + 1 < pivots.size(); ++k) sweepDown(pivots_[at(pivots[k])], x);
}

TOOLJOINT_CLONES void BlockFactor::meet(const std::vector<int>& lastOfSweeps, double* x) const {
  for (const int k : lastOfSweeps) sweepDown(pivots_[at(k)], x);
  sweepUp(pivots_.back(), x);
}

TOOLJOINT_CLONES void BlockFactor::upPivots(const std::vector<int>& pivots, double* x) const {
  for (std::size_t k = pivots.size(); k-- > 0;) sweepUp(pivots_[at(pivots[k])], x);
}

}  // namespace tooljoint::linalg
