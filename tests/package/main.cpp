// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A client of the installed package: a string from its deck to results, and two masses on springs
/// as a model of the toolkit,
///     M q'' + K q = f,   M = diag(2, 1) kg,   K = [3 -1; -1 1] N/m.
#include <Tpetra_Core.hpp>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <tooljoint/common/Error.hpp>
#include <tooljoint/common/Version.hpp>
#include <tooljoint/model/SecondOrderModel.hpp>

#include "StringCase.hpp"
#if __has_include("common/Error.hpp")
#error "Headers of Tooljoint are found without tooljoint/: they take names of the client's folders."
#endif

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard scope(&argc, &argv);
  runStringCase();
  using tooljoint::model::DofLabel;
  tooljoint::model::SecondOrderModel model;
  model.componentNames = {"u"};
  model.dofs = {DofLabel::physical(1, 0), DofLabel::physical(2, 0)};
  const tooljoint::Triplets mass{{0, 0, 2.0}, {1, 1, 1.0}};
  const tooljoint::Triplets stiffness{{0, 0, 3.0}, {0, 1, -1.0}, {1, 0, -1.0}, {1, 1, 1.0}};
  model.mass.resize(2, 2);
  model.mass.setFromTriplets(mass.begin(), mass.end());
  tooljoint::Sparse matrix(2, 2);
  matrix.setFromTriplets(stiffness.begin(), stiffness.end());
  model.stiffness.push_back({"springs", matrix, 0});
  const int sine = model.lawIndex({"sin", [](double t) { return std::sin(t); }});
  model.loads.push_back({"shaker", tooljoint::Vector::Unit(2, 1), sine});
  model.initialDisplacement = model.initialVelocity = tooljoint::Vector::Zero(2);
  model.validate();

  const double load = model.loadAt(0.5)(1);
  const double spring = model.stiffnessAt(0.5).coeff(0, 1);
  if (std::abs(load - std::sin(0.5)) > 1e-15 || std::abs(spring + 1.0) > 1e-15)
    throw std::runtime_error(
        "the installed library computes something else than the one that was built");

  // An inconsistent model must be refused, by an exception that crosses the library's border.
  model.dofs.pop_back();
  try {
    model.validate();
  } catch (const tooljoint::ModelError& error) {
    std::cout << "Tooljoint " << tooljoint::programVersion()
              << ", installed, works: " << model.size() << " dofs; refused: " << error.what()
              << "\n";
    return 0;
  }
  std::cerr << "a model with too few labels was accepted\n";
  return 1;
}
