// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/FreeInterfaceModes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/Index.hpp"
#include "reduction/ReductionMethod.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"

namespace tooljoint::reduction {

namespace {

/// Energy below this fraction of |phi|' |K| |phi| is zero (as in BasisChecks), and so are forces
/// below that fraction of |K| |phi|.
constexpr double noEnergy = 1e-12;
constexpr double noForce = 1e-7;
/// Smallest number of modes in the search for rigid-body modes.
constexpr int lookedAt = 8;
const std::string what = "free-interface modes";

/// Finds the rigid-body modes and names all modes.
void classify(const Sparse& K, InteriorVectors& result) {
  const Sparse absolute = K.cwiseAbs(), transposed = K.transpose();
  for (int k = 0; k < sizeOf(result.vectors); ++k) {
    ModalVector& mode = result.vectors[at(k)];
    const Vector phi = result.columns({k}, static_cast<int>(K.rows())), size = phi.cwiseAbs(),
                 force = absolute * size;
    if (std::abs(mode.eigenvalue) <= noEnergy * size.dot(force)) {
      const double scale = noForce * force.norm();
      mode.rigid = (K * phi).norm() <= scale && (transposed * phi).norm() <= scale;
    }
    mode.kind = mode.rigid ? "rigid-body" : "free-interface";
    mode.why = mode.rigid           ? "rigid-body motion"
               : mode.shown() < 0.0 ? "requested; the free part is buckled"
                                    : "as requested";
  }
}

InteriorVectors solve(const PartView& free, const ModeRequest& request) {
  InteriorVectors found = fixedInterfaceModes(free, request, what);
  if (request.kind != ModeRequest::Kind::Below || found.complete ||
      sizeOf(found.vectors) >= lookedAt)
    return found;
  ModeRequest few = request;  // with such a low cut-off that rigid-body modes may lie above it
  few.kind = ModeRequest::Kind::Count;
  few.count = lookedAt;
  const int wanted = found.kept;
  found = fixedInterfaceModes(free, few, what);
  found.kept = wanted;
  return found;
}

}  // namespace

InteriorVectors freeInterfaceModes(const PartView& part, const ModeRequest& request) {
  ModeRequest enough = request;
  if (request.kind == ModeRequest::Kind::Count) enough.count = std::max(request.count, lookedAt);
  InteriorVectors found = solve(part.unsupported(), enough);
  found.remarks.clear();  // they refer to the computed number
  classify(part.stiffness(), found);
  const int available = sizeOf(found.vectors);
  if (request.kind == ModeRequest::Kind::Count && enough.count != request.count)
    found.kept =
        roundUp(found.eigenvalues(), std::min(request.count, available), request.pairTolerance);
  found.remarkOnCount(request, found.complete ? available : std::max(available, request.count));
  int last = available;
  while (last > 0 && !found.vectors[at(last - 1)].rigid) --last;
  if (last > found.kept) {
    found.remarks.assign(1, "kept " + std::to_string(last) + " modes to include all " +
                                std::to_string(found.rigid()) + " rigid-body modes");
    found.kept = last;
  }
  if (const int rigid = found.rigid(); rigid > 0)
    found.remarks.push_back("the free part has " + std::to_string(rigid) + " rigid-body mode" +
                            (rigid > 1 ? "s" : "") + ", kept exactly");
  return found;
}

}  // namespace tooljoint::reduction
