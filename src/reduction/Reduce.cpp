// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/Reduce.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "model/DofNames.hpp"
#include "reduction/CollectiveMethod.hpp"
#include "reduction/MasslessDofs.hpp"
#include "reduction/methods/WholePart.hpp"
#include "reduction/project/BasisChecks.hpp"
#include "reduction/project/Distribution.hpp"
#include "reduction/project/IdenticalParts.hpp"
#include "reduction/project/Projection.hpp"
#include "reduction/project/ReducedModels.hpp"
#include "reduction/selection/InterfaceCriteria.hpp"

namespace tooljoint::reduction {

namespace {

using constants::twoPi;
/// Modes of the first attempt with an interface criterion.
constexpr int firstCandidates = 12;

/// Number of modal columns with omega^2 < 0 beyond rounding; a rigid-body motion is at rounding.
int buckledModes(const PartView& part, const Basis& basis) {
  const auto modes = basis.eigenvalues.size();
  if ((basis.eigenvalues.array() < 0).count() == 0) return 0;
  const Eigen::Index first = basis.vectors.cols() - basis.forces() - modes;
  const Matrix shapes = Matrix(basis.vectors).middleCols(first, modes);
  const Matrix inertia = part.mass() * shapes;
  const Vector energies =
      basis.eigenvalues.cwiseProduct(shapes.cwiseProduct(inertia).colwise().sum().transpose());
  const auto rounding = linalg::areRounding(energies, shapes, part.symmetricStiffness());
  int buckled = 0;
  for (Eigen::Index k = 0; k < modes; ++k)
    buckled += basis.eigenvalues[k] < 0 && !rounding[at(k)] ? 1 : 0;
  return buckled;
}

ReducedCore makeCore(const PartView& part, Basis made, const ReductionOptions& options) {
  ReducedCore core;
  core.basis = std::move(made);
  const Basis& basis = core.basis;
  part.releaseFactors();
  {
    const Stage stage("projection");
    core.matrices = projectMatrices(part, basis);
  }
  BasisReport& report = core.report;
  report.part = part.part().name;
  report.basis = options.basis;
  report.method = basis.method;
  report.interface = sizeOf(basis.partition.interface) + basis.forces();
  report.retained = sizeOf(basis.partition.retained);
  report.interior = sizeOf(basis.partition.interior) - basis.forces();
  report.modes = basis.modes();
  report.negativeModes = buckledModes(part, basis);
  std::vector<BasisRow> rows = std::move(core.basis.rows);
  core.basis.rows.clear();
  report.orthogonality = basis.orthogonality;
  report.massDefect = core.matrices.massDefect;
  report.stiffnessDefect = core.matrices.stiffnessDefect;
  report.structureEnforced = core.matrices.structureEnforced;
  report.remarks = basis.remarks;
  for (int j = 0; j < sizeOf(rows); ++j) {
    if (rows[at(j)].kind != "constraint") continue;
    const double mass = core.matrices.mass.coeff(j, j);
    rows[at(j)].eigenvalue = mass > 0 ? core.matrices.constantStiffness.coeff(j, j) / mass : 0;
  }
  report.rows = std::make_shared<const std::vector<BasisRow>>(std::move(rows));
  if (basis.orthonormal && !report.structureEnforced && report.modes > 0)
    report.remarks.push_back(
        "the modes are not orthonormal to 1e-10; the projected matrices are not cleaned");
  if (options.checks) checkBasis(part, basis, core.matrices, report);
  count("parts reduced");
  return core;
}

std::vector<ModeRequest> initialRequests(const std::vector<model::Substructure>& parts,
                                         const ReductionOptions& options) {
  const ModeRule& rule = options.modes;
  double interior = 0;
  if (rule.kind == ModeRule::Kind::Total)
    for (const auto& part : parts) interior += static_cast<double>(part.interior().size());
  std::vector<ModeRequest> requests(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    ModeRequest& request = requests[p];
    request.pairTolerance = rule.pairTolerance;
    request.eigen = options.eigen;
    switch (rule.kind) {
      case ModeRule::Kind::PerPart:
        request.count = rule.counts.size() == 1 ? rule.counts.front() : rule.counts.at(p);
        request.kind =
            request.count == ModeRule::whole ? ModeRequest::Kind::Whole : ModeRequest::Kind::Count;
        break;
      case ModeRule::Kind::Total: {
        // The part's share by size, with a margin; repeated with more modes if it is too small.
        const double share =
            interior > 0 ? static_cast<double>(parts[p].interior().size()) / interior : 0.0;
        request.kind = ModeRequest::Kind::Count;
        request.count = static_cast<int>(std::ceil(1.25 * share * rule.total)) + 6;
        break;
      }
      case ModeRule::Kind::CutOff:
        request.kind = ModeRequest::Kind::Below;
        request.omegaMax = twoPi * rule.cutOffHz;
        break;
      case ModeRule::Kind::All:
        request.kind = ModeRequest::Kind::All;
        break;
      case ModeRule::Kind::InterfaceMass:
      case ModeRule::Kind::InterfaceMoment:
        // Doubled until the modes reach the fraction.
        request.kind = ModeRequest::Kind::Count;
        request.count = firstCandidates;
        break;
      case ModeRule::Kind::Tolerance:
        throw DeckError(
            "\"Frequency Tolerance\" and \"Motion Tolerance\" need the coupled model: use "
            "`tooljoint run`, `tooljoint modes` or estimate::synthesise. Here, give \"Modes\" or "
            "\"Cut-off Frequency\".");
    }
  }
  return requests;
}

/// First part with the same matrices and the same request.
std::vector<int> identicalParts(const std::vector<int>& classes,
                                const std::vector<ModeRequest>& requests) {
  std::vector<int> representative(classes.size());
  std::map<int, std::vector<int>> firsts;  // of each class, one per request
  for (std::size_t p = 0; p < classes.size(); ++p) {
    auto& candidates = firsts[classes[p]];
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](int q) {
      return requests[static_cast<std::size_t>(q)] == requests[p];
    });
    representative[p] = found != candidates.end() ? *found : static_cast<int>(p);
    if (found == candidates.end()) candidates.push_back(representative[p]);
  }
  return representative;
}

/// Rejects loads on interior dofs without mass and stiffness. No basis contains such dofs, even
/// with dampers, so their loads would be lost.
void refuseLostLoads(const model::Substructure& part) {
  auto undamped = part.model;
  undamped.damping.clear();
  const auto loaded = undamped.loadsOnNothing();
  if (loaded.empty()) return;
  const auto interior = part.interior();
  for (int i : loaded)
    if (std::binary_search(interior.begin(), interior.end(), i))
      throw ModelError("Part \"" + part.name + "\": a load acts on " +
                       model::dofName(part.model, i) +
                       ", an interior dof with neither mass nor stiffness, which no basis holds. "
                       "Retain or fix the dof, give it mass or stiffness, or remove the load.");
}

/// checkPart for the first of identical parts; for the others only the data that may differ.
void checkParts(const std::vector<model::Substructure>& parts, const std::vector<int>& classes) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& m = parts[p].model;
    const auto fits = [&](const Vector& x) {
      return x.size() == m.size() && std::isfinite(x.sum());
    };
    bool good = classes[p] != static_cast<int>(p) && static_cast<int>(m.dofs.size()) == m.size() &&
                m.points.empty() && (parts[p].reference.size() == 0 || fits(parts[p].reference)) &&
                fits(m.initialDisplacement) && fits(m.initialVelocity);
    for (const auto& load : m.loads)
      good =
          good && fits(load.vector) && load.law >= 0 && load.law < static_cast<int>(m.laws.size());
    if (!good) checkPart(parts[p]);
    refuseLostLoads(parts[p]);
  }
}

/// The views of these parts in a cache.
const std::vector<PartView>& viewsOf(const std::vector<model::Substructure>& parts,
                                     ReductionCache& cache) {
  const auto same = [](const PartView& view, const model::Substructure& part) {
    return &view.part() == &part;
  };
  if (!std::equal(cache.views.begin(), cache.views.end(), parts.begin(), parts.end(), same))
    cache.views.assign(parts.begin(), parts.end());
  return cache.views;
}

/// The reduction of a list of parts by the ranks of MPI_COMM_WORLD.
class Team {
 public:
  Team(const std::vector<model::Substructure>& parts, const ReductionMethod& basis,
       const ReductionOptions& options, ReductionCache& cache)
      : parts_(parts),
        basis_(basis),
        options_(options),
        cache_(cache),
        views_(viewsOf(parts, cache)),
        requests_(initialRequests(parts, options)),
        cores_(parts.size()) {
    if (cache_.classes.empty()) {
      cache_.classes = findIdenticalParts(parts_, std::vector<ModeRequest>(parts_.size()));
      checkParts(parts_, cache_.classes);
      if (options_.loadVectors.any())
        cache_.classes = sameLoads(parts_, cache_.classes, options_.loadVectors);
      if (basis_.namesParts()) std::iota(cache_.classes.begin(), cache_.classes.end(), 0);
    }
    representative_ = identicalParts(cache_.classes, requests_);
    recall();
    std::vector<int> weights;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (open(p)) weights.push_back(static_cast<int>(parts_[p].interior().size()));
    const auto owners = assignOwners(weights, parallel::size());
    owner_.assign(parts_.size(), -1);
    std::size_t next = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (open(p)) owner_[p] = owners[next++];
    const int idle = parallel::size() - static_cast<int>(weights.size());
    if (idle > 0 && !cache_.remembers && !together())
      log::warn("There are " + std::to_string(weights.size()) + " different substructures for " +
                std::to_string(parallel::size()) + " ranks: " + std::to_string(idle) +
                " of them are idle during the reduction.");
  }

  std::vector<ReducedSubstructure> run() {
    build(std::vector<char>(parts_.size(), 1));
    const auto kind = options_.modes.kind;
    if (kind == ModeRule::Kind::Total) shareTotalModes();
    if (kind == ModeRule::Kind::InterfaceMass || kind == ModeRule::Kind::InterfaceMoment)
      chooseByInterface();
    parallel::agree([&] {
      forOwned([&](std::size_t p) {
        if (!isWhole(bases_[p])) addLoadVectors(views_[p], options_.loadVectors, bases_[p]);
      });
      forOwned([&](std::size_t p) {
        cores_[p] = std::make_shared<const ReducedCore>(
            makeCore(views_[p], std::move(bases_[p]), options_));
      });
    });
    exchange();
    remember();
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (first(p) && !isWhole(cores_[p]->basis)) {
        warnOfDampedMassless(parts_[p]);
        warnOfUnsymmetricMassless(parts_[p]);
        if (!basis_.traits().ownMass) warnOfDampedMasslessBoundary(parts_[p]);
      }
    std::vector<ReducedSubstructure> reduced;
    std::map<std::size_t, ReducedModels> models;
    parallel::agree([&] {
      reduced.reserve(parts_.size());
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto t = static_cast<std::size_t>(representative_[p]);
        auto& identical = models.try_emplace(t, parts_[t], cores_[t], options_).first->second;
        identical.make(parts_[p], static_cast<int>(p), reduced.emplace_back());
      }
    });
    return reduced;
  }

 private:
  /// True if all ranks work on each part.
  bool together() const { return dynamic_cast<const CollectiveMethod*>(&basis_) != nullptr; }
  bool first(std::size_t p) const { return representative_[p] == static_cast<int>(p); }
  /// True if the part is to be reduced now.
  bool open(std::size_t p) const { return first(p) && !cores_[p]; }

  /// Reuses reductions of an earlier round with the same number of modes.
  void recall() {
    for (std::size_t p = 0; p < parts_.size() && cache_.remembers; ++p) {
      const auto found = cache_.cores.find({cache_.classes[p], requests_[p].count});
      if (first(p) && found != cache_.cores.end()) cores_[p] = found->second;
    }
  }

  void remember() {
    for (std::size_t p = 0; p < parts_.size() && cache_.remembers; ++p)
      if (first(p)) cache_.cores[{cache_.classes[p], requests_[p].count}] = cores_[p];
  }

  /// Choice by coupling to the boundary: computes enough modes to reach the fraction, and keeps
  /// those with the largest shares.
  void chooseByInterface() {
    const auto& rule = options_.modes;
    parallel::agree([&] {
      forOwned([&](std::size_t p) {
        for (;;) {
          if (!bases_[p].orthonormal || !bases_[p].removable)
            throw DeckError("The basis \"" + options_.basis +
                            "\" has no fixed-interface modes to select by an interface criterion. "
                            "Give \"Modes\", or choose the basis \"Craig-Bampton\".");
          const Vector shares = interfaceShares(views_[p], bases_[p], rule.kind);
          auto keep = keepByShare(shares, bases_[p].eigenvalues, rule.fraction, rule.pairTolerance);
          const bool all = bases_[p].complete && bases_[p].modes() == bases_[p].candidates.size();
          if (keep.empty() &&
              (all || bases_[p].modes() == 0))  // all existing modes miss it only by rounding
            keep.assign(static_cast<std::size_t>(shares.size()),
                        shares.size() > 0 && shares.sum() > 0 ? 1 : 0);
          else if (keep.empty()) {
            requests_[p].count *= 2;
            bases_[p] = basis_.build(views_[p], requests_[p]);
            continue;
          }
          bases_[p].remarks.clear();  // they refer to the computed number
          select(bases_[p], keep, "couples to the interface", "couples little to the interface");
          break;
        }
      });
    });
  }

  template <class Work>
  void forOwned(const Work& work) const {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (owner_[p] == parallel::rank()) work(p);
  }

  void build(const std::vector<char>& wanted) {
    if (together()) {
      buildTogether(wanted);
      return;
    }
    parallel::agree([&] {
      forOwned([&](std::size_t p) {
        if (wanted[p])
          bases_[p] = requests_[p].kind == ModeRequest::Kind::Whole
                          ? wholePart(views_[p])
                          : basis_.build(views_[p], requests_[p]);
      });
    });
  }

  /// Reduces the parts one after the other with all ranks, for a collective method.
  void buildTogether(const std::vector<char>& wanted) {
    const auto kind = options_.modes.kind;
    if (kind == ModeRule::Kind::InterfaceMass || kind == ModeRule::Kind::InterfaceMoment)
      throw DeckError("The basis \"" + options_.basis +
                      "\" does not select its modes by an interface criterion. Give \"Modes\" or "
                      "\"Cut-off Frequency\", or choose the basis \"Craig-Bampton\".");
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (owner_[p] < 0 || !wanted[p]) continue;
      if (requests_[p].kind == ModeRequest::Kind::Whole)
        parallel::agree([&] { bases_[p] = wholePart(views_[p]); });
      else
        bases_[p] = basis_.build(views_[p], requests_[p]);
      if (owner_[p] != parallel::rank()) bases_.erase(p);
    }
  }

  /// Total Modes: computes until every spectrum is long enough, then cuts all at the same
  /// frequency.
  void shareTotalModes() {
    for (;;) {
      std::vector<Vector> spectra(parts_.size());
      std::vector<bool> complete(parts_.size());
      std::vector<int> built(parts_.size());
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto t = static_cast<std::size_t>(representative_[p]);
        spectra[p] = first(p) ? bases_[p].candidates : spectra[t];
        int state[2] = {bases_[t].complete ? 1 : 0,
                        bases_[t].removable ? bases_[t].modes()
                                            : static_cast<int>(bases_[t].candidates.size())};
        if (first(p)) {
          parallel::broadcast(spectra[p], owner_[p]);
          parallel::broadcast(state[0], owner_[p]);
          parallel::broadcast(state[1], owner_[p]);
        }
        complete[p] = first(p) ? state[0] == 1 : complete[t];
        built[p] = first(p) ? state[1] : built[t];
      }
      std::vector<int> counts =
          shareTotal(spectra, complete, options_.modes.total, options_.modes.pairTolerance);
      std::vector<char> again(parts_.size(), 0);
      bool enough = true;
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto t = static_cast<std::size_t>(representative_[p]);
        counts[t] = counts[p] < 0 || counts[t] < 0 ? -1 : std::max(counts[t], counts[p]);
        if (counts[p] < 0 || counts[p] > built[p]) {
          again[t] = 1;
          enough = false;
        }
      }
      if (enough) {
        forOwned([&](std::size_t p) {
          if (!bases_[p].removable) {
            requests_[p].count = counts[p];
            requests_[p].pairTolerance = 0;  // pairs are whole already
            bases_[p] = basis_.build(views_[p], requests_[p]);
            return;
          }
          bases_[p].remarks.clear();  // they refer to the number of modes of this part alone
          truncate(bases_[p], counts[p],
                   "above the lowest " + std::to_string(options_.modes.total) + " of all parts");
        });
        return;
      }
      for (std::size_t p = 0; p < parts_.size(); ++p)
        if (again[p]) requests_[p].count *= 2;
      build(again);
    }
  }

  void exchange() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (owner_[p] < 0 || parallel::size() == 1) continue;
      std::string bytes;
      if (owner_[p] == parallel::rank()) bytes = pack(*cores_[p]);
      parallel::broadcast(bytes, owner_[p]);
      if (owner_[p] != parallel::rank())
        cores_[p] = std::make_shared<const ReducedCore>(unpack(bytes));
    }
  }

  const std::vector<model::Substructure>& parts_;
  const ReductionMethod& basis_;
  const ReductionOptions& options_;
  ReductionCache& cache_;
  const std::vector<PartView>& views_;
  std::vector<ModeRequest> requests_;
  std::vector<int> representative_;  ///< first identical part
  std::vector<int>
      owner_;  ///< rank, -1 for parts taken over from a representative or an earlier round
  std::map<std::size_t, Basis> bases_;  ///< of the parts this rank owns
  std::vector<std::shared_ptr<const ReducedCore>> cores_;
};

}  // namespace

ReducedSubstructure reduce(const PartView& part, const Basis& basis,
                           const ReductionOptions& options, int index) {
  ReducedSubstructure reduced;
  ReducedModels(part.part(), std::make_shared<const ReducedCore>(makeCore(part, basis, options)),
                options)
      .make(part.part(), index, reduced);
  return reduced;
}

std::vector<BasisRow> ReducedSubstructure::basisRows() const {
  std::vector<BasisRow> rows = *report.rows;
  for (int j = 0; j < std::min(sizeOf(basis->partition.boundary), sizeOf(rows)); ++j)
    if (rows[at(j)].kind == "constraint") rows[at(j)].name = model::dofName(model, j);
  return rows;
}

std::vector<ReducedSubstructure> reduceAll(const std::vector<model::Substructure>& parts,
                                           const ReductionMethod& basis,
                                           const ReductionOptions& options) {
  ReductionCache none;
  none.remembers = false;
  return reduceAll(parts, basis, options, none);
}

std::vector<ReducedSubstructure> reduceAll(const std::vector<model::Substructure>& parts,
                                           const ReductionMethod& basis,
                                           const ReductionOptions& options, ReductionCache& cache) {
  return Team(parts, basis, options, cache).run();
}

std::string summaryTable(const std::vector<ReducedSubstructure>& parts) {
  std::vector<const BasisReport*> reports;
  for (const auto& part : parts) reports.push_back(&part.report);
  return summaryTable(reports);
}

}  // namespace tooljoint::reduction
