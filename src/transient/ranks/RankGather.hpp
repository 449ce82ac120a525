// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Gathers vectors, of which every rank has some entries, on the first rank.
#pragma once

#include <array>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::transient {

class RankGather {
 public:
  /// \param size of the complete vector on parallel::communicator()
  /// \param entries entries that only this rank has; entries of no rank are zero. Collective.
  RankGather(int size, const std::vector<int>& entries);

  /// Buffer for the entries of this rank: all entries of one vector in the order of `entries`,
  /// vector by vector.
  double* mine(std::size_t vectors);
  /// The complete vectors, on rank 0; on other ranks `whole` is unchanged. Collective, one message.
  template <std::size_t N>
  void gather(const std::array<Vector*, N>& whole) {
    gather(whole.data(), N);
  }

 private:
  void gather(Vector* const* whole, std::size_t vectors);

  int size_;                              ///< length of a vector
  std::size_t count_;                     ///< entries of this rank
  std::vector<std::vector<int>> ofRank_;  ///< entries of each rank; on rank 0
  std::vector<double> mine_, all_;
  std::vector<int> lengths_, begins_;
};

}  // namespace tooljoint::transient
