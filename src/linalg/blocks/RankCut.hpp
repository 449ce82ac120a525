// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vectors and matrices divided among ranks at a cut. A rank holds its interior positions and,
/// after them, those of the cut that it shares with others,
///
///     x = [x_I  x_C],   A = sum over the ranks of their A,   x equal on all ranks that hold it.
///
/// Products with the A of one rank are partial at the cut: their sum over the ranks is the product.
/// Sums are taken in the order of the ranks, so all ranks have bitwise equal results.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::linalg {

class RankCut {
 public:
  /// One rank that holds everything: every operation is local and free.
  RankCut() = default;
  /// \param interior positions held by this rank alone, before those of the cut
  /// \param number    of each position of the cut on this rank, in the numbering of the whole cut
  /// \param total number of positions of the whole cut
  /// \param own       whether this rank counts a position of the cut in sums over all positions
  /// Constructed by all ranks of parallel::communicator() at once.
  RankCut(int interior, std::vector<int> number, int total, std::vector<char> own);

  bool isDivided() const { return ranks_ > 1; }
  int ranks() const { return ranks_; }
  /// Number of positions before the cut; all if not divided.
  int interior(int size) const { return isDivided() ? interior_ : size; }
  int total() const { return total_; }
  /// Number of messages exchanged by all ranks so far.
  long messages() const { return messages_; }
  /// Whether this rank counts a position.
  bool owns(int position) const {
    return position < interior_ || !isDivided() ||
           own_[static_cast<std::size_t>(position - interior_)] != 0;
  }
  /// Number of a cut position in the whole cut.
  int number(int position) const { return number_[static_cast<std::size_t>(position - interior_)]; }

  // Reductions over the ranks; collective, with the same result on all ranks. A maximum keeps a
  // NaN.
  /// Maxima of `largest`, sums of `sums`, in one message.
  void reduce(double* largest, int maxima, double* sums, int count) const;
  double largest(double value) const;
  double sum(double value) const;
  bool any(bool value) const;
  /// Sum over the ranks below this one.
  double before(double value) const;
  /// The text of the rank with the largest size; of equal ones, the lowest rank.
  std::string ofLargest(double size, const std::string& text) const;
  /// Partial x -> equal on all ranks that share it; x is a complete vector, or its cut only.
  void complete(double* x) const { completeCut(x + interior_); }
  void completeCut(double* cut) const;
  /// x equal on all ranks -> partial: zero at the cut except on the rank that counts the position.
  void divide(double* x) const;
  /// Cut of a complete vector -> entries of the whole cut, and back.
  void collect(const double* x, double* whole) const;
  void spread(const double* whole, double* x) const;
  /// Sum over the ranks of arrays of equal length.
  void sumAll(double* values, std::size_t count) const;

 private:
  const double* gather(std::size_t count) const;

  int ranks_ = 1, rank_ = 0;
  int interior_ = 0, total_ = 0;
  std::vector<int> number_;
  std::vector<char> own_;
  mutable std::vector<double> mine_, all_, whole_;  ///< messages
  mutable long messages_ = 0;
};

}  // namespace tooljoint::linalg
