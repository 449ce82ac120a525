// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// LU of a block-sparse matrix with partial pivoting inside diagonal blocks. Order and fill are
/// found once; factor() and solve() do not allocate. Blocks of least work are eliminated first. So
/// a chain becomes a block-tridiagonal sweep from both ends, modes that couple only to two nodes
/// are eliminated before the sweep, and a loop or a star costs its own small fill. Any other graph
/// is factored correctly too.
///
/// If the matrix is divided among ranks (RankCut), each rank eliminates its interior. The Schur
/// complement at the cut is summed over the ranks and factored by all of them. factor() and the
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

  /// Values to set before factor(), in the layout of the pattern (BlockPattern::storage() doubles).
  double* values() { return values_.data(); }

  /// A pivot below this part of the size of its row has vanished.
  static constexpr double vanished = 1e-14;
  /// Factors the matrix in values(), which is overwritten. Returns -1, or the position of the dof
  /// whose pivot vanished (the number of positions if it vanished on another rank). After a failure
  /// the factors are unusable.
  int factor(double smallest = vanished);

  /// x := A^-1 x, in positions.
  void solve(double* x) const;

  /// For a chain: the blocks before the last eliminated one, and those after it, form two sweeps
  /// that meet there and are independent before. Two processes may compute one each; factors and
  /// solutions are bitwise equal to those of factor() and solve().
  class TwoSweeps;
  bool hasTwoSweeps() const;

  /// The same for an x that is zero outside the blocks `live` (in any order, repetitions allowed).
  /// Entries below `small` in units of `weight` (forces in the forward sweep, displacements in the
  /// backward sweep) are dropped, so the cost is that of the blocks reached by a local force: a few
  /// neighbours in a stiff chain. Afterwards `live` lists the nonzero blocks of x, each once.
  void solveNear(double* x, std::vector<int>& live, const double* weight, double small) const;

  /// Blocks of A^-1 on the pattern, for the diagonal blocks selected by `wanted` (and all blocks
  /// these need), by the recursion of Takahashi, Fagan and Chen (1973), which stays within the
  /// fill. Call after factor(); the cost is about the same.
  ///
  ///     Z_Lk = -Z_LL A_Lk D_k^-1,   Z_kL = -W_kL Z_LL,   Z_kk = D_k^-1 - W_kL Z_Lk
  void invert(const std::vector<char>& wanted);
  /// Allocates the memory of the first invert().
  void reserveInverse();
  /// Values of the last invert(), in the layout of the pattern.
  const double* inverse() const { return inverse_.data(); }

  /// Multiplications of one solve, the measure of cost per step.
  double solveWork() const { return solveWork_; }
  /// Doubles of fill beyond the pattern.
  std::size_t fill() const { return values_.size() - patternStorage_; }

 private:
  // The indices that solve() reads are separate from those of factor() and invert(), and short:
  // with blocks of six they are a tenth of all data read.
  using Offset = std::uint32_t;  ///< doubles, in down_ or up_
  struct Coupling {
    int block;
    int start;  ///< first position of the later block i
    int width;
    Offset down;  ///< L_ik = A_ik D_k^-1 (A_ik for blocks too large to invert)
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
  /// Offsets of a coupling in values_.
  struct Place {
    std::size_t lower;  ///< A_ik
    std::size_t upper;  ///< A_ki
  };
  struct Update {
    std::size_t target;  ///< A_ij -= A_ik W_kj
    int i;               ///< coupling numbers
    int j;
  };
  /// Data of a pivot for factor().
  struct Elimination {
    std::size_t diagonal;  ///< in values_
    int updateBegin, updateEnd;
  };

  /// Data of solveNear() besides the couplings.
  struct Near {
    std::vector<int> begin, earlier;             ///< per pivot: earlier ones that couple to it
    mutable std::vector<std::uint64_t> reached;  ///< one bit per pivot, cleared between calls
  };

  /// A pair of blocks of the cut, in values_ and in the inverse.
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

  std::vector<Pivot> pivots_;   ///< interior, then the blocks of the cut
  std::size_t eliminated_ = 0;  ///< pivots of the interior
  std::vector<Coupling> couplings_;
  std::vector<Elimination> eliminations_;  ///< of pivots_
  std::vector<Place> places_;              ///< of couplings_
  std::vector<Update> updates_;
  std::vector<int> pivotOf_;  ///< of each block
  Near near_;
  BlockValues values_;
  BlockValues down_, up_;       ///< data of the two sweeps of a solve, in reading order
  BlockValues inverse_;         ///< allocated by the first invert()
  std::vector<char> inverted_;  ///< per pivot: included in invert()
  std::vector<double> scale_;
  std::vector<double> workScale_;
  mutable std::vector<double> work_;
  std::vector<double> panel_;
  std::vector<int> swaps_;
  std::unique_ptr<CutFactor> cut_;  ///< null if not divided
  std::vector<CutBlock> cutBlocks_;
  int size_ = 0;
  std::size_t patternStorage_ = 0;
  bool far_ = false;  ///< the sweeps exceed a near cache
  double solveWork_ = 0;
};

class BlockFactor::TwoSweeps {
 public:
  /// For factors with hasTwoSweeps(), which must outlive the object.
  explicit TwoSweeps(BlockFactor& factor);

  /// First position of the block where the sweeps meet, and the position after it.
  int meetingBegin() const { return factor_.pivots_.back().start; }
  int meetingEnd() const { return meetingBegin() + factor_.pivots_.back().width; }

  /// Factors the values of the blocks of one sweep (0 before the meeting block, 1 after it) and
  /// their contribution to the meeting block. False if a pivot vanishes.
  bool factorSweep(int sweep) { return factor_.factorPivots(pivots_[at(sweep)]) < 0; }
  /// Data of a sweep for the meeting block: of one factored here, or from another process.
  std::size_t factorsLength(int sweep) const;
  void copyFactors(int sweep, double* to) const;
  void takeFactors(int sweep, const double* from);
  /// Before the sweeps: stores the diagonal block of the meeting. After them: factors it.
  void keepMeeting();
  bool factorMeeting();

  /// Forward sweep; solution at the meeting block, once x has the positions of the last blocks of
  /// both sweeps; backward sweep.
  void down(int sweep, double* x) const;
  int lastBegin(int sweep) const { return last(sweep).start; }
  int lastWidth(int sweep) const { return last(sweep).width; }
  void meet(double* x) const { factor_.meet(lasts_, x); }
  void up(int sweep, double* x) const { factor_.upPivots(pivots_[at(sweep)], x); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Pivot& last(int sweep) const { return factor_.pivots_[at(pivots_[at(sweep)].back())]; }

  BlockFactor& factor_;
  std::vector<int> pivots_[2];  ///< of each sweep, in elimination order
  std::vector<int> lasts_;      ///< last pivot of each, in elimination order
  std::vector<double> diagonal_;
};

}  // namespace tooljoint::linalg
