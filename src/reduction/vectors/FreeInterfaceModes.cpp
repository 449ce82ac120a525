// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/FreeInterfaceModes.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"
#include "reduction/methods/ReductionMethod.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"

namespace tooljoint::reduction {

namespace {

/// Energy below this fraction of |phi|' |K| |phi| is none (as in BasisChecks), and forces below
/// that fraction of |K| |phi| are none.
constexpr double noEnergy = 1e-12;
constexpr double noForce = 1e-7;
/// Modes looked at for rigid-body modes at least.
constexpr int lookedAt = 8;

Vector embed(const FreeInterfaceMode& mode, const std::vector<int>& link, Eigen::Index size) {
  Vector whole = Vector::Zero(size);
  for (std::size_t i = 0; i < link.size(); ++i)
    whole[link[i]] = mode.shape[static_cast<Eigen::Index>(i)];
  return whole;
}

void findRigid(const Sparse& K, FreeInterfaceModes& result) {
  const Sparse absolute = K.cwiseAbs(), transposed = K.transpose();
  for (auto& mode : result.modes) {
    const Vector phi = embed(mode, result.links[at(mode.link)], K.rows());
    const Vector size = phi.cwiseAbs(), force = absolute * size;
    if (std::abs(mode.eigenvalue) > noEnergy * size.dot(force)) continue;
    const double scale = noForce * force.norm();
    mode.rigid = (K * phi).norm() <= scale && (transposed * phi).norm() <= scale;
    result.rigid += mode.rigid ? 1 : 0;
  }
}

FixedInterfaceModes solve(const model::Substructure& part, const Partition& p, const Sparse& K,
                          const ModeRequest& request) {
  FixedInterfaceModes found = fixedInterfaceModes(part, p, K, request, "free-interface modes");
  if (request.kind != ModeRequest::Kind::Below || found.complete ||
      static_cast<int>(found.modes.size()) >= lookedAt)
    return found;
  ModeRequest few = request;  // so low a cut-off that rigid-body modes may lie above it
  few.kind = ModeRequest::Kind::Count;
  few.count = lookedAt;
  const int wanted = found.kept;
  found = fixedInterfaceModes(part, p, K, few, "free-interface modes");
  found.kept = wanted;
  return found;
}

}  // namespace

Matrix FreeInterfaceModes::shapes(int link, std::vector<int>& numbers) const {
  numbers.clear();
  for (int k = 0; k < kept; ++k)
    if (modes[at(k)].link == link) numbers.push_back(k);
  Matrix columns(static_cast<Eigen::Index>(links[at(link)].size()),
                 static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t j = 0; j < numbers.size(); ++j)
    columns.col(static_cast<Eigen::Index>(j)) = modes[at(numbers[j])].shape;
  return columns;
}

Matrix FreeInterfaceModes::columns(int count, int size) const {
  Matrix all(size, count);
  for (int k = 0; k < count; ++k)
    all.col(k) = embed(modes[at(k)], links[at(modes[at(k)].link)], size);
  return all;
}

FreeInterfaceModes freeInterfaceModes(const model::Substructure& part, const Sparse& K,
                                      const ModeRequest& request) {
  model::Substructure free = part;
  free.interface.clear();
  free.retained.clear();
  const Partition p = partition(free);
  ModeRequest enough = request;
  if (request.kind == ModeRequest::Kind::Count) enough.count = std::max(request.count, lookedAt);
  FixedInterfaceModes found = solve(free, p, symmetricPart(K), enough);

  FreeInterfaceModes result;
  result.links = p.links;  // all dofs are interior: indices are positions
  result.complete = found.complete;
  result.orthogonality = found.orthogonality;
  result.method = found.method;
  Vector eigenvalues(static_cast<Eigen::Index>(found.modes.size()));
  for (auto& mode : found.modes) {
    eigenvalues[static_cast<Eigen::Index>(result.modes.size())] = mode.eigenvalue;
    result.modes.push_back(
        {mode.eigenvalue, mode.link, std::move(mode.shape), mode.residual, false, mode.floating});
  }
  findRigid(K, result);
  const int available = static_cast<int>(result.modes.size());
  result.kept = found.kept;
  if (request.kind == ModeRequest::Kind::Count) {
    result.kept =
        enough.count == request.count
            ? found.kept
            : roundUp(eigenvalues, std::min(request.count, available), request.pairTolerance);
    if (request.count > available && result.complete)
      result.remarks.push_back("asked for " + std::to_string(request.count) + " modes, kept all " +
                               std::to_string(available) + " there are");
    else if (result.kept > request.count)
      result.remarks.push_back("asked for " + std::to_string(request.count) + " modes, kept " +
                               std::to_string(result.kept) + " so as not to cut a close pair");
  }
  int last = available;
  while (last > 0 && !result.modes[at(last - 1)].rigid) --last;
  if (last > result.kept) {
    result.remarks.assign(1, "kept " + std::to_string(last) + " modes so as to have all " +
                                 std::to_string(result.rigid) + " rigid-body modes");
    result.kept = last;
  }
  return result;
}

void report(const FreeInterfaceModes& modes, Basis& basis) {
  basis.candidates.resize(static_cast<Eigen::Index>(modes.modes.size()));
  for (int k = 0; k < static_cast<int>(modes.modes.size()); ++k) {
    const FreeInterfaceMode& mode = modes.modes[at(k)];
    BasisRow row;
    row.kind = mode.rigid ? "rigid-body" : "free-interface";
    row.name = "mode " + std::to_string(k + 1);
    row.eigenvalue = mode.rigid || mode.floating ? 0.0 : mode.eigenvalue;
    row.residual = mode.residual;
    row.kept = k < modes.kept;
    row.why = !row.kept    ? "above the cut"
              : mode.rigid ? "rigid-body motion"
              : mode.eigenvalue < 0.0 && !mode.floating
                  ? "asked for; the part buckles with nothing held"
                  : "asked for";
    basis.rows.push_back(row);
    basis.candidates[k] = mode.eigenvalue;
  }
  basis.complete = modes.complete;
  basis.method = modes.method;
  basis.remarks.insert(basis.remarks.end(), modes.remarks.begin(), modes.remarks.end());
  if (modes.rigid > 0)
    basis.remarks.push_back("the free part has " + std::to_string(modes.rigid) +
                            " rigid-body mode" + (modes.rigid > 1 ? "s" : "") + ", kept exactly");
}

}  // namespace tooljoint::reduction
