// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/FixedInterfaceModes.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"

namespace tooljoint::reduction {

namespace {

/// Modes beyond the requested ones show where the last pair ends: their first number, and, if they
/// all form one pair, more as a fraction of the computed ones.
constexpr int guard = 4, guardShare = 4;

/// Number of modes of an interior block (less than its dofs if some have no mass), and number of
/// computed modes.
struct Progress {
  int available = 0;
  int computed = 0;
};

/// Computes modes of one block. Dofs without mass are static: the finite modes and the constraint
/// modes represent every motion of the others.
linalg::EigenPairs solve(const PartView& part, int number, const ModeRequest& request, int count,
                         Progress& progress) {
  const InteriorBlock& block = part.interiorBlock(number);
  linalg::EigenOptions options = request.eigen ? *request.eigen : linalg::EigenOptions();
  options.name = block.name;
  options.stiffness = part.sharedFactors(number);
  const Sparse &K = block.symmetricStiffness, &M = block.mass;
  const bool below = request.kind == ModeRequest::Kind::Below;
  if (linalg::hasMasslessMotion(M)) {
    const int asked = below ? progress.available : std::min(count, progress.available);
    auto pairs = linalg::semidefiniteModes(K, M, asked, options);
    if (pairs.count() < asked) progress.available = pairs.count();
    return pairs;
  }
  if (below)
    return linalg::lowestModesBelow(K, M, request.omegaMax * (1.0 + 2.0 * request.pairTolerance),
                                    options);
  return linalg::lowestModes(K, M, std::min(count, progress.available), options);
}

void append(InteriorVectors& result, const InteriorBlock& block, int number,
            const linalg::EigenPairs& pairs) {
  const auto floating = linalg::areRounding(pairs.values, pairs.vectors, block.symmetricStiffness);
  for (int k = 0; k < pairs.count(); ++k) {
    ModalVector mode{pairs.values[k], number, pairs.vectors.col(k), pairs.residuals[k],
                     "fixed-interface"};
    mode.floating = floating[at(k)] != 0;
    if (mode.floating) mode.why = "requested; rigid-body motion";
    if (mode.shown() < 0.0)
      mode.why = "requested; the part is buckled with its boundary dofs fixed";
    result.vectors.push_back(std::move(mode));
  }
  result.orthogonality = std::max(result.orthogonality, pairs.orthogonality);
  std::string method =
      pairs.method.substr(0, pairs.method.find_first_of(",("));  // without shift and block sizes
  while (!method.empty() && method.back() == ' ') method.pop_back();
  if (result.method.find(method) == std::string::npos)
    result.method += (result.method.empty() ? "" : ", ") + method;
  count("modes computed", pairs.count());
}

/// Number of modes for the request; -1 when more must be computed to decide.
int decide(const InteriorVectors& result, const ModeRequest& request) {
  const Vector eigenvalues = result.eigenvalues();
  const int available = sizeOf(eigenvalues);
  if (request.kind == ModeRequest::Kind::All) return available;
  int wanted = request.count;
  if (request.kind == ModeRequest::Kind::Below) {
    wanted = 0;
    while (wanted < available && signedOmega(eigenvalues[wanted]) <= request.omegaMax) ++wanted;
  }
  const int kept = roundUp(eigenvalues, wanted, request.pairTolerance);
  if (request.kind == ModeRequest::Kind::Count && kept > 0 && kept + 2 > available &&
      !result.complete)
    return -1;
  return kept;
}

}  // namespace

InteriorVectors fixedInterfaceModes(const PartView& part, const ModeRequest& request,
                                    const std::string& what) {
  return fixedInterfaceModes(part, request, range(part.blocks()), what);
}

InteriorVectors fixedInterfaceModes(const PartView& part, const ModeRequest& request,
                                    const std::vector<int>& blocks, const std::string& what) {
  const Stage stage("modes of the parts");
  InteriorVectors result;
  result.groups = part.blockPositions();
  result.removable = true;
  const int interior = sizeOf(part.partition().interior);
  std::vector<Progress> progress(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i)
    progress[i].available = part.interiorBlock(blocks[i]).size();
  int perBlock = request.kind == ModeRequest::Kind::All ? std::numeric_limits<int>::max()
                                                        : std::min(request.count, interior) + guard;
  if (request.kind == ModeRequest::Kind::Count && request.count == 0) perBlock = 0;

  for (result.kept = -1; result.kept < 0;) {
    result.vectors.clear();
    result.orthogonality = 0;
    result.method.clear();
    result.complete = true;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      try {
        if (perBlock > 0 || request.kind == ModeRequest::Kind::Below) {
          const auto pairs = solve(part, blocks[i], request, perBlock, progress[i]);
          progress[i].computed = pairs.count();
          append(result, part.interiorBlock(blocks[i]), blocks[i], pairs);
        }
      } catch (const Error& error) {
        part.fail(what, error);
      }
      result.complete = result.complete && progress[i].computed == progress[i].available;
    }
    result.keepAll();
    result.kept = decide(result, request);
    if (perBlock < interior) perBlock += std::max(guard, perBlock / guardShare);
  }
  for (int k = 0; k < sizeOf(result.vectors); ++k)
    result.vectors[at(k)].name = "mode " + std::to_string(k + 1);
  result.remarkOnCount(request, interior);
  return result;
}

}  // namespace tooljoint::reduction
