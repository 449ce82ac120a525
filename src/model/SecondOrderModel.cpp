// SPDX-License-Identifier: BSD-3-Clause
#include "model/SecondOrderModel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Error.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::model {

std::string describe(const DofLabel& label, const ComponentNames& names,
                     const NodeNamer& nodeName) {
  if (label.force != 0) return "the force on " + describe(label.joiningForce(0), names, nodeName);
  if (label.kind == DofLabel::Kind::Interface)
    return "mode " + std::to_string(label.component + 1) + " of interface " +
           std::to_string(label.entity + 1);
  if (label.kind == DofLabel::Kind::Modal)
    return "mode " + std::to_string(label.component + 1) + " of part " +
           std::to_string(label.entity + 1);
  const auto c = static_cast<std::size_t>(label.component);
  std::string text;
  text.reserve(40);
  if (c < names.size())
    text += names[c];
  else
    text.append("component ").append(std::to_string(label.component + 1));
  if (nodeName) return text + " of " + nodeName(label);
  text.append(" of node ").append(std::to_string(label.entity));
  if (label.part != DofLabel::shared)
    text.append(" in part ").append(std::to_string(label.part + 1));
  return text;
}

int SecondOrderModel::lawIndex(const ScalarLaw& law) {
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (laws[i].name == law.name) return static_cast<int>(i);
  laws.push_back(law);
  return static_cast<int>(laws.size()) - 1;
}

namespace {

Sparse sumAt(double t, const std::vector<MatrixTerm>& terms, const std::vector<ScalarLaw>& laws,
             Eigen::Index n) {
  Sparse sum(n, n);
  for (const auto& term : terms)
    sum += laws[static_cast<std::size_t>(term.law)].value(t) * term.matrix;
  return sum;
}

std::vector<int> everyPoint(const PointLaw& law) {
  std::vector<int> points(static_cast<std::size_t>(law.size()));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

[[noreturn]] void inconsistent(const std::string& what) {
  throw ModelError("The second-order model is inconsistent: " + what);
}

bool finite(const Sparse& matrix) {
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      if (!std::isfinite(it.value())) return false;
  return true;
}

}  // namespace

Sparse SecondOrderModel::dampingAt(double t) const { return sumAt(t, damping, laws, mass.rows()); }
Sparse SecondOrderModel::stiffnessAt(double t) const {
  return sumAt(t, stiffness, laws, mass.rows());
}

Vector SecondOrderModel::loadAt(double t) const {
  Vector sum = Vector::Zero(mass.rows());
  for (const auto& term : loads)
    sum += laws[static_cast<std::size_t>(term.law)].value(t) * term.vector;
  return sum;
}

Vector SecondOrderModel::pointForce(double t, const Vector& q, const Vector& qDot) const {
  Vector force = Vector::Zero(mass.rows());
  for (const auto& set : points) {
    const auto active = everyPoint(*set.law);
    const Vector d = set.offset + set.rows * q;
    const Vector v = set.rows * qDot;
    Vector f = Vector::Zero(d.size());
    set.law->evaluate(t, active, d.data(), v.data(), f.data());
    force += set.rows.transpose() * f;
  }
  return force;
}

Sparse SecondOrderModel::pointStiffness(double t, const Vector& q, const Vector& qDot) const {
  Sparse sum(mass.rows(), mass.rows());
  for (const auto& set : points) {
    const auto active = everyPoint(*set.law);
    const int width = set.law->width();
    const Vector d = set.offset + set.rows * q;
    const Vector v = set.rows * qDot;
    Vector f = Vector::Zero(d.size());
    Vector dfdd = Vector::Zero(d.size() * width);
    Vector dfdv = Vector::Zero(d.size() * width);
    set.law->evaluateWithTangent(t, active, d.data(), v.data(), f.data(), dfdd.data(), dfdv.data());
    Triplets triplets;
    for (int row = 0; row < set.law->size() * width; ++row)
      for (int column = 0; column < width; ++column)
        triplets.emplace_back(row, row / width * width + column, dfdd(row * width + column));
    Sparse tangent(d.size(), d.size());
    tangent.setFromTriplets(triplets.begin(), triplets.end());
    const Sparse rowsTransposed = set.rows.transpose();
    sum -= Sparse(rowsTransposed * Sparse(tangent * set.rows));
  }
  return sum;
}

std::vector<int> SecondOrderModel::loadsOnNothing() const {
  std::vector<char> determined(static_cast<std::size_t>(size()), 0);
  const auto note = [&](const Sparse& matrix, bool rows) {
    for (int k = 0; k < matrix.outerSize(); ++k)
      for (Sparse::InnerIterator it(matrix, k); it; ++it)
        if (it.value() != 0.0) {
          determined[static_cast<std::size_t>(it.col())] = 1;
          if (rows) determined[static_cast<std::size_t>(it.row())] = 1;
        }
  };
  note(mass, true);
  for (const auto* terms : {&damping, &stiffness})
    for (const auto& term : *terms) note(term.matrix, true);
  for (const auto& set : points) note(set.rows, false);
  std::vector<int> found;
  for (int i = 0; i < size(); ++i)
    if (determined[static_cast<std::size_t>(i)] == 0 &&
        std::any_of(loads.begin(), loads.end(),
                    [&](const LoadTerm& load) { return load.vector[i] != 0.0; }))
      found.push_back(i);
  return found;
}

void SecondOrderModel::validate() const {
  const auto n = mass.rows();
  if (mass.cols() != n) inconsistent("the mass matrix is not square.");
  if (static_cast<Eigen::Index>(dofs.size()) != n)
    inconsistent("the number of dof labels differs from the size of the mass matrix.");
  if (!finite(mass)) inconsistent("the mass matrix has an entry that is not finite.");
  const auto lawCount = static_cast<int>(laws.size());
  const auto checkTerms = [&](const std::vector<MatrixTerm>& terms, const char* kind) {
    for (const auto& term : terms) {
      const std::string who = std::string("the ") + kind + " term \"" + term.name + "\"";
      if (term.matrix.rows() != n || term.matrix.cols() != n)
        inconsistent(who + " has another size than the mass matrix.");
      if (term.law < 0 || term.law >= lawCount)
        inconsistent(who + " names a law that does not exist.");
      if (!finite(term.matrix)) inconsistent(who + " has an entry that is not finite.");
    }
  };
  checkTerms(damping, "damping");
  checkTerms(stiffness, "stiffness");
  for (const auto& term : loads) {
    if (term.vector.size() != n)
      inconsistent("the load \"" + term.name + "\" has another size than the mass matrix.");
    if (term.law < 0 || term.law >= lawCount)
      inconsistent("the load \"" + term.name + "\" names a law that does not exist.");
    if (!term.vector.allFinite())
      inconsistent("the load \"" + term.name + "\" has an entry that is not finite.");
  }
  for (const auto& set : points) {
    const auto coordinates = static_cast<Eigen::Index>(set.law->size()) * set.law->width();
    if (set.rows.rows() != coordinates || set.rows.cols() != n || set.offset.size() != coordinates)
      inconsistent("the point set \"" + set.name + "\" has rows that do not match its law.");
    if (!finite(set.rows) || !set.offset.allFinite())
      inconsistent("the point set \"" + set.name + "\" has a row or an offset that is not finite.");
  }
  if (initialDisplacement.size() != n || initialVelocity.size() != n)
    inconsistent("the initial state has another size than the mass matrix.");
  if (!initialDisplacement.allFinite() || !initialVelocity.allFinite())
    inconsistent("the initial state is not finite.");
}

std::vector<int> Substructure::interior() const {
  std::vector<char> kept(static_cast<std::size_t>(model.size()), 0);
  for (int i : interface) kept[static_cast<std::size_t>(i)] = 1;
  for (int i : retained) kept[static_cast<std::size_t>(i)] = 1;
  std::vector<int> positions;
  for (int i = 0; i < model.size(); ++i)
    if (!kept[static_cast<std::size_t>(i)]) positions.push_back(i);
  return positions;
}

}  // namespace tooljoint::model
