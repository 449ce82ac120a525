// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/LawsOnForces.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "model/DofNames.hpp"

namespace tooljoint::coupling {

namespace {

/// Largest k G of a spring that is not changed noticeably by its own residual flexibility.
constexpr double negligibleCompliance = 0.01;

constexpr const char* advice =
    "The forces between parts are coordinates of the basis \"Dual Craig-Bampton\" and have no "
    "residual flexibility for the force of a law. Choose \"Rubin\", which has the same modes, or "
    "cut the parts where no law acts.";

/// G of the interface dofs, by their coordinates of the labelled model.
std::map<int, double> residualFlexibility(const std::vector<AlignedPart>& alignedParts,
                                          const Labelled& labelled) {
  std::map<int, double> found;
  for (std::size_t p = 0; p < alignedParts.size(); ++p) {
    const AlignedPart& part = alignedParts[p];
    const int first = part.coordinates - part.forces;
    for (int j = 0; part.forces > 0 && j < part.boundaryRows.rows(); ++j) {
      const double own = part.boundaryRows.coeff(j, first + j);
      if (own > 0.0) found[labelled.columns[p][at(part.coordinates + j)]] = own;
    }
  }
  return found;
}

/// Coordinates of the labelled model that are forces between parts.
std::set<int> forceCoordinates(const std::vector<AlignedPart>& alignedParts,
                               const Labelled& labelled) {
  std::set<int> found;
  for (std::size_t p = 0; p < alignedParts.size(); ++p)
    for (int k = 1; k <= alignedParts[p].forces; ++k)
      found.insert(labelled.columns[p][at(alignedParts[p].coordinates - k)]);
  return found;
}

void checkConnector(const model::PointSet& set, const model::SecondOrderModel& model,
                    const std::map<int, double>& flexibility) {
  const int width = set.law->width(), rows = set.law->size() * width;
  const Vector d = set.offset + set.rows * model.initialDisplacement, v = Vector::Zero(rows);
  Vector f = Vector::Zero(rows), dfdd = Vector::Zero(rows * width), dfdv = dfdd;
  std::vector<int> points(at(set.law->size()));
  std::iota(points.begin(), points.end(), 0);
  set.law->evaluateWithTangent(0.0, points, d.data(), v.data(), f.data(), dfdd.data(), dfdv.data());
  for (int r = 0; r < rows; ++r)
    forEachInRow(set.rows, r, [&](int column, double factor) {
      const auto found = flexibility.find(column);
      if (found == flexibility.end()) return;
      const int diagonal = r * width + r % width;
      const double G = factor * factor * found->second, k = -dfdd[diagonal], c = -dfdv[diagonal];
      const std::string who = fmt::format("\"{}\" acts on {}, a dof that parts share. ", set.name,
                                          model::dofName(model, column));
      if (k * G > negligibleCompliance)
        throw ModelError(who +
                         fmt::format("Its stiffness of {} times the residual flexibility "
                                     "there, {}, is {:.2g}, and the answer is wrong by about "
                                     "as much. ",
                                     formatNumber(k), formatNumber(G), k * G) +
                         advice);
      if (c > 0.0) throw ModelError(who + "Its damping makes a motion grow. " + advice);
    });
}

}  // namespace

std::string checkLawsOnForces(const std::vector<AlignedPart>& alignedParts,
                              const Labelled& labelled, std::size_t connectors) {
  const auto flexibility = residualFlexibility(alignedParts, labelled);
  if (flexibility.empty()) return "";
  const auto forces = forceCoordinates(alignedParts, labelled);
  const auto& sets = labelled.model.points;
  std::set<std::string> names;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (i + connectors >= sets.size()) checkConnector(sets[i], labelled.model, flexibility);
    for (int r = 0; r < sets[i].rows.rows(); ++r)
      forEachInRow(sets[i].rows, r, [&](int column, double factor) {
        if (factor != 0.0 && (flexibility.count(column) > 0 || forces.count(column) > 0))
          names.insert(sets[i].name);
      });
  }
  if (names.empty()) return "";
  return "Point laws (" + quotedList({names.begin(), names.end()}) +
         ") act where the forces between parts move the dofs: stiff laws give wrong motions "
         "there. " +
         advice;
}

}  // namespace tooljoint::coupling
