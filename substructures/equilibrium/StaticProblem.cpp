// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/equilibrium/StaticProblem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::equilibrium {
namespace {

constexpr int kDofs = beam::nodal::perNode;
/// Dofs of the force components of StaticContact, in its order.
constexpr std::array<int, contact::StaticContact::kForces> kContactDofs{
    beam::nodal::u, beam::nodal::v, beam::nodal::w, beam::nodal::thetaZ};

/// The input; throws unless its parts have matching sizes.
const StaticInput& checked(const StaticInput& input) {
  const int dofs = kDofs * input.nodes;
  const bool fits = input.nodes == static_cast<int>(input.elements.size()) + 1 &&
                    input.load.size() == dofs &&
                    (input.pathReaction.size() == 0 || input.pathReaction.size() == dofs) &&
                    (input.kinks.empty() || input.kinks.size() == input.elements.size()) &&
                    static_cast<int>(input.held.size()) == dofs;
  if (!fits)
    throw ModelError(
        "The elements, loads and supports of the static problem have different sizes.");
  if (input.contact != nullptr)
    for (const int node : input.contact->points().node)
      if (node < 1 || node > input.nodes)
        throw ModelError("A contact point is at node " + std::to_string(node) +
                         ", but the string has nodes 1 to " + std::to_string(input.nodes) + ".");
  return input;
}

}  // namespace

StaticProblem::StaticProblem(const StaticInput& input)
    : input_(checked(input)),
      elements_(input),
      free_(kDofs, input.held),
      pretension_(pretensionForces(input)) {
  switches_.geometricStiffness = input.geometricStiffness;
  if (size() == 0)
    throw ModelError(
        "The supports fix every degree of freedom of the string. Free at least one dof.");

  std::vector<std::vector<int>> lists;
  lists.reserve(input.elements.size() + at(input.contact != nullptr ? input.contact->size() : 0));
  double length = 0.0;
  for (int e = 0; e < elements_.size(); ++e) {
    lists.push_back(free_.ofElement(e));
    length += input.elements[at(e)].formulation->length();
  }
  if (input.contact != nullptr) {
    const std::vector<int>& nodes = input.contact->points().node;
    if (std::is_sorted(nodes.begin(), nodes.end()))
      for (int node = 1; node <= input.nodes + 1; ++node)
        pointsBefore_.push_back(
            static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()));
    for (const int node : nodes) {
      const int first = kDofs * (node - 1);
      auto& dofs = lists.emplace_back();
      for (const int component : kContactDofs) dofs.push_back(free_.unknown(first + component));
    }
  }
  assembler_ = beam::SparseAssembler(size(), std::move(lists));

  // Forces are divided by the largest load, moments by that load times a mean element length.
  const double mean = length / static_cast<double>(input.elements.size());
  double largest = 0.0;
  for (int i = 0; i < input.load.size(); ++i) {
    const double arm = i % kDofs < 3 ? 1.0 : 1.0 / mean;
    largest = std::max(largest, arm * std::abs(input.load(i)));
    if (input.pathReaction.size() > 0)
      largest = std::max(largest, arm * std::abs(input.pathReaction(i)));
  }
  // a bend beta gives the force E I beta/L^2, which holds a string of the whole length straight
  for (std::size_t e = 0; e < input.kinks.size(); ++e) {
    const auto& section = input.elements[e].formulation->section();
    largest = std::max(largest, section.youngModulus() * section.inertiaX() *
                                    input.kinks[e].norm() / (length * length));
  }
  forceScale_ = largest > 0.0 ? largest : 1.0;
  momentScale_ = forceScale_ * mean;
}

Vector StaticProblem::expand(const Vector& x) const {
  Vector full = Vector::Zero(kDofs * input_.nodes);
  free_.put(x, full);
  return full;
}

beam::Matrix12 StaticProblem::geometricStiffness(int element, const Vector& full) const {
  return switches_.geometricStiffness ? elements_.geometricStiffness(element, full)
                                      : beam::Matrix12(beam::Matrix12::Zero());
}

contact::StaticContact::Options StaticProblem::contactOptions(Nodes nodes) const {
  contact::StaticContact::Options options;
  options.lambda = switches_.lambda;
  options.frictionScale = switches_.frictionScale;
  options.stiffnessScale = switches_.stiffnessScale;
  options.pull = switches_.pull;
  options.sliding = input_.sliding;
  if (pointsBefore_.empty()) return options;
  options.first = pointsBefore_[at(nodes.begin)];
  options.last = pointsBefore_[at(nodes.end)];
  return options;
}

Vector StaticProblem::lateral(const Vector& full) const {
  const std::vector<int>& nodes = input_.contact->points().node;
  Vector uv(2 * static_cast<int>(nodes.size()));
  for (std::size_t p = 0; p < nodes.size(); ++p)
    uv.segment<2>(2 * static_cast<int>(p)) = full.segment<2>(kDofs * (nodes[p] - 1));
  return uv;
}

void StaticProblem::contactForces(const Vector& full, Vector& forces, Vector& normal) const {
  const int points = touches() ? input_.contact->size() : 0;
  forces.setZero(contact::StaticContact::kForces * points);
  normal.setZero(points);
  if (points == 0) return;
  const Vector uv = lateral(full);
  const auto options = contactOptions(allNodes());
  input_.contact->evaluate(options, uv.data(), forces.data());
  input_.contact->normalForce(options, uv.data(), normal.data());
}

void StaticProblem::residual(const Vector& x, Vector& r) const {
  r = restrict(unbalanced(expand(x)));
}

void StaticProblem::residualRows(const Vector& x, RowRange rows, Vector& r) const {
  r = restrict(unbalancedAt(free_.nodesOf(rows), expand(x)));
}

Vector StaticProblem::unbalanced(const Vector& full) const {
  return unbalancedAt(allNodes(), full);
}

Vector StaticProblem::constantForces() const {
  Vector r = -input_.load - pretension_;
  if (switches_.pathReaction && input_.pathReaction.size() > 0) r -= input_.pathReaction;
  return r;
}

void StaticProblem::addForces(int point, const Vector& forces, Vector& r) const {
  const double* force = forces.data() + contact::StaticContact::kForces * point;
  for (const int component : kContactDofs)
    r(kDofs * (input_.contact->points().node[at(point)] - 1) + component) -= *force++;
}

void StaticProblem::addTangent(int point, const Vector& tangents, Sparse& jacobian) const {
  constexpr int n = contact::StaticContact::kForces;
  Eigen::Matrix<double, n, n> k = Eigen::Matrix<double, n, n>::Zero();
  k.leftCols<2>() = -Eigen::Map<const Eigen::Matrix<double, n, 2, Eigen::RowMajor>>(
      tangents.data() + 2 * n * point);
  assembler_.add(elements_.size() + point, k, jacobian);
}

Vector StaticProblem::unbalancedAt(Nodes nodes, const Vector& full) const {
  Vector r = constantForces();
  for (int e = firstElement(nodes); e < endElement(nodes); ++e) {
    r.segment<12>(kDofs * e) += (input_.elements[at(e)].stiffness + geometricStiffness(e, full)) *
                                elements_.motion(e, full);
  }
  if (!touches()) return r;
  const auto options = contactOptions(nodes);
  Vector forces(contact::StaticContact::kForces * input_.contact->size());
  input_.contact->evaluate(options, lateral(full).data(), forces.data());
  for (int p = options.first; p < options.end(input_.contact->size()); ++p) addForces(p, forces, r);
  return r;
}

void StaticProblem::jacobian(const Vector& x, Sparse& jacobian) const {
  jacobianAt(allNodes(), x, jacobian);
}

void StaticProblem::jacobianRows(const Vector& x, RowRange rows, Sparse& jacobian) const {
  jacobianAt(free_.nodesOf(rows), x, jacobian);
}

void StaticProblem::jacobianAt(Nodes nodes, const Vector& x, Sparse& jacobian) const {
  const Vector full = expand(x);
  assembler_.clear(jacobian);
  for (int e = firstElement(nodes); e < endElement(nodes); ++e) {
    beam::Matrix12 k = input_.elements[at(e)].stiffness + geometricStiffness(e, full);
    if (switches_.geometricStiffness && switches_.exactJacobian)
      k += elements_.geometricTangent(e, full);
    assembler_.add(e, k, jacobian);
  }
  if (!touches()) return;
  const auto options = contactOptions(nodes);
  const int points = input_.contact->size();
  constexpr int n = contact::StaticContact::kForces;
  Vector forces(n * points);
  Vector tangents(2 * n * points);
  input_.contact->evaluate(options, lateral(full).data(), forces.data(), tangents.data());
  for (int p = options.first; p < options.end(points); ++p) addTangent(p, tangents, jacobian);
}

void StaticProblem::linearise(const Vector& x, Vector& r, Sparse& jacobian) const {
  const Vector full = expand(x);
  Vector unbalance = constantForces();
  assembler_.clear(jacobian);
  for (int e = 0; e < elements_.size(); ++e) {
    const beam::Vector12 d = elements_.motion(e, full);
    beam::Matrix12 k = input_.elements[at(e)].stiffness;
    beam::Vector12 force = k * d;
    if (switches_.geometricStiffness)
      elements_.addGeometric(e, d, switches_.exactJacobian, k, force);
    unbalance.segment<12>(kDofs * e) += force;
    assembler_.add(e, k, jacobian);
  }
  if (touches()) {
    const int points = input_.contact->size();
    constexpr int n = contact::StaticContact::kForces;
    Vector forces(n * points);
    Vector tangents(2 * n * points);
    input_.contact->evaluate(contactOptions(allNodes()), lateral(full).data(), forces.data(),
                             tangents.data());
    for (int p = 0; p < points; ++p) {
      addForces(p, forces, unbalance);
      addTangent(p, tangents, jacobian);
    }
  }
  r = restrict(unbalance);
}

Vector StaticProblem::residualScale() const {
  Vector scale(size());
  for (int i = 0; i < size(); ++i) scale(i) = 1.0 / (isForce(i) ? forceScale_ : momentScale_);
  return scale;
}

double StaticProblem::stepLimit(const Vector& /*x*/, const Vector& dx) const {
  if (switches_.lateralStepLimit <= 0.0) return 1.0;
  double largest = 0.0;
  for (int i = 0; i < size(); ++i)
    if (isLateral(i)) largest = std::max(largest, std::abs(dx(i)));
  return largest > switches_.lateralStepLimit ? switches_.lateralStepLimit / largest : 1.0;
}

Vector StaticProblem::moved(const Vector& x, const Vector& dx, double s) const {
  Vector there = x + s * dx;
  if (!touches() || !switches_.slideAlongWall) return there;
  const contact::ContactPoints& points = input_.contact->points();
  for (std::size_t p = 0; p < points.node.size(); ++p) {
    const int dof = kDofs * (points.node[p] - 1);
    const int u = free_.unknown(dof), v = free_.unknown(dof + 1);
    if (u < 0 || v < 0) continue;
    const Eigen::Vector2d offset = input_.contact->offset(static_cast<int>(p));
    const Eigen::Vector2d from = Eigen::Vector2d(x(u), x(v)) + offset;
    const Eigen::Vector2d to = Eigen::Vector2d(there(u), there(v)) + offset;
    const double before = std::hypot(from.x(), from.y()), after = std::hypot(to.x(), to.y());
    if (before == 0.0 || after <= points.clearance[p]) continue;
    const double alongNormal = (from.x() * to.x() + from.y() * to.y()) / before;
    if (alongNormal < 0.5 * after) continue;  // half around the hole: no sliding along the wall
    there(u) = to.x() * (alongNormal / after) - offset.x();
    there(v) = to.y() * (alongNormal / after) - offset.y();
  }
  return there;
}

std::vector<int> StaticProblem::lateralUnknowns() const {
  std::vector<int> lateral;
  for (int i = 0; i < size(); ++i)
    if (isLateral(i)) lateral.push_back(i);
  return lateral;
}

std::string StaticProblem::unknownName(int i) const {
  static constexpr std::array<const char*, kDofs> names{"u",       "v",       "w",
                                                        "theta_x", "theta_y", "theta_z"};
  return std::string(names[at(free_.component(i))]) + " of node " +
         std::to_string(free_.node(i) + 1);
}

}  // namespace tooljoint::equilibrium
