// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/PointRows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "common/Index.hpp"
#include "linalg/blocks/BlockKernels.hpp"

namespace tooljoint::transient {
namespace {

namespace kernel = linalg::kernel;

/// Address of an entry outside the pattern.
constexpr std::size_t noEntry = std::numeric_limits<std::size_t>::max();

/// Sum of a_i x_i, in four partial sums.
TOOLJOINT_INLINED double dot(int n, const double* a, const double* x) {
  kernel::Quad sum{0, 0, 0, 0};
  int j = 0;
  for (; j + 4 <= n; j += 4)
    sum += *reinterpret_cast<const kernel::Quad*>(a + j) *
           *reinterpret_cast<const kernel::Quad*>(x + j);
  double rest = 0;
  for (; j < n; ++j) rest += a[j] * x[j];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]) + rest;
}

/// y += a f for n entries.
TOOLJOINT_INLINED void addTo(int n, const double* a, double f, double* y) {
  for (int j = 0; j < n; ++j) y[j] += a[j] * f;
}

}  // namespace

PointRowEntries PointRows::entries(const model::PointSet& set,
                                   const linalg::BlockPattern& pattern) {
  PointRowEntries found;
  const auto& position = pattern.partition().position;
  found.begin.push_back(0);
  for (int r = 0; r < set.law->size() * set.law->width(); ++r) {
    for (Sparse::InnerIterator it(set.rows, r); it; ++it) {
      if (it.value() == 0.0) continue;
      found.column.push_back(position[at(static_cast<int>(it.col()))]);
      found.value.push_back(it.value());
    }
    found.begin.push_back(static_cast<int>(found.column.size()));
  }
  return found;
}

PointRows::PointRows(const model::PointSet& set, const linalg::BlockPattern& pattern)
    : points_(set.law->size()), width_(set.law->width()) {
  const PointRowEntries own = entries(set, pattern);
  findBlocks(own, pattern);
  single_ = std::all_of(own.value.begin(), own.value.end(), [](double x) { return x == 1.0; });
  for (int r = 0; r < points_ * width_; ++r)
    single_ = single_ && own.begin[at(r + 1)] - own.begin[at(r)] <= 1;
  if (single_)
    takeSingle(own, pattern);
  else
    takeDense(own, pattern);
}

void PointRows::findBlocks(const PointRowEntries& entries, const linalg::BlockPattern& pattern) {
  blockBegin_.push_back(0);
  for (int p = 0; p < points_; ++p) {
    const auto begin = static_cast<std::ptrdiff_t>(block_.size());
    for (int i = entries.begin[at(p * width_)]; i < entries.begin[at((p + 1) * width_)]; ++i)
      block_.push_back(pattern.blockOf(entries.column[at(i)]));
    std::sort(block_.begin() + begin, block_.end());
    block_.erase(std::unique(block_.begin() + begin, block_.end()), block_.end());
    blockBegin_.push_back(static_cast<int>(block_.size()));
  }
  pointBegin_.assign(at(pattern.blocks() + 1), 0);
  for (int b : block_) ++pointBegin_[at(b + 1)];
  std::partial_sum(pointBegin_.begin(), pointBegin_.end(), pointBegin_.begin());
  point_.resize(block_.size());
  std::vector<int> next(pointBegin_.begin(), pointBegin_.end() - 1);
  for (int p = 0; p < points_; ++p)
    for (int i = blockBegin_[at(p)]; i < blockBegin_[at(p + 1)]; ++i)
      point_[at(next[at(block_[at(i)])]++)] = p;
}

void PointRows::takeSingle(const PointRowEntries& entries, const linalg::BlockPattern& pattern) {
  placeOf_.assign(at(points_ * width_), -1);
  for (int r = 0; r < points_ * width_; ++r)
    if (entries.begin[at(r + 1)] > entries.begin[at(r)])
      placeOf_[at(r)] = entries.column[at(entries.begin[at(r)])];
  entryAddress_.assign(placeOf_.size() * at(width_), noEntry);
  for (int r = 0; r < points_ * width_; ++r)
    for (int j = 0; j < width_; ++j) {
      const int row = placeOf_[at(r)], column = placeOf_[at(r / width_ * width_ + j)];
      if (row >= 0 && column >= 0) entryAddress_[at(r * width_ + j)] = pattern.address(row, column);
    }
}

void PointRows::takeDense(const PointRowEntries& entries, const linalg::BlockPattern& pattern) {
  pairBegin_.push_back(0);
  for (int p = 0; p < points_; ++p) {
    std::map<int, std::size_t> begin;  // offsets of the rows on each block
    const auto first = block_.begin() + blockBegin_[at(p)],
               last = block_.begin() + blockBegin_[at(p + 1)];
    for (auto block = first; block != last; ++block) {
      begin[*block] = dense_.size();
      touches_.push_back({pattern.start(*block), pattern.width(*block), dense_.size()});
      dense_.resize(dense_.size() + at(width_ * pattern.width(*block)), 0.0);
      for (auto other = first; other != last; ++other)
        pairOffset_.push_back(pattern.offset(pattern.find(*block, *other)));
    }
    for (int c = 0; c < width_; ++c)
      for (int i = entries.begin[at(p * width_ + c)]; i < entries.begin[at(p * width_ + c + 1)];
           ++i) {
        const int column = entries.column[at(i)], block = pattern.blockOf(column);
        dense_[begin[block] + at(c * pattern.width(block) + column - pattern.start(block))] =
            entries.value[at(i)];
      }
    pairBegin_.push_back(static_cast<int>(pairOffset_.size()));
  }
}

TOOLJOINT_CLONES double PointRows::times(int row, const double* x) const {
  if (single_) return placeOf_[at(row)] < 0 ? 0.0 : x[placeOf_[at(row)]];
  const int point = row / width_, c = row % width_;
  double sum = 0;
  for (int i = blockBegin_[at(point)]; i < blockBegin_[at(point + 1)]; ++i) {
    const Touch& touch = touches_[at(i)];
    sum += dot(touch.width, &dense_[touch.rows + at(c * touch.width)], x + touch.start);
  }
  return sum;
}

void PointRows::add(int row, double factor, double* y) const {
  if (single_) {
    if (placeOf_[at(row)] >= 0) y[placeOf_[at(row)]] += factor;
    return;
  }
  const int point = row / width_, c = row % width_;
  for (int i = blockBegin_[at(point)]; i < blockBegin_[at(point + 1)]; ++i) {
    const Touch& touch = touches_[at(i)];
    addTo(touch.width, &dense_[touch.rows + at(c * touch.width)], factor, y + touch.start);
  }
}

double PointRows::weight(int row, const double* weight) const {
  if (single_) return placeOf_[at(row)] < 0 ? 0.0 : weight[placeOf_[at(row)]];
  const int point = row / width_, c = row % width_;
  double largest = 0;
  for (int i = blockBegin_[at(point)]; i < blockBegin_[at(point + 1)]; ++i) {
    const Touch& touch = touches_[at(i)];
    const double* values = &dense_[touch.rows + at(c * touch.width)];
    for (int j = 0; j < touch.width; ++j)
      largest = std::max(largest, std::abs(values[j]) * weight[touch.start + j]);
  }
  return largest;
}

TOOLJOINT_CLONES void PointRows::gather(const std::vector<int>& points, const double* x,
                                        double* rows) const {
  if (single_) {
    for (int p : points)
      for (int r = p * width_; r < (p + 1) * width_; ++r)
        rows[r] = placeOf_[at(r)] < 0 ? 0.0 : x[placeOf_[at(r)]];
    return;
  }
  for (int p : points) {
    double* out = rows + p * width_;
    for (int c = 0; c < width_; ++c) out[c] = 0;
    for (int i = blockBegin_[at(p)]; i < blockBegin_[at(p + 1)]; ++i) {
      const Touch& touch = touches_[at(i)];
      const int n = touch.width;
      const double *a = &dense_[touch.rows], *in = x + touch.start;
      if (width_ == 3)
        for (int c = 0; c < 3; ++c) out[c] += dot(n, a + c * n, in);
      else
        for (int c = 0; c < width_; ++c) out[c] += dot(n, a + c * n, in);
    }
  }
}

TOOLJOINT_CLONES void PointRows::scatter(const std::vector<int>& points, const double* rows,
                                         double* y) const {
  if (single_) {
    for (int p : points)
      for (int r = p * width_; r < (p + 1) * width_; ++r)
        if (placeOf_[at(r)] >= 0) y[placeOf_[at(r)]] += rows[r];
    return;
  }
  for (int p : points)
    for (int i = blockBegin_[at(p)]; i < blockBegin_[at(p + 1)]; ++i) {
      const Touch& touch = touches_[at(i)];
      const int n = touch.width;
      const double *a = &dense_[touch.rows], *f = rows + p * width_;
      double* out = y + touch.start;
      if (width_ == 3)
        for (int j = 0; j < n; ++j) out[j] += (a[j] * f[0] + a[n + j] * f[1]) + a[2 * n + j] * f[2];
      else
        for (int c = 0; c < width_; ++c) addTo(n, a + c * n, f[c], out);
    }
}

void PointRows::project(int point, const double* values, double* block) const {
  const int w = width_;
  if (single_) {
    for (int i = 0; i < w * w; ++i) {
      const std::size_t address = entryAddress_[at(point * w * w + i)];
      block[i] = address == noEntry ? 0.0 : values[address];
    }
    return;
  }
  std::fill(block, block + w * w, 0.0);
  const int first = blockBegin_[at(point)];
  const int count = blockBegin_[at(point + 1)] - first;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      const Touch& row = touches_[at(first + a)];
      const Touch& column = touches_[at(first + b)];
      const double* Z = values + pairOffset_[at(pairBegin_[at(point)] + a * count + b)];
      for (int j = 0; j < column.width; ++j)
        for (int i = 0; i < row.width; ++i)
          for (int k = 0; k < w; ++k) {
            const double left = dense_[row.rows + at(k * row.width + i)] * Z[j * row.width + i];
            for (int l = 0; l < w; ++l)
              block[k * w + l] += left * dense_[column.rows + at(l * column.width + j)];
          }
    }
}

/// A(:, j) -= R' (P R(:, j)), block by block.
void PointRows::subtract(int point, const double* P, double* values) const {
  const int w = width_;
  if (single_) {
    for (int i = 0; i < w * w; ++i) {
      const std::size_t address = entryAddress_[at(point * w * w + i)];
      if (address != noEntry) values[address] -= P[i];
    }
    return;
  }
  const int first = blockBegin_[at(point)];
  const int count = blockBegin_[at(point + 1)] - first;
  for (int b = 0; b < count; ++b) {
    const Touch& column = touches_[at(first + b)];
    for (int j = 0; j < column.width; ++j) {
      const double* Rj = &dense_[column.rows + at(j)];
      bool zero = true;
      for (int c = 0; c < w; ++c) zero = zero && Rj[c * column.width] == 0.0;
      if (zero) continue;
      for (int r = 0; r < w; ++r) {
        double PRj = 0;
        for (int c = 0; c < w; ++c) PRj += P[r * w + c] * Rj[c * column.width];
        for (int a = 0; a < count; ++a) {
          const Touch& row = touches_[at(first + a)];
          addTo(
              row.width, &dense_[row.rows + at(r * row.width)], -PRj,
              values + pairOffset_[at(pairBegin_[at(point)] + a * count + b)] + at(j * row.width));
        }
      }
    }
  }
}

void PointRows::appendBlocks(int point, std::vector<int>& blocks) const {
  blocks.insert(blocks.end(), block_.begin() + blockBegin_[at(point)],
                block_.begin() + blockBegin_[at(point + 1)]);
}

}  // namespace tooljoint::transient
