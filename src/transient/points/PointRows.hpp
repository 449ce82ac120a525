// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rows R of the points of a PointSet on a block pattern: products with R and R', and with matrices
/// on the pattern. If every row has one entry, 1 (points at nodes of a model that is not reduced),
/// only its position is stored. Otherwise the rows of a point are dense over the blocks they use,
/// so that a point of a reduced part reads the modes of the part contiguously.
#pragma once

#include <cstddef>
#include <vector>

#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::transient {

/// Rows of points as CSR; columns are positions of the pattern.
struct PointRowEntries {
  std::vector<int> begin, column;
  std::vector<double> value;
};

class PointRows {
 public:
  PointRows() = default;
  PointRows(const model::PointSet& set, const linalg::BlockPattern& pattern);

  /// Nonzero entries of the rows of a set.
  static PointRowEntries entries(const model::PointSet& set, const linalg::BlockPattern& pattern);

  int width() const { return width_; }  ///< rows per point

  /// R_row x; y += factor R_row'; the largest |R_row,i| weight_i.
  double times(int row, const double* x) const;
  void add(int row, double factor, double* y) const;
  double weight(int row, const double* weight) const;

  /// rows = R x of these points.
  void gather(const std::vector<int>& points, const double* x, double* rows) const;
  /// y += R' rows.
  void scatter(const std::vector<int>& points, const double* rows, double* y) const;

  /// R_p Z R_p' of a point for a matrix on the pattern, row-major.
  void project(int point, const double* values, double* block) const;
  /// Matrix -= R_p' P R_p, P row-major.
  void subtract(int point, const double* P, double* values) const;

  /// All blocks of the pattern used by rows, point by point; appendBlocks() appends those of one
  /// point.
  const std::vector<int>& blocks() const { return block_; }
  void appendBlocks(int point, std::vector<int>& blocks) const;
  /// act(p) for the points with rows in a block.
  template <class Act>
  void forPointsIn(int block, const Act& act) const {
    const auto b = static_cast<std::size_t>(block);
    for (int i = pointBegin_[b]; i < pointBegin_[b + 1]; ++i)
      act(point_[static_cast<std::size_t>(i)]);
  }

 private:
  void findBlocks(const PointRowEntries& entries, const linalg::BlockPattern& pattern);
  void takeSingle(const PointRowEntries& entries, const linalg::BlockPattern& pattern);
  void takeDense(const PointRowEntries& entries, const linalg::BlockPattern& pattern);

  int points_ = 0, width_ = 0;
  bool single_ = false;                    ///< every row has at most one entry, and it is 1
  std::vector<int> placeOf_;               ///< single: position of each row, -1 for none
  std::vector<std::size_t> entryAddress_;  ///< single: of (row, column) of a point, width x width

  std::vector<int> blockBegin_, block_;  ///< per point: the blocks of its rows
  std::vector<int> pointBegin_, point_;  ///< per block: the points with rows in it

  /// Rows restricted to a block, width x block, row-major.
  struct Touch {
    int start, width;
    std::size_t rows;  ///< into dense_
  };
  std::vector<Touch> touches_;  ///< as block_
  std::vector<double> dense_;
  std::vector<int> pairBegin_;           ///< per point: start in pairOffset_
  std::vector<std::size_t> pairOffset_;  ///< block offsets for all pairs of touches
};

}  // namespace tooljoint::transient
