// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/FixedInterfaceModes.hpp"

#include <algorithm>
#include <limits>

#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"

namespace tooljoint::reduction {

namespace {

/// The pencil of one link, and how many of its modes were computed.
struct Link {
  Sparse K;
  Sparse M;
  int size = 0;  ///< modes it has: dofs, or fewer where some have no mass
  linalg::DofNamer name;
  int computed = 0;
};

/// Modes asked of one link. Two more than wanted show whether the cut would part a pair. Dofs
/// without mass follow statically: the finite modes and the constraint modes hold every motion of
/// the others.
linalg::EigenPairs solve(Link& link, const ModeRequest& request, int count) {
  linalg::EigenOptions options = request.eigen ? *request.eigen : linalg::EigenOptions();
  options.name = link.name;
  if (linalg::hasMasslessDofs(link.M)) {
    const int asked =
        request.kind == ModeRequest::Kind::Below ? link.size : std::min(count, link.size);
    auto pairs = linalg::semidefiniteModes(link.K, link.M, asked, options);
    if (pairs.count() < asked) link.size = pairs.count();
    return pairs;
  }
  if (request.kind == ModeRequest::Kind::Below)
    return linalg::lowestModesBelow(
        link.K, link.M, request.omegaMax * (1.0 + 2.0 * request.pairTolerance), options);
  return linalg::lowestModes(link.K, link.M, std::min(count, link.size), options);
}

void append(FixedInterfaceModes& result, Link& link, int index, const linalg::EigenPairs& pairs) {
  link.computed = static_cast<int>(pairs.values.size());
  const auto floating = linalg::areRounding(pairs.values, pairs.vectors, link.K);
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k)
    result.modes.push_back({pairs.values[k], index, pairs.vectors.col(k), pairs.residuals[k],
                            floating[static_cast<std::size_t>(k)] != 0});
  result.orthogonality = std::max(result.orthogonality, pairs.orthogonality);
  std::string method =
      pairs.method.substr(0, pairs.method.find_first_of(",("));  // without shift and block sizes
  while (!method.empty() && method.back() == ' ') method.pop_back();
  if (result.method.find(method) == std::string::npos)
    result.method += (result.method.empty() ? "" : ", ") + method;
  count("modes computed", static_cast<long>(pairs.values.size()));
}

/// Number of modes that answer the request; -1 when more must be computed to decide.
int decide(const FixedInterfaceModes& result, const ModeRequest& request) {
  Vector eigenvalues(static_cast<Eigen::Index>(result.modes.size()));
  for (std::size_t k = 0; k < result.modes.size(); ++k)
    eigenvalues[static_cast<Eigen::Index>(k)] = result.modes[k].eigenvalue;
  const int available = static_cast<int>(eigenvalues.size());
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

void remark(FixedInterfaceModes& result, const ModeRequest& request, int interior) {
  if (request.kind != ModeRequest::Kind::Count) return;
  if (request.count > interior)
    result.remarks.push_back("asked for " + std::to_string(request.count) + " modes, kept all " +
                             std::to_string(interior) + " there are");
  else if (result.kept > request.count)
    result.remarks.push_back("asked for " + std::to_string(request.count) + " modes, kept " +
                             std::to_string(result.kept) + " so as not to cut a close pair");
}

}  // namespace

FixedInterfaceModes fixedInterfaceModes(const model::Substructure& part, const Partition& p,
                                        const Sparse& symmetricK, const ModeRequest& request,
                                        const std::string& kind) {
  const Stage stage("modes of the parts");
  FixedInterfaceModes result;
  const int interior = static_cast<int>(p.interior.size());
  std::vector<Link> links;
  for (const auto& members : p.links) {
    std::vector<int> inner;
    for (int i : members) inner.push_back(p.interior[static_cast<std::size_t>(i)]);
    links.push_back({block(symmetricK, inner, inner), block(part.model.mass, inner, inner),
                     static_cast<int>(inner.size()),
                     [&part, inner](int i) {
                       const auto position =
                           static_cast<std::size_t>(inner[static_cast<std::size_t>(i)]);
                       return model::describe(part.model.dofs[position], part.model.componentNames);
                     },
                     0});
  }
  int perLink = request.kind == ModeRequest::Kind::All ? std::numeric_limits<int>::max()
                                                       : std::min(request.count, interior) + 2;
  if (request.kind == ModeRequest::Kind::Count && request.count == 0) perLink = 0;

  for (result.kept = -1; result.kept < 0;) {
    result.modes.clear();
    result.orthogonality = 0;
    result.method.clear();
    result.complete = true;
    for (std::size_t i = 0; i < links.size(); ++i) {
      try {
        if (perLink > 0 || request.kind == ModeRequest::Kind::Below)
          append(result, links[i], static_cast<int>(i), solve(links[i], request, perLink));
      } catch (const Error& error) {
        const std::string sentence = "Part \"" + part.name + "\", " + kind + ": " + error.what();
        if (error.code() == ExitCode::NotConverged) throw ConvergenceError(sentence);
        throw ModelError(sentence);
      }
      result.complete = result.complete && links[i].computed == links[i].size;
    }
    std::stable_sort(result.modes.begin(), result.modes.end(),
                     [](const FixedInterfaceMode& a, const FixedInterfaceMode& b) {
                       return a.eigenvalue < b.eigenvalue;
                     });
    result.kept = decide(result, request);
    perLink = perLink < interior ? 2 * perLink : perLink;
  }
  remark(result, request, interior);
  return result;
}

}  // namespace tooljoint::reduction
