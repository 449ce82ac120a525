// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A chain problem with its rows divided among ranks. Unknowns and residuals are complete and equal
/// on all ranks, so that every rank takes the same decisions.
#pragma once

#include <memory>
#include <utility>

#include "linalg/chains/ChainShare.hpp"
#include "model/NonlinearProblem.hpp"

namespace tooljoint::statics {

class DividedProblem final : public model::InUnknownsOf<model::NonlinearProblem> {
 public:
  /// Null on one rank, if the problem is no chain, and if it is too short to divide. The same
  /// decision on all ranks of parallel::communicator(), which all have the same problem.
  static std::unique_ptr<DividedProblem> of(const model::NonlinearProblem& problem);

  /// Bitwise as on one rank. Collective; an error of the problem on one rank is thrown on all.
  void residual(const Vector& x, Vector& r) const override;
  /// The whole matrix, by every rank alike.
  void jacobian(const Vector& x, Sparse& J) const override { problem_.jacobian(x, J); }
  /// The rows share().around(). Collective; errors as in residual().
  void jacobianRows(const Vector& x, Sparse& J) const;
  const linalg::ChainShare& share() const { return *share_; }
  const std::shared_ptr<const linalg::ChainShare>& sharedShare() const { return share_; }

 private:
  DividedProblem(const model::ChainProblem& problem,
                 std::shared_ptr<const linalg::ChainShare> share)
      : InUnknownsOf(problem), problem_(problem), share_(std::move(share)) {}

  const model::ChainProblem& problem_;
  std::shared_ptr<const linalg::ChainShare> share_;
};

}  // namespace tooljoint::statics
