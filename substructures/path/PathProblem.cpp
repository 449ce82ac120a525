// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/path/PathProblem.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/Index.hpp"
#include "substructures/beam/Rotation.hpp"

namespace tooljoint::path {
namespace {

/// 1 for the dofs `held`, and for the rotations (along a curve also depths) that no element has.
std::vector<char> heldDofs(const PathInput& input, int translations, const std::vector<int>& held) {
  const int perNode = translations + 3;
  const std::vector<beam::DofMap> present = beam::nodalDofs(input.elements);
  std::vector<char> flags(present.size() * at(perNode), 0);
  for (const int dof : held) flags[at(dof)] = 1;
  for (int node = 0; node < sizeOf(present); ++node) {
    if (translations == 1 && !present[at(node)][2]) flags[at(node * perNode)] = 1;
    for (int axis = 0; axis < 3; ++axis)
      if (!present[at(node)][at(3 + axis)]) flags[at(node * perNode + translations + axis)] = 1;
  }
  return flags;
}

}  // namespace

PathProblem::PathProblem(const PathInput& input, int translations, Vector state,
                         std::vector<Matrix3> reference, const std::vector<int>& held)
    : translations_(translations),
      state_(std::move(state)),
      reference_(std::move(reference)),
      elements_(input.elements),
      free_(dofsPerNode(), heldDofs(input, translations, held)) {
  std::vector<std::vector<int>> lists;
  double rigidity = 0.0;
  double stretch = 0.0;
  double length = 0.0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const beam::Section& section = elements_[e]->section();
    rigidity = std::max(rigidity,
                        section.youngModulus() * std::max(section.inertiaX(), section.inertiaY()));
    stretch = std::max(stretch, section.axialRigidity() / elements_[e]->length());
    length += elements_[e]->length();
    lists.push_back(free_.ofElement(static_cast<int>(e)));
  }
  assembler_ = beam::SparseAssembler(size(), std::move(lists));
  // Force scale: E I/l^2 plus, since positions carry the rounding of the whole depth L, a millionth
  // of (E S/l) L. Moment scale: E I/l.
  const double mean = length / static_cast<double>(elements_.size());
  forceScale_ = rigidity / (mean * mean) + 1e-6 * stretch * length;
  momentScale_ = rigidity / mean;
}

Vector PathProblem::expand(const Vector& x) const {
  Vector state = state_;
  free_.put(x, state);
  return state;
}

void PathProblem::moveReference(const Vector& x) {
  const Vector state = expand(x);
  for (int n = 0; n < nodes(); ++n) reference_[at(n)] = pose(n, state).triad;
  state_ = state;
  for (int n = 0; n < nodes(); ++n) state_.segment<3>(n * dofsPerNode() + translations_).setZero();
}

Vector3 PathProblem::positionCurvature(const double* /*translations*/) const {
  return Vector3::Zero();
}

NodePose PathProblem::pose(int node, const Vector& state) const {
  const double* dofs = state.data() + node * dofsPerNode();
  const Eigen::Map<const Vector3> theta(dofs + translations_);
  return {position(dofs), reference_[at(node)] * beam::rotationExponential(theta)};
}

std::vector<NodePose> PathProblem::poses(const Vector& x) const {
  const Vector state = expand(x);
  std::vector<NodePose> out;
  for (int n = 0; n < nodes(); ++n) out.push_back(pose(n, state));
  return out;
}

Matrix PathProblem::testMotion(int node, const Vector& state) const {
  // delta X = X' delta y, delta omega = Q_ref delta theta
  Matrix motion = Matrix::Zero(6, dofsPerNode());
  motion.topLeftCorner(3, translations_) = positionDerivative(state.data() + node * dofsPerNode());
  motion.bottomRightCorner<3, 3>() = reference_[at(node)];
  return motion;
}

Matrix PathProblem::trialMotion(int node, const Vector& state) const {
  // d omega = Q_ref T_s(theta) d theta
  Matrix motion = testMotion(node, state);
  const Eigen::Map<const Vector3> theta(state.data() + node * dofsPerNode() + translations_);
  motion.bottomRightCorner<3, 3>() =
      (reference_[at(node)] * beam::spinFromRotationVector(theta)).eval();
  return motion;
}

std::vector<beam::CorotationalResponse> PathProblem::evaluate(const Vector& state, bool withTangent,
                                                              Elements which) const {
  std::vector<beam::CorotationalResponse> out;
  out.reserve(at(which.end - which.begin));
  NodePose first = pose(which.begin, state);
  for (int e = which.begin; e < which.end; ++e) {
    const NodePose second = pose(e + 1, state);
    out.push_back(elements_[at(e)]->response(
        {first.position, second.position, first.triad, second.triad}, withTangent));
    first = second;
  }
  return out;
}

std::vector<beam::CorotationalResponse> PathProblem::responses(const Vector& x,
                                                               bool withTangent) const {
  return evaluate(expand(x), withTangent, allElements());
}

Matrix PathProblem::nodalForces(const Vector& x) const {
  Matrix f = Matrix::Zero(6, nodes());
  const auto elementResponses = responses(x, false);
  for (int e = 0; e < static_cast<int>(elementResponses.size()); ++e) {
    f.col(e) += elementResponses[at(e)].force.head<6>();
    f.col(e + 1) += elementResponses[at(e)].force.tail<6>();
  }
  return f;
}

PathProblem::Elements PathProblem::elementsOf(RowRange rows) const {
  const auto nodes = free_.nodesOf(rows);
  return {std::max(0, nodes.begin - 1), std::min(nodes.end, sizeOf(elements_))};
}

void PathProblem::residual(const Vector& x, Vector& r) const { residualOf(allElements(), x, r); }

void PathProblem::residualRows(const Vector& x, RowRange rows, Vector& r) const {
  residualOf(elementsOf(rows), x, r);
}

void PathProblem::residualOf(Elements which, const Vector& x, Vector& r) const {
  const Vector state = expand(x);
  const auto elementResponses = evaluate(state, false, which);
  r = Vector::Zero(size());
  const int perNode = dofsPerNode();
  Vector local(2 * perNode);
  for (int e = which.begin; e < which.end; ++e) {
    const beam::Vector12& f = elementResponses[at(e - which.begin)].force;
    local.head(perNode) = testMotion(e, state).transpose() * f.head<6>();
    local.tail(perNode) = testMotion(e + 1, state).transpose() * f.tail<6>();
    assembler_.add(e, local, r);
  }
  constrain(state, r);
}

void PathProblem::jacobian(const Vector& x, Sparse& jacobian) const {
  jacobianOf(allElements(), x, jacobian);
}

void PathProblem::jacobianRows(const Vector& x, RowRange rows, Sparse& jacobian) const {
  jacobianOf(elementsOf(rows), x, jacobian);
}

void PathProblem::jacobianOf(Elements which, const Vector& x, Sparse& jacobian) const {
  const Vector state = expand(x);
  const auto elementResponses = evaluate(state, true, which);
  assembler_.clear(jacobian);
  const int perNode = dofsPerNode();
  Matrix test = Matrix::Zero(12, 2 * perNode);
  Matrix trial = Matrix::Zero(12, 2 * perNode);
  for (int e = which.begin; e < which.end; ++e) {
    const beam::CorotationalResponse& response = elementResponses[at(e - which.begin)];
    test.topLeftCorner(6, perNode) = testMotion(e, state);
    test.bottomRightCorner(6, perNode) = testMotion(e + 1, state);
    trial.topLeftCorner(6, perNode) = trialMotion(e, state);
    trial.bottomRightCorner(6, perNode) = trialMotion(e + 1, state);
    Matrix local = test.transpose() * response.tangent * trial;
    // the direction of the translation turns: X'' . f
    if (translations_ == 1) {
      local(0, 0) +=
          positionCurvature(state.data() + e * perNode).dot(response.force.segment<3>(0));
      local(perNode, perNode) +=
          positionCurvature(state.data() + (e + 1) * perNode).dot(response.force.segment<3>(6));
    }
    assembler_.add(e, local, jacobian);
  }
  constrain(jacobian);
}

Vector PathProblem::residualScale() const {
  Vector scale(size());
  for (int i = 0; i < size(); ++i)
    scale(i) = 1.0 / (free_.component(i) < translations_ ? forceScale_ : momentScale_);
  constrainScale(scale);
  return scale;
}

std::string PathProblem::unknownName(int i) const {
  static const char* const alongCurve[] = {"depth", "theta_x", "theta_y", "theta_z"};
  static const char* const inSpace[] = {"X", "Y", "Z", "theta_x", "theta_y", "theta_z"};
  const int component = free_.component(i);
  return std::string(translations_ == 1 ? alongCurve[component] : inSpace[component]) +
         " of node " + std::to_string(free_.node(i) + 1);
}

}  // namespace tooljoint::path
