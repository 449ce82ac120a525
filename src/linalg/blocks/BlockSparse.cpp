// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/BlockSparse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/blocks/BlockKernels.hpp"

namespace tooljoint::linalg {
namespace {

/// Sums of products of 6 x 6 blocks and vectors. Two columns of a block are three quads: rows 0 to
/// 3 of the first, rows 4 and 5 of the first with rows 0 and 1 of the second, rows 2 to 5 of the
/// second.
struct SixSum {
  kernel::Quad a{0, 0, 0, 0}, m{0, 0, 0, 0}, b{0, 0, 0, 0};
  TOOLJOINT_INLINED void addTwoColumns(const double* A, const double* x) {
    const kernel::Quad x0{x[0], x[0], x[0], x[0]}, x1{x[1], x[1], x[1], x[1]};
#if defined(__clang__)
    const kernel::Quad both{x[0], x[0], x[1], x[1]};
#else
    using Order = long long __attribute__((vector_size(32)));
    const kernel::Quad both = __builtin_shuffle(x0, x1, Order{0, 1, 6, 7});
#endif
    a += *reinterpret_cast<const kernel::Quad*>(A) * x0;
    m += *reinterpret_cast<const kernel::Quad*>(A + 4) * both;
    b += *reinterpret_cast<const kernel::Quad*>(A + 8) * x1;
  }
  /// even + odd += A x, A 6 x 6.
  static TOOLJOINT_INLINED void add(const double* A, const double* x, SixSum& even, SixSum& odd) {
    even.addTwoColumns(A, x);
    odd.addTwoColumns(A + 12, x + 2);
    even.addTwoColumns(A + 24, x + 4);
  }
  /// y += even + odd.
  static TOOLJOINT_INLINED void total(const SixSum& even, const SixSum& odd, kernel::Six& y) {
    const kernel::Quad m = even.m + odd.m, b = even.b + odd.b;
    y.a += (even.a + odd.a) + kernel::Quad{m[2], m[3], b[0], b[1]};
    y.b += kernel::Pair{m[0], m[1]} + kernel::Pair{b[2], b[3]};
  }
};

/// Union-find with path halving.
class Families {
 public:
  explicit Families(int n) : parent_(at(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(int a, int b) {
    a = root(a), b = root(b);
    if (a != b) parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

/// Number of the block of each dof, in order of first appearance.
int number(const std::vector<std::pair<int, int>>& key, std::vector<int>& block) {
  std::map<std::pair<int, int>, int> seen;
  for (std::size_t i = 0; i < key.size(); ++i)
    block[i] = seen.emplace(key[i], static_cast<int>(seen.size())).first->second;
  return static_cast<int>(seen.size());
}

std::vector<std::set<int>> blockGraph(const std::vector<const Sparse*>& matrices,
                                      const std::vector<int>& block, int blocks) {
  std::vector<std::set<int>> graph(at(blocks));
  for (int b = 0; b < blocks; ++b) graph[at(b)].insert(b);
  for (const Sparse* matrix : matrices)
    for (int i = 0; i < matrix->outerSize(); ++i)
      for (Sparse::InnerIterator it(*matrix, i); it; ++it) {
        if (it.value() == 0.0) continue;
        const int a = block[at(i)];
        const int b = block[at(static_cast<int>(it.col()))];
        if (a == b) continue;
        graph[at(a)].insert(b);
        graph[at(b)].insert(a);
      }
  return graph;
}

}  // namespace

BlockPartition partitionDofs(const std::vector<const Sparse*>& matrices,
                             const std::vector<int>& group, const std::vector<int>& kind) {
  const int n = static_cast<int>(group.size());
  Families families(n);
  for (const Sparse* matrix : matrices)
    for (int i = 0; i < n; ++i)
      for (Sparse::InnerIterator it(*matrix, i); it; ++it)
        if (it.value() != 0.0) families.join(i, static_cast<int>(it.col()));

  std::vector<std::pair<int, int>> key(at(n));
  for (int i = 0; i < n; ++i) key[at(i)] = {group[at(i)], families.root(i)};
  std::vector<int> block(at(n));
  const int groups = number(key, block);

  // Blocks with the same closed neighbourhood and class are indistinguishable: merge them.
  const auto graph = blockGraph(matrices, block, groups);
  std::vector<int> kindOf(at(groups), 0);
  for (int i = 0; i < n; ++i) kindOf[at(block[at(i)])] = kind[at(i)];
  std::map<std::pair<int, std::vector<int>>, int> first;
  std::vector<int> leader(at(groups));
  for (int b = 0; b < groups; ++b) {
    std::vector<int> neighbours(graph[at(b)].begin(), graph[at(b)].end());
    leader[at(b)] =
        first.emplace(std::make_pair(kindOf[at(b)], std::move(neighbours)), b).first->second;
  }
  for (int i = 0; i < n; ++i) key[at(i)] = {leader[at(block[at(i)])], 0};
  const int blocks = number(key, block);

  BlockPartition partition;
  partition.start.assign(at(blocks + 1), 0);
  for (int i = 0; i < n; ++i) ++partition.start[at(block[at(i)] + 1)];
  std::partial_sum(partition.start.begin(), partition.start.end(), partition.start.begin());
  std::vector<int> next(partition.start.begin(), partition.start.end() - 1);
  partition.position.resize(at(n));
  partition.dof.resize(at(n));
  for (int i = 0; i < n; ++i) {
    const int p = next[at(block[at(i)])]++;
    partition.position[at(i)] = p;
    partition.dof[at(p)] = i;
  }
  return partition;
}

BlockPattern::BlockPattern(BlockPartition partition, const std::vector<const Sparse*>& matrices)
    : partition_(std::move(partition)) {
  const int n = size();
  blockOf_.resize(at(n));
  for (int b = 0; b < blocks(); ++b)
    for (int p = start(b); p < start(b + 1); ++p) blockOf_[at(p)] = b;
  std::vector<int> blockOfDof(at(n));
  for (int i = 0; i < n; ++i) blockOfDof[at(i)] = blockOf_[at(partition_.position[at(i)])];

  const auto graph = blockGraph(matrices, blockOfDof, blocks());
  rowBegin_.push_back(0);
  for (int b = 0; b < blocks(); ++b) {
    column_.insert(column_.end(), graph[at(b)].begin(), graph[at(b)].end());
    rowBegin_.push_back(static_cast<int>(column_.size()));
  }
  offset_.resize(column_.size());
  for (const bool below : {false, true})  // the blocks read by a symmetric product are contiguous
    for (int b = 0; b < blocks(); ++b)
      for (int e = rowBegin(b); e < rowBegin(b + 1); ++e) {
        if ((column(e) < b) != below) continue;
        offset_[at(e)] = storage_;
        storage_ += (at(width(b)) * at(width(column(e))) + 3) / 4 * 4;
      }
}

int BlockPattern::interiorBlocks() const {
  const int interior = cut_->interior(size());
  return interior < size() ? blockOf(interior) : blocks();
}

int BlockPattern::find(int row, int column) const {
  const auto begin = column_.begin() + rowBegin(row);
  const auto end = column_.begin() + rowBegin(row + 1);
  const auto it = std::lower_bound(begin, end, column);
  return it != end && *it == column ? static_cast<int>(it - column_.begin()) : -1;
}

std::size_t BlockPattern::address(int rowPosition, int columnPosition) const {
  const int row = blockOf(rowPosition);
  const int col = blockOf(columnPosition);
  return offset(find(row, col)) + at(columnPosition - start(col)) * at(width(row)) +
         at(rowPosition - start(row));
}

void BlockPattern::add(const Sparse& matrix, double factor, BlockValues& values) const {
  for (int i = 0; i < matrix.outerSize(); ++i)
    for (Sparse::InnerIterator it(matrix, i); it; ++it)
      if (it.value() != 0.0)
        values[address(partition_.position[at(i)],
                       partition_.position[at(static_cast<int>(it.col()))])] += factor * it.value();
}

std::vector<BlockRange> blockRuns(const BlockPattern& pattern, int positions) {
  std::vector<BlockRange> runs;
  for (int b = 0; b < pattern.blocks(); ++b) {
    if (runs.empty() || b == pattern.interiorBlocks() ||
        pattern.start(b + 1) - pattern.start(runs.back().begin) > positions)
      runs.push_back({b, b});
    runs.back().end = b + 1;
  }
  return runs;
}

BlockProduct::BlockProduct(const BlockPattern& pattern,
                           const std::vector<const BlockValues*>& samples,
                           const BlockProduct* like) {
  if (pattern.storage() > std::numeric_limits<std::uint32_t>::max())
    throw ModelError(
        "A matrix of the model would take more than 32 GB. Use a coarser mesh, fewer modes or "
        "fewer retained nodes.");
  far_ = pattern.storage() > kernel::nearCache;
  findSymmetry(pattern, samples);
  int widest = 0;
  Layout layout;
  for (int b = 0; b < pattern.blocks(); ++b) {
    layout.firstRow.push_back(static_cast<int>(layout.rows.size()));
    widest = std::max(widest, pattern.width(b));
    const Row row = listRow(pattern, samples, b, layout.entries);
    if (row.end > row.begin) layout.rows.push_back(row);
  }
  layout.firstRow.push_back(static_cast<int>(layout.rows.size()));
  if (like != nullptr && like->layout_ != nullptr && *like->layout_ == layout)
    layout_ = like->layout_;
  else
    layout_ = std::make_shared<const Layout>(std::move(layout));
  sum_.assign(at(widest), 0.0);
}

/// Entries of a block row that are nonzero in any sample.
BlockProduct::Row BlockProduct::listRow(const BlockPattern& pattern,
                                        const std::vector<const BlockValues*>& samples, int block,
                                        std::vector<Entry>& entries) const {
  const auto offset = [&pattern](int e) { return static_cast<std::uint32_t>(pattern.offset(e)); };
  const int rows = pattern.width(block);
  Row row{pattern.start(block), rows, static_cast<int>(entries.size()), 0, 0, rows == 6};
  row.diagonal = row.begin;
  for (int e = pattern.rowBegin(block); e < pattern.rowBegin(block + 1); ++e) {
    const int columns = pattern.width(pattern.column(e));
    bool any = false;
    bool offDiagonal = rows != columns;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i)
        for (const BlockValues* sample : samples)
          if ((*sample)[pattern.offset(e) + at(j * rows + i)] != 0.0) {
            any = true;
            offDiagonal = offDiagonal || i != j;
          }
    if (!any) continue;
    Entry entry{offset(e), pattern.start(pattern.column(e)), columns,
                offDiagonal ? Form::Dense : Form::Diagonal};
    row.inSix = row.inSix && (columns == 6 || !far_);
    if (pattern.column(e) < block) {
      if (far_ && mirrored_ && offDiagonal) {
        entry.form = Form::Transposed;
        entry.offset = offset(pattern.find(pattern.column(e), block));
      }
      ++row.diagonal;
    }
    entries.push_back(entry);
  }
  row.end = static_cast<int>(entries.size());
  return row;
}

void BlockProduct::findSymmetry(const BlockPattern& pattern,
                                const std::vector<const BlockValues*>& samples) {
  constexpr double rounding = 1e-12;
  symmetric_ = mirrored_ = true;
  Vector root(pattern.size());  // sqrt |A_ii|
  for (const BlockValues* sample : samples) {
    const double* A = sample->data();
    for (int p = 0; p < pattern.size(); ++p)
      root[p] = std::sqrt(std::abs(A[pattern.address(p, p)]));
    for (int b = 0; b < pattern.blocks(); ++b)
      for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1) && pattern.column(e) <= b;
           ++e) {
        const int c = pattern.column(e), rows = pattern.width(b), columns = pattern.width(c);
        const double* here = A + pattern.offset(e);
        const double* there = A + pattern.offset(pattern.find(c, b));
        for (int j = 0; j < columns; ++j)
          for (int i = 0; i < rows; ++i) {
            const double difference = std::abs(here[j * rows + i] - there[i * columns + j]);
            const bool same = difference <= rounding * root[pattern.start(b) + i] *
                                                root[pattern.start(c) + j];  // false for NaN
            if (!same) (c < b ? mirrored_ : symmetric_) = false;
          }
      }
  }
  symmetric_ = symmetric_ && mirrored_;
}

/// sum += A_ij x_j over some entries of a row.
TOOLJOINT_INLINED void BlockProduct::addEntries(const Row& row, int begin, int end,
                                                const double* values, const double* x,
                                                double* sum) const {
  const Entry* entries = layout_->entries.data();
  for (int e = begin; e < end; ++e) {
    const double* block = values + entries[e].offset;
    const double* source = x + entries[e].column;
    if (entries[e].form == Form::Diagonal)
      for (int i = 0; i < row.width; ++i) sum[i] += block[i * (row.width + 1)] * source[i];
    else if (entries[e].form == Form::Transposed)
      kernel::multiplyTransposedAdd(entries[e].width, row.width, block, source, sum);
    else
      kernel::multiplyAdd(row.width, entries[e].width, block, source, sum);
  }
}

/// even + odd += A_ij x_j over some entries of a six-row block row.
TOOLJOINT_INLINED void BlockProduct::addSix(int begin, int end, const double* values,
                                            const double* x, kernel::Six& even,
                                            kernel::Six& odd) const {
  SixSum some, others;
  const Entry* last = layout_->entries.data() + end;
  for (const Entry* entry = layout_->entries.data() + begin; entry != last; ++entry) {
    const double* block = values + entry->offset;
    const double* source = x + entry->column;
    if (entry->form == Form::Transposed) {
      kernel::addSixTransposed(block, source, odd);
      continue;
    }
    if (far_) kernel::fetchAhead(block, 36);
    if (entry->form == Form::Diagonal)
      odd.addDiagonal(block, source);
    else if (entry->width == 6)
      SixSum::add(block, source, some, others);
    else
      kernel::addPairs(entry->width, block, source, even, odd);
  }
  SixSum::total(some, others, even);
}

TOOLJOINT_CLONES void BlockProduct::addRows(int begin, int end, const double* values,
                                            const double* x, double* y, double factor) const {
  const Row* last = layout_->rows.data() + end;
  for (const Row* each = layout_->rows.data() + begin; each != last; ++each) {
    const Row row = *each;
    double* target = y + row.start;
    if (row.inSix) {
      kernel::Six even, odd;
      addSix(row.begin, row.end, values, x, even, odd);
      even.a += odd.a, even.b += odd.b;
      even.addTo(target, factor);
      continue;
    }
    double* sum = factor == 1.0 ? target : sum_.data();
    if (sum != target) std::fill(sum, sum + row.width, 0.0);
    addEntries(row, row.begin, row.end, values, x, sum);
    if (sum != target)
      for (int i = 0; i < row.width; ++i) target[i] += factor * sum[i];
  }
}

/// x_i'(A_ii x_i + 2 sum_(j > i) A_ij x_j), or x_i'sum_j A_ij x_j
TOOLJOINT_INLINED double BlockProduct::sixForm(const Row& row, const double* values,
                                               const double* x) const {
  kernel::Six even, odd;
  if (mirrored_) {
    const bool own =
        row.diagonal < row.end && layout_->entries[at(row.diagonal)].column == row.start;
    const int beyond = own ? row.diagonal + 1 : row.diagonal;
    addSix(row.diagonal, beyond, values, x, even, odd);
    even.a += odd.a, even.b += odd.b;
    even.a *= 0.5, even.b *= 0.5;
    odd = kernel::Six();
    addSix(beyond, row.end, values, x, even, odd);
  } else {
    addSix(row.begin, row.end, values, x, even, odd);
  }
  const kernel::Six own(x + row.start);
  const kernel::Quad a = own.a * (even.a + odd.a);
  const kernel::Pair b = own.b * (even.b + odd.b);
  return (mirrored_ ? 2.0 : 1.0) * (((a[0] + a[1]) + (a[2] + a[3])) + (b[0] + b[1]));
}

/// sum_i x_i'(A_ii x_i + 2 sum_(j > i) A_ij x_j), or sum_ij x_i'A_ij x_j
TOOLJOINT_CLONES double BlockProduct::formRows(int begin, int end, const double* values,
                                               const double* x) const {
  const Row* last = layout_->rows.data() + end;
  double* sum = sum_.data();
  double whole = 0;
  for (const Row* each = layout_->rows.data() + begin; each != last; ++each) {
    const Row row = *each;
    if (row.inSix) {
      whole += sixForm(row, values, x);
      continue;
    }
    std::fill(sum, sum + row.width, 0.0);
    if (mirrored_) {
      const bool own =
          row.diagonal < row.end && layout_->entries[at(row.diagonal)].column == row.start;
      const int beyond = own ? row.diagonal + 1 : row.diagonal;
      addEntries(row, beyond, row.end, values, x, sum);
      for (int i = 0; i < row.width; ++i) sum[i] *= 2.0;
      addEntries(row, row.diagonal, beyond, values, x, sum);
    } else {
      addEntries(row, row.begin, row.end, values, x, sum);
    }
    for (int i = 0; i < row.width; ++i) whole += x[row.start + i] * sum[i];
  }
  return whole;
}

}  // namespace tooljoint::linalg
