// SPDX-License-Identifier: BSD-3-Clause
#include "statics/DividedProblem.hpp"

#include <exception>

#include "common/Parallel.hpp"

namespace tooljoint::statics {
namespace {

/// Chains with fewer unknowns per rank than this are evaluated by all ranks alike.
constexpr int fewestRows = 700;

template <class Work>
std::exception_ptr errorOf(const Work& work) {
  try {
    work();
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

/// Throws, on all ranks, the error of the lowest rank that failed.
void throwAlike(const std::exception_ptr& error) {
  parallel::agree([&] {
    if (error) std::rethrow_exception(error);
  });
}

}  // namespace

std::unique_ptr<DividedProblem> DividedProblem::of(const model::NonlinearProblem& problem) {
  const auto* chain = dynamic_cast<const model::ChainProblem*>(&problem);
  if (chain == nullptr || parallel::size() == 1) return nullptr;
  auto first = chain->firstOfNodes();
  if (first.empty()) return nullptr;
  auto share = linalg::ChainShare::of(std::move(first), fewestRows);
  if (!share) return nullptr;
  return std::unique_ptr<DividedProblem>(new DividedProblem(*chain, std::move(share)));
}

void DividedProblem::residual(const Vector& x, Vector& r) const {
  const auto error = errorOf([&] { problem_.residualRows(x, share_->own(), r); });
  r.conservativeResize(size());
  if (share_->gather(r.data(), 1, error != nullptr)) throwAlike(error);
}

void DividedProblem::jacobianRows(const Vector& x, Sparse& J) const {
  const auto error = errorOf([&] { problem_.jacobianRows(x, share_->around(), J); });
  if (share_->any(error != nullptr)) throwAlike(error);
}

}  // namespace tooljoint::statics
