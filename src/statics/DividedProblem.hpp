// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A chain problem whose rows are evaluated by several ranks, each its own; unknowns and residuals
/// are whole and alike on all of them, so that every rank takes the same decisions.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "linalg/blocks/ChainShare.hpp"
#include "model/NonlinearProblem.hpp"

namespace tooljoint::statics {

class DividedProblem final : public model::NonlinearProblem {
 public:
  /// Null on one rank, where the problem is no chain, and where it is too short to divide. The same
  /// decision on all ranks of parallel::communicator(), which all have the same problem.
  static std::unique_ptr<DividedProblem> of(const model::NonlinearProblem& problem);

  int size() const override { return problem_.size(); }
  /// Bit by bit as on one rank. Collective; what the problem throws on one of the ranks is thrown
  /// on all.
  void residual(const Vector& x, Vector& r) const override;
  /// The whole of it, by every rank alike.
  void jacobian(const Vector& x, Sparse& J) const override { problem_.jacobian(x, J); }
  /// The rows share().around(). Collective; errors as those of residual().
  void jacobianRows(const Vector& x, Sparse& J) const;
  Vector residualScale() const override { return problem_.residualScale(); }
  double stepLimit(const Vector& x, const Vector& dx) const override {
    return problem_.stepLimit(x, dx);
  }
  Vector moved(const Vector& x, const Vector& dx, double s) const override {
    return problem_.moved(x, dx, s);
  }
  std::string unknownName(int i) const override { return problem_.unknownName(i); }

  const linalg::ChainShare& share() const { return *share_; }
  const std::shared_ptr<const linalg::ChainShare>& sharedShare() const { return share_; }

 private:
  DividedProblem(const model::ChainProblem& problem,
                 std::shared_ptr<const linalg::ChainShare> share)
      : problem_(problem), share_(std::move(share)) {}

  const model::ChainProblem& problem_;
  std::shared_ptr<const linalg::ChainShare> share_;
};

}  // namespace tooljoint::statics
