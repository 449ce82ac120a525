// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// LU of a block-sparse matrix with partial pivoting inside diagonal blocks. Order and fill are
/// found once; factor() and solve() allocate nothing. The elimination order takes blocks of least
/// work first, so a chain becomes a block-tridiagonal sweep from both ends, modes that hang between
/// two nodes are eliminated before the sweep, a loop or a star costs its own small fill, and any
/// other graph still factors correctly.
///
/// Of a matrix that is divided among ranks (RankCut), each rank eliminates its interior; what is
/// left at the cut is summed over the ranks and factored by all of them alike. factor() and the
/// solutions are then collective, with right-hand sides that are partial at the cut:
///
///     S = sum over the ranks of A_CC - A_CI A_II^-1 A_IC,
///     S x_C = sum of b_C - A_CI A_II^-1 b_I,   x_I = A_II^-1 (b_I - A_IC x_C)
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "linalg/blocks/BlockSparse.hpp"
#include "linalg/blocks/CutFactor.hpp"

namespace tooljoint::linalg {

class BlockFactor {
 public:
  BlockFactor() = default;
  /// Symbolic phase for matrices on this pattern.
  explicit BlockFactor(const BlockPattern& pattern);

  bool empty() const { return pivots_.empty(); }

  /// Values to fill before factor(), laid out as in the pattern (BlockPattern::storage() doubles).
  double* values() { return values_.data(); }

  /// A pivot below this part of the size of its row has vanished.
  static constexpr double vanished = 1e-14;
  /// Factor what stands in values() (destroyed). Returns -1, or the position of the dof whose pivot
  /// vanished, the number of positions when it vanished on another rank (nothing usable is left
  /// then).
  int factor(double smallest = vanished);

  /// x := A^-1 x, in positions.
  void solve(double* x) const;

  /// Of a chain: the blocks before the last one to be eliminated, and those behind it, are two
  /// sweeps that meet there and need nothing of each other before. Two processes may do one each;
  /// factors and solutions are those of factor() and solve(), bit by bit.
  class TwoSweeps;
  bool hasTwoSweeps() const;

  /// The same for an x that is zero outside the blocks `live` (any order, repeated or not). What
  /// falls below `small` in units of `weight` (forces on the way down, displacements on the way up)
  /// is dropped, so that the cost is that of the blocks a local force reaches; `live` then holds
  /// those where x is not zero, each once. In a stiff chain that is a few neighbours.
  void solveNear(double* x, std::vector<int>& live, const double* weight, double small) const;

  /// Blocks of A^-1 on the pattern, for what `wanted` names of the diagonal blocks (and everything
  /// that takes): the recursion of Takahashi, Fagan and Chen (1973), which never leaves the fill.
  /// After factor(); costs about as much.
  ///
  ///     Z_Lk = -Z_LL A_Lk D_k^-1,   Z_kL = -W_kL Z_LL,   Z_kk = D_k^-1 - W_kL Z_Lk
  void invert(const std::vector<char>& wanted);
  /// Allocates what the first invert() would.
  void reserveInverse();
  /// Values of the last invert(), laid out as in the pattern.
  const double* inverse() const { return inverse_.data(); }

  /// Multiplications of one solve, the measure of cost per step.
  double solveWork() const { return solveWork_; }
  /// Doubles of fill beyond the pattern.
  std::size_t fill() const { return values_.size() - patternStorage_; }

 private:
  // What solve() reads is kept apart from what only factor() and invert() do, and short: beside
  // blocks of six it is a tenth of all.
  using Offset = std::uint32_t;  ///< in down_ or up_, doubles
  struct Coupling {
    int block;
    int start;  ///< first position of the later block i
    int width;
    Offset down;  ///< L_ik = A_ik D_k^-1 (A_ik beside blocks too large to invert)
    Offset up;    ///< W_ki = D_k^-1 A_ki
  };
  struct Pivot {
    int block;
    int start;
    int width;
    int couplingBegin, couplingEnd;
    Offset up;  ///< D_k^-1, or its factors
    bool inverted() const;
  };
  /// Of a coupling, in values_.
  struct Place {
    std::size_t lower;  ///< A_ik
    std::size_t upper;  ///< A_ki
  };
  struct Update {
    std::size_t target;  ///< A_ij -= A_ik W_kj
    int i;               ///< coupling numbers
    int j;
  };
  /// Of a pivot.
  struct Elimination {
    std::size_t diagonal;  ///< in values_
    int updateBegin, updateEnd;
  };

  /// What solveNear() follows beside the couplings.
  struct Near {
    std::vector<int> begin, earlier;             ///< per pivot: those before it that couple to it
    mutable std::vector<std::uint64_t> reached;  ///< one bit per pivot, none between calls
  };

  /// Of two blocks of the cut, in values_ and in the inverse.
  struct CutBlock {
    std::size_t offset;
    int row, column;  ///< first positions
    int rows, columns;
  };
  void listCut(const BlockPattern& pattern, const std::map<std::pair<int, int>, std::size_t>& fill);
  int factorInterior(double smallest);
  int factorCut(int bad);

  int factorPivots(const std::vector<int>& pivots);
  void addToMeeting(std::size_t k);
  int factorMeeting();
  void downPivots(const std::vector<int>& pivots, double* x) const;
  void meet(const std::vector<int>& lastOfSweeps, double* x) const;
  void upPivots(const std::vector<int>& pivots, double* x) const;

  void pack();
  void eliminate(std::size_t k);
  void sweepDown(const Pivot& pivot, double* x) const;
  void sweepUp(const Pivot& pivot, double* x) const;
  void invertPivot(std::size_t k);
  void findEarlier();
  void order(const BlockPattern& pattern, std::vector<int>& sequence,
             std::vector<std::vector<int>>& later) const;

  std::vector<Pivot> pivots_;   ///< those of the interior, then the blocks of the cut
  std::size_t eliminated_ = 0;  ///< pivots of the interior
  std::vector<Coupling> couplings_;
  std::vector<Elimination> eliminations_;  ///< of pivots_
  std::vector<Place> places_;              ///< of couplings_
  std::vector<Update> updates_;
  std::vector<int> pivotOf_;  ///< of each block
  Near near_;
  BlockValues values_;
  BlockValues down_, up_;       ///< what the two sweeps of a solve read, in the order they read it
  BlockValues inverse_;         ///< allocated by the first invert()
  std::vector<char> inverted_;  ///< per pivot: taken along by invert()
  std::vector<double> scale_;
  std::vector<double> workScale_;
  mutable std::vector<double> work_;
  std::vector<double> panel_;
  std::vector<int> swaps_;
  std::unique_ptr<CutFactor> cut_;  ///< null where nothing is divided
  std::vector<CutBlock> cutBlocks_;
  int size_ = 0;
  std::size_t patternStorage_ = 0;
  bool far_ = false;  ///< sweeps read more than a near cache holds
  double solveWork_ = 0;
};

class BlockFactor::TwoSweeps {
 public:
  /// Of factors with hasTwoSweeps(), which must outlive the object.
  explicit TwoSweeps(BlockFactor& factor);

  /// First position of the block where the sweeps meet, and the position behind it.
  int meetingBegin() const { return factor_.pivots_.back().start; }
  int meetingEnd() const { return meetingBegin() + factor_.pivots_.back().width; }

  /// Factors the values of the blocks of one sweep (0 before the meeting, 1 behind it) and of the
  /// meeting. False: a pivot vanished.
  bool factorSweep(int sweep) { return factor_.factorPivots(pivots_[at(sweep)]) < 0; }
  /// What the meeting needs of a sweep, factored here, or for one that was factored elsewhere.
  std::size_t factorsLength(int sweep) const;
  void copyFactors(int sweep, double* to) const;
  void takeFactors(int sweep, const double* from);
  /// Before the sweeps: keeps the diagonal block of the meeting. After them: factors it.
  void keepMeeting();
  bool factorMeeting();

  /// The way down of a sweep; the meeting, once x has the positions of the last blocks of both; the
  /// way up.
  void down(int sweep, double* x) const;
  int lastBegin(int sweep) const { return last(sweep).start; }
  int lastWidth(int sweep) const { return last(sweep).width; }
  void meet(double* x) const { factor_.meet(lasts_, x); }
  void up(int sweep, double* x) const { factor_.upPivots(pivots_[at(sweep)], x); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Pivot& last(int sweep) const { return factor_.pivots_[at(pivots_[at(sweep)].back())]; }

  BlockFactor& factor_;
  std::vector<int> pivots_[2];  ///< of the sweeps, as they are eliminated
  std::vector<int> lasts_;      ///< the last of each, in the order of elimination
  std::vector<double> diagonal_;
};

}  // namespace tooljoint::linalg
