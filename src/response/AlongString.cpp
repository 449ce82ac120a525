// SPDX-License-Identifier: BSD-3-Clause
#include "response/AlongString.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cases/nodes/NodeDofs.hpp"
#include "linalg/ComplexProduct.hpp"

namespace tooljoint::response {

namespace {

/// Nodes that are open at rest, with their gaps.
std::vector<AlongString::Node> openNodes(const RotatingCase& rotating, const std::string& axis) {
  const auto& model = rotating.model();
  const auto measures = rotating.rest().measures();
  const auto lateral = cases::lateralComponents(model, axis);
  std::vector<AlongString::Node> nodes;
  if (lateral[0] < 0 || lateral[1] < 0) return nodes;
  const Vector rest = rotating.rest().rest();
  const auto width = static_cast<Eigen::Index>(model.componentNames.size());
  for (std::size_t i = 0; i < measures.nodes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i) * width;
    const double gap =
        measures.clearance[i] - std::hypot(rest[row + lateral[0]], rest[row + lateral[1]]);
    if (!std::isfinite(gap) || gap <= 0.0) continue;
    nodes.push_back({measures.nodes[i], measures.depth.empty() ? 0.0 : measures.depth[i], gap});
  }
  return nodes;
}

std::vector<cases::NodeSums> lateralSums(const RotatingCase& rotating, const std::string& axis,
                                         const std::vector<AlongString::Node>& nodes) {
  const auto lateral = cases::lateralComponents(rotating.model(), axis);
  std::vector<cases::NodeSums> sums;
  for (const auto& node : nodes)
    sums.push_back({{{{node.number, lateral[0], 1.0}}, {{node.number, lateral[1], 1.0}}}});
  return sums;
}

std::vector<cases::NodeSums> sumsOf(const std::vector<cases::BendingPlace>& places) {
  std::vector<cases::NodeSums> sums;
  for (const auto& place : places) sums.push_back(place.moment);
  return sums;
}

std::size_t count(const StringResponse& response) {
  return (response.margin ? 2U : 0U) + (response.moment ? 2U : 0U);
}

}  // namespace

Ellipses::Ellipses(const model::SecondOrderModel& model, const std::vector<cases::NodeSums>& sums) {
  std::map<std::int64_t, Eigen::Index> first;  // row of the recovery of a node
  const auto width = static_cast<Eigen::Index>(model.componentNames.size());
  for (std::size_t i = 0; i < model.recoveryNodes.size(); ++i)
    first.emplace(model.recoveryNodes[i], static_cast<Eigen::Index>(i) * width);
  for (std::size_t axis : {0, 1}) {
    Triplets terms;
    for (std::size_t place = 0; place < sums.size(); ++place)
      for (const auto& term : sums[place][axis]) {
        const auto row = first.find(term.node);
        if (row != first.end())
          terms.emplace_back(static_cast<int>(place),
                             static_cast<int>(row->second) + term.component, term.factor);
      }
    Sparse selected(static_cast<Eigen::Index>(sums.size()), model.recovery.rows());
    selected.setFromTriplets(terms.begin(), terms.end());
    rows_[axis] = selected * model.recovery;
  }
}

ComplexMatrix Ellipses::axes(const Eigen::VectorXcd& q) const {
  ComplexMatrix out(rows_[0].rows(), 2);
  for (int axis : {0, 1}) out.col(axis) = linalg::times(rows_[static_cast<std::size_t>(axis)], q);
  return out;
}

ComplexMatrix Ellipses::coefficients(std::size_t place) const {
  ComplexMatrix out = ComplexMatrix::Zero(rows_[0].cols(), 2);
  for (int axis : {0, 1}) {
    const auto& rows = rows_[static_cast<std::size_t>(axis)];
    for (Sparse::InnerIterator it(rows, static_cast<Eigen::Index>(place)); it; ++it)
      out(it.col(), axis) = it.value();
  }
  return out;
}

Vector Ellipses::reach(const ComplexMatrix& axes) {
  Vector out(axes.rows());
  for (Eigen::Index i = 0; i < axes.rows(); ++i) {
    const auto x = axes(i, 0), y = axes(i, 1);
    out[i] = std::sqrt(0.5 * (std::norm(x) + std::norm(y) + std::abs(x * x + y * y)));
  }
  return out;
}

AlongString::AlongString(const RotatingCase& rotating, const std::string& axis)
    : rotating_(rotating),
      nodes_(openNodes(rotating, axis)),
      elements_(rotating.rest().measures().bending),
      gapSums_(lateralSums(rotating, axis, nodes_)),
      momentSums_(sumsOf(elements_)),
      gaps_(rotating.model(), gapSums_),
      moments_(rotating.model(), momentSums_) {}

StringResponse AlongString::evaluate(const Ellipses& gaps, const Ellipses& moments,
                                     const Eigen::VectorXcd& q) const {
  StringResponse out;
  const ComplexMatrix orbit = gaps.axes(q), bending = moments.axes(q);
  const auto extreme = [](const Vector& values, const ComplexMatrix& axes, Eigen::Index place) {
    return Extreme{
        static_cast<std::size_t>(place), values[place], {axes(place, 0), axes(place, 1)}, 0.0};
  };
  Eigen::Index place = 0;
  out.margins = -Ellipses::reach(orbit);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    out.margins[static_cast<Eigen::Index>(i)] += nodes_[i].gap;
  out.moments = Ellipses::reach(bending);
  if (!nodes_.empty()) {
    out.margins.minCoeff(&place);
    out.margin = extreme(out.margins, orbit, place);
  }
  if (!elements_.empty()) {
    out.moments.maxCoeff(&place);
    out.moment = extreme(out.moments, bending, place);
  }
  return out;
}

StringResponse AlongString::of(const Eigen::VectorXcd& q) const {
  return evaluate(gaps_, moments_, q);
}

StringResponse AlongString::ofFull(const Eigen::VectorXcd& q, const StringResponse& reduced) const {
  const Ellipses gaps(rotating_.full(), gapSums_), moments(rotating_.full(), momentSums_);
  auto out = evaluate(gaps, moments, q);
  const auto move = [](std::optional<Extreme>& extreme, const std::optional<Extreme>& to,
                       const Vector& values, const ComplexMatrix& axes) {
    if (!extreme || !to) return;
    const auto place = static_cast<Eigen::Index>(to->place);
    *extreme = {to->place, values[place], {axes(place, 0), axes(place, 1)}, 0.0};
  };
  move(out.margin, reduced.margin, out.margins, gaps.axes(q));
  move(out.moment, reduced.moment, out.moments, moments.axes(q));
  return out;
}

ComplexMatrix AlongString::outputs(const model::SecondOrderModel& model,
                                   const StringResponse& response) const {
  ComplexMatrix out(model.size(), static_cast<Eigen::Index>(count(response)));
  Eigen::Index column = 0;
  const auto add = [&](const std::optional<Extreme>& extreme,
                       const std::vector<cases::NodeSums>& sums) {
    if (!extreme) return;
    out.middleCols(column, 2) = Ellipses(model, {sums[extreme->place]}).coefficients(0);
    column += 2;
  };
  add(response.margin, gapSums_);
  add(response.moment, momentSums_);
  return out;
}

void AlongString::takeEstimates(const Eigen::VectorXd& errors, StringResponse& response) {
  Eigen::Index row = 0;
  for (auto* extreme : {&response.margin, &response.moment}) {
    if (!*extreme) continue;
    (*extreme)->estimate = std::hypot(errors[row], errors[row + 1]);
    row += 2;
  }
}

}  // namespace tooljoint::response
