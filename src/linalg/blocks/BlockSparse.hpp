// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Square matrices of dense blocks of varying size on one symmetric pattern: partition of the dofs
/// into blocks, storage of the blocks, and products that skip zero blocks and off-diagonal entries
/// of diagonal blocks.
///
/// All matrices of a model share one pattern and so one storage layout: a sum of matrices is a sum
/// of arrays.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/LargePages.hpp"
#include "linalg/blocks/RankCut.hpp"

namespace tooljoint::linalg {

namespace kernel {
struct Six;
}

using BlockValues = std::vector<double, LargePages<double>>;

/// Partition of the dofs into blocks. Positions are dofs renumbered so that blocks are contiguous.
struct BlockPartition {
  std::vector<int> start;     ///< block -> its first position; size blocks()+1
  std::vector<int> position;  ///< dof -> position
  std::vector<int> dof;       ///< position -> dof
  int blocks() const { return static_cast<int>(start.size()) - 1; }
};

/// Gathers dofs into blocks. Dofs of one group (a node, the modes of a part) stay together, except
/// when the matrices do not couple them at all: then each family (lateral, axial ...) has its own
/// blocks. Groups of one class with exactly the same neighbours (a dense interface) become one
/// block.
/// \param matrices patterns to unite, all of one size
/// \param group group number per dof
/// \param kind class per dof; only groups of one class may be merged
BlockPartition partitionDofs(const std::vector<const Sparse*>& matrices,
                             const std::vector<int>& group, const std::vector<int>& kind);

/// Symmetric pattern of dense column-major blocks, diagonal blocks included, sorted by row, then
/// column.
class BlockPattern {
 public:
  BlockPattern() = default;
  /// United, symmetrised pattern of the matrices under a partition.
  BlockPattern(BlockPartition partition, const std::vector<const Sparse*>& matrices);

  int size() const { return partition_.start.back(); }
  int blocks() const { return partition_.blocks(); }
  int start(int block) const { return partition_.start[static_cast<std::size_t>(block)]; }
  int width(int block) const { return start(block + 1) - start(block); }
  int blockOf(int position) const { return blockOf_[static_cast<std::size_t>(position)]; }
  const BlockPartition& partition() const { return partition_; }

  /// Blocks of block row b: entries rowBegin(b) ... rowBegin(b+1)-1 of column() and offset().
  int rowBegin(int b) const { return rowBegin_[static_cast<std::size_t>(b)]; }
  int column(int entry) const { return column_[static_cast<std::size_t>(entry)]; }
  std::size_t offset(int entry) const { return offset_[static_cast<std::size_t>(entry)]; }
  /// Entry of block (row, column), -1 if it is not in the pattern.
  int find(int row, int column) const;
  /// Number of doubles of a matrix on this pattern.
  std::size_t storage() const { return storage_; }
  /// Address of a scalar entry by its positions, which must be in the pattern.
  std::size_t address(int rowPosition, int columnPosition) const;

  /// Makes this the part of one rank in a pattern divided among ranks; the blocks of the cut are
  /// the last ones.
  void divide(RankCut cut) { cut_ = std::make_shared<const RankCut>(std::move(cut)); }
  const RankCut& cut() const { return *cut_; }
  const std::shared_ptr<const RankCut>& sharedCut() const { return cut_; }
  /// Blocks before those of the cut.
  int interiorBlocks() const;

  /// values += factor * matrix (in dofs, not positions).
  void add(const Sparse& matrix, double factor, BlockValues& values) const;

 private:
  BlockPartition partition_;
  std::vector<int> blockOf_;
  std::vector<int> rowBegin_;
  std::vector<int> column_;
  std::vector<std::size_t> offset_;
  std::size_t storage_ = 0;
  std::shared_ptr<const RankCut> cut_ = std::make_shared<const RankCut>();
};

/// Blocks begin ... end - 1.
struct BlockRange {
  int begin, end;
};

/// Runs of blocks with about this many positions, so that several vectors of this length stay in a
/// near cache. Blocks of the cut form separate runs.
std::vector<BlockRange> blockRuns(const BlockPattern& pattern, int positions);

/// y += A x for matrices on one pattern. Zero blocks, diagonal blocks and symmetry are found once,
/// from samples that contain every nonzero of later products. Matrices larger than a near cache are
/// prefetched. If blocks below the diagonal mirror those above, they are not read, because their
/// values were read in an earlier row. This also holds for stiffness under varying torque, whose
/// skew part is in the diagonal blocks of beams.
class BlockProduct {
 public:
  BlockProduct() = default;
  /// \param like another product on the pattern; if both read the same blocks in the same way, they
  /// share the list of blocks
  BlockProduct(const BlockPattern& pattern, const std::vector<const BlockValues*>& samples,
               const BlockProduct* like = nullptr);
  bool empty() const { return layout_ == nullptr || layout_->rows.empty(); }
  /// Whether both share one list of blocks, which is then read once in consecutive products.
  bool shares(const BlockProduct& other) const { return layout_ == other.layout_; }
  /// |A_ij - A_ji| <= 1e-12 sqrt(A_ii A_jj) in all samples: rounding of assembly in rotated frames.
  bool isSymmetric() const { return symmetric_; }
  /// y += factor A x, vectors in positions.
  void addTo(const double* values, const double* x, double* y, double factor = 1.0) const {
    if (!empty()) addRows(0, static_cast<int>(layout_->rows.size()), values, x, y, factor);
  }
  /// The same for the rows of these blocks only.
  void addTo(const double* values, const double* x, double* y, double factor,
             BlockRange range) const {
    if (!empty()) addRows(firstRow(range.begin), firstRow(range.end), values, x, y, factor);
  }
  /// x' A x, and the contribution of the rows of some blocks. For a symmetric A half the blocks are
  /// read.
  double form(const double* values, const double* x) const {
    return empty() ? 0.0 : formRows(0, static_cast<int>(layout_->rows.size()), values, x);
  }
  double form(const double* values, const double* x, BlockRange range) const {
    return empty() ? 0.0 : formRows(firstRow(range.begin), firstRow(range.end), values, x);
  }

 private:
  struct Row;
  int firstRow(int block) const { return layout_->firstRow[static_cast<std::size_t>(block)]; }
  double formRows(int begin, int end, const double* values, const double* x) const;
  void addEntries(const Row& row, int begin, int end, const double* values, const double* x,
                  double* sum) const;
  void addSix(int begin, int end, const double* values, const double* x, kernel::Six& even,
              kernel::Six& odd) const;
  double sixForm(const Row& row, const double* values, const double* x) const;
  void findSymmetry(const BlockPattern& pattern, const std::vector<const BlockValues*>& samples);
  void addRows(int begin, int end, const double* values, const double* x, double* y,
               double factor) const;
  enum class Form : std::uint8_t { Dense, Diagonal, Transposed };
  struct Entry {
    std::uint32_t offset;  ///< of the block, doubles
    int column;
    int width;
    Form form;
    bool operator==(const Entry& other) const {
      return offset == other.offset && column == other.column && width == other.width &&
             form == other.form;
    }
  };
  struct Row {
    int start;
    int width;
    int begin;
    int end;
    int diagonal;  ///< first entry on or above the diagonal
    bool inSix;    ///< six rows, summed in registers (if prefetched, only with six columns
                   ///< throughout)
    bool operator==(const Row& other) const {
      return start == other.start && width == other.width && begin == other.begin &&
             end == other.end && diagonal == other.diagonal && inSix == other.inSix;
    }
  };
  /// Data read besides the values: up to an eighth of their size.
  struct Layout {
    std::vector<Row> rows;
    std::vector<int> firstRow;  ///< block -> its first row in rows, or the next one
    std::vector<Entry> entries;
    bool operator==(const Layout& other) const {
      return rows == other.rows && firstRow == other.firstRow && entries == other.entries;
    }
  };
  Row listRow(const BlockPattern& pattern, const std::vector<const BlockValues*>& samples,
              int block, std::vector<Entry>& entries) const;
  std::shared_ptr<const Layout> layout_;
  bool symmetric_ = false;
  bool mirrored_ = false;  ///< A_ij = A_ji' for i != j; diagonal blocks need not be symmetric
  bool far_ = false;       ///< matrices exceed a near cache
  mutable std::vector<double> sum_;
};

}  // namespace tooljoint::linalg
