// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Vectors of which every rank knows some entries, brought together on the first of them.
#pragma once

#include <array>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::transient {

class RankGather {
 public:
  /// \param size     of a vector that the ranks of parallel::communicator() give together
  /// \param entries  of it that this rank gives and no other; what no rank gives is zero
  /// Collective.
  RankGather(int size, const std::vector<int>& entries);

  /// Where this rank puts the entries of some vectors: all of one vector in the order of `entries`,
  /// vector by vector.
  double* mine(std::size_t vectors);
  /// The vectors of mine(), on rank 0; elsewhere `whole` keeps what it has. Collective, one
  /// message.
  template <std::size_t N>
  void gather(const std::array<Vector*, N>& whole) {
    gather(whole.data(), N);
  }

 private:
  void gather(Vector* const* whole, std::size_t vectors);

  int size_;                              ///< of a vector
  std::size_t count_;                     ///< entries of this rank
  std::vector<std::vector<int>> ofRank_;  ///< entries of each; on rank 0
  std::vector<double> mine_, all_;
  std::vector<int> lengths_, begins_;
};

}  // namespace tooljoint::transient
