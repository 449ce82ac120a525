// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Couples two reduced halves of a rod.
///
/// A rod of length L, clamped at one end, obeys rho u_tt = E u_xx; its frequencies are f_n = (2n -
/// 1) c / 4L, c = sqrt(E/rho). Linear elements of length h give
///
///     K_e = (E A / h) [1 -1; -1 1],   M_e = (rho A h / 6) [2 1; 1 2].
///
/// Each half becomes a Substructure whose interface is the node in the middle. Craig-Bampton
/// replaces its interior by constraint modes and a few fixed-interface modes; the assembler joins
/// the halves because their interface dofs have equal labels. The frequencies of the coupled model
/// are above those of the mesh and close to the closed form.
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>
#include <cstdio>
#include <tooljoint/common/Constants.hpp>
#include <tooljoint/common/Error.hpp>
#include <tooljoint/common/Parallel.hpp>
#include <tooljoint/coupling/assembly/Assembler.hpp>
#include <tooljoint/linalg/trilinos/EigenSolver.hpp>
#include <tooljoint/reduction/Reduce.hpp>

namespace {

using namespace tooljoint;

constexpr double kLength = 100.0, kModulus = 2.1e11, kDensity = 7850.0, kArea = 1e-3;
constexpr int kElements = 200;  // in the whole rod

/// Elements first .. last (0-based) of the rod; node 0 is clamped and has no dof.
model::Substructure part(const std::string& name, int first, int last) {
  const double h = kLength / kElements;
  const double k = kModulus * kArea / h;
  const double m = kDensity * kArea * h / 6.0;
  model::Substructure half;
  half.name = name;
  auto& rod = half.model;
  rod.componentNames = {"u"};
  std::vector<int> dof(static_cast<std::size_t>(last - first + 2), -1);
  for (int node = first; node <= last + 1; ++node) {
    if (node == 0) continue;
    dof[static_cast<std::size_t>(node - first)] = static_cast<int>(rod.dofs.size());
    rod.dofs.push_back(model::DofLabel::physical(node + 1, 0));
  }
  Triplets stiffness, mass;
  for (int e = first; e <= last; ++e) {
    const int ends[2] = {dof[static_cast<std::size_t>(e - first)],
                         dof[static_cast<std::size_t>(e - first + 1)]};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        if (ends[i] < 0 || ends[j] < 0) continue;
        stiffness.emplace_back(ends[i], ends[j], i == j ? k : -k);
        mass.emplace_back(ends[i], ends[j], i == j ? 2.0 * m : m);
      }
  }
  const int n = static_cast<int>(rod.dofs.size());
  Sparse K(n, n);
  K.setFromTriplets(stiffness.begin(), stiffness.end());
  rod.stiffness.push_back({"rod", K, 0});
  rod.mass.resize(n, n);
  rod.mass.setFromTriplets(mass.begin(), mass.end());
  rod.initialDisplacement = rod.initialVelocity = Vector::Zero(n);
  rod.recovery.resize(0, n);
  for (int i = 0; i < n; ++i)  // the node of both halves
    if (rod.dofs[static_cast<std::size_t>(i)].entity == kElements / 2 + 1)
      half.interface.push_back(i);
  return half;
}

int run() {
  const std::vector<model::Substructure> parts{part("upper half", 0, kElements / 2 - 1),
                                               part("lower half", kElements / 2, kElements - 1)};
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {6};
  const auto basis = reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList("Reduction"));
  const auto reduced = reduction::reduceAll(parts, *basis, options);
  const auto coupled = coupling::couple(reduced);

  const int count = 4;
  const auto modes = linalg::lowestModes(coupled.stiffnessAt(0.0), coupled.mass, count);
  const double c = std::sqrt(kModulus / kDensity);
  bool right = true;
  if (parallel::rank() == 0)
    std::printf("%d + %d dofs reduced to %d\n", parts[0].model.size(), parts[1].model.size(),
                coupled.size());
  for (int i = 0; i < count; ++i) {
    const double found = std::sqrt(modes.values(i)) / constants::twoPi;
    const double exact = (2 * i + 1) * c / (4.0 * kLength);
    const double error = found / exact - 1.0;
    if (parallel::rank() == 0)
      std::printf("mode %d: %10.5f Hz, closed form %10.5f Hz, error %+.1e\n", i + 1, found, exact,
                  error);
    right = right && error > 0.0 && error < 1e-3;  // Rayleigh-Ritz gives upper bounds
  }
  return right ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    return run();
  } catch (const tooljoint::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
