// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A portal frame with a gable: five parts, one closed loop, nodes shared by three parts.
///
///             5
///           /   \            left rafter 4-5, right rafter 3-5
///         /       \           .
///       4 --------- 3        tie beam 4-3: the loop is 4-3-5
///       |           |
///       |           |        left column 1-4, right column 2-3
///       1           2        both feet clamped
///
/// Every member is a Substructure of plane beam elements (u, v, theta) in its own axes, u along the
/// member. Four ways to join them:
///
/// - primal: q_p = L_p z; equal labels become one coordinate in the common frame;
/// - dual: every part keeps its coordinates, and [K -B'; -B 0] enforces B q = 0; the multipliers
///   are the forces between the parts;
/// - system: characteristic constraint modes K_GG psi = omega^2 M_GG psi of all 9 joined dofs, 5
///   kept;
/// - local: the same for each of the three interfaces with the others held, 2 of each kept, which
///   is too few here (see below).
///
/// Each is compared with the frame assembled in one piece. Craig-Bampton is a Ritz method, so the
/// frequencies are above those of the one piece. Primal and dual assembly of the same reduced parts
/// agree to the last digits. An interface reduction also keeps the static response to the weight.
/// Local modes are meant for interfaces of many nodes: these have only three dofs each, and without
/// one of them the frame cannot sway.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <tooljoint/common/Constants.hpp>
#include <tooljoint/common/Error.hpp>
#include <tooljoint/common/Parallel.hpp>
#include <tooljoint/coupling/CoupledModes.hpp>
#include <tooljoint/coupling/Synthesis.hpp>
#include <tooljoint/linalg/trilinos/DirectSolver.hpp>
#include <tooljoint/reduction/methods/InterfaceBasis.hpp>

namespace {

using namespace tooljoint;

constexpr double kEA = 4.0e8, kEI = 6.0e5, kMass = 30.0;  // N, N m2, kg/m
constexpr int kElements = 10;                             // in each member
constexpr int kModes = 6;                                 // kept in each part
constexpr double kWeight = 9.81;

struct Member {
  std::string name;
  int from, to;
};

const std::map<int, std::array<double, 2>> corners{
    {1, {0, 0}}, {2, {6, 0}}, {3, {6, 4}}, {4, {0, 4}}, {5, {3, 6}}};
const std::vector<Member> members{{"left column", 1, 4},
                                  {"right column", 2, 3},
                                  {"tie beam", 4, 3},
                                  {"left rafter", 4, 5},
                                  {"right rafter", 3, 5}};

/// Length and direction cosines of a member.
struct Line {
  double length, c, s;
  explicit Line(const Member& m) {
    const double x = corners.at(m.to)[0] - corners.at(m.from)[0],
                 y = corners.at(m.to)[1] - corners.at(m.from)[1];
    length = std::hypot(x, y);
    c = x / length;
    s = y / length;
  }
};

/// Stiffness and consistent mass of an Euler-Bernoulli element along its own u.
void element(double l, Matrix& K, Matrix& M) {
  K = M = Matrix::Zero(6, 6);
  K(0, 0) = K(3, 3) = kEA / l;
  K(0, 3) = K(3, 0) = -kEA / l;
  M(0, 0) = M(3, 3) = kMass * l / 3;
  M(0, 3) = M(3, 0) = kMass * l / 6;
  const int i[4] = {1, 2, 4, 5};
  const double k[4][4] = {{12, 6 * l, -12, 6 * l},
                          {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                          {-12, -6 * l, 12, -6 * l},
                          {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
  const double m[4][4] = {{156, 22 * l, 54, -13 * l},
                          {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                          {54, 13 * l, 156, -22 * l},
                          {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      K(i[a], i[b]) = kEI / (l * l * l) * k[a][b];
      M(i[a], i[b]) = kMass * l / 420 * m[a][b];
    }
}

/// Members as one part: in their own axes (one member), or in the common ones.
model::Substructure part(const std::string& name, const std::vector<Member>& some, bool ownAxes) {
  model::Substructure out;
  out.name = name;
  auto& model = out.model;
  model.componentNames = {"u", "v", "theta"};
  std::map<int, int> first;  // node -> position of its u; -1: clamped
  Triplets stiffness, mass;
  std::vector<std::pair<int, double>> weight;
  for (const auto& member : some) {
    const Line line(member);
    const double l = line.length / kElements;
    Matrix K, M, T = Matrix::Identity(6, 6);  // own = T common
    element(l, K, M);
    if (!ownAxes)
      for (int k : {0, 3}) T.block<2, 2>(k, k) << line.c, line.s, -line.s, line.c;
    K = T.transpose() * K * T;
    M = T.transpose() * M * T;
    Vector down = Vector::Zero(6);  // the acceleration of gravity at both ends
    for (int k : {0, 3}) {
      down[k] = ownAxes ? -line.s : 0.0;
      down[k + 1] = ownAxes ? -line.c : -1.0;
    }
    const Vector load = kWeight * M * down;
    for (int e = 0; e < kElements; ++e) {
      const auto number = [&](int n) {
        return n == 0           ? member.from
               : n == kElements ? member.to
                                : 100 * member.from + 1000 * member.to + n;
      };
      for (int node : {number(e), number(e + 1)})
        if (first.count(node) == 0) {
          first[node] = node <= 2 ? -1 : static_cast<int>(model.dofs.size());
          for (int c = 0; c < 3 && node > 2; ++c)
            model.dofs.push_back(model::DofLabel::physical(node, c));
        }
      for (int i = 0; i < 6; ++i) {
        const int row = first[number(e + i / 3)];
        if (row < 0) continue;
        weight.emplace_back(row + i % 3, load[i]);
        for (int j = 0; j < 6; ++j)
          if (const int column = first[number(e + j / 3)]; column >= 0) {
            stiffness.emplace_back(row + i % 3, column + j % 3, K(i, j));
            mass.emplace_back(row + i % 3, column + j % 3, M(i, j));
          }
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(model.dofs.size());
  Sparse K(n, n);
  K.setFromTriplets(stiffness.begin(), stiffness.end());
  model.stiffness.push_back({"beams", K, 0});
  model.mass.resize(n, n);
  model.mass.setFromTriplets(mass.begin(), mass.end());
  Vector loads = Vector::Zero(n);
  for (const auto& [i, value] : weight) loads[i] += value;
  model.loads.push_back({"weight", loads, 0});
  model.initialDisplacement = model.initialVelocity = Vector::Zero(n);
  model.recovery.resize(0, n);
  for (int i = 0; i < n; ++i)
    if (some.size() == 1 && model.dofs[static_cast<std::size_t>(i)].entity <= 5)
      out.interface.push_back(i);
  return out;
}

/// Axes of each part: columns in the common frame.
std::vector<coupling::Frame> frames() {
  std::vector<coupling::Frame> list;
  for (const auto& member : members) {
    const Line line(member);
    Matrix3 axes;
    axes << line.c, -line.s, 0, line.s, line.c, 0, 0, 0, 1;
    list.push_back({member.name, 0, axes});
  }
  return list;
}

coupling::Synthesis join(coupling::Assembly assembly,
                         std::shared_ptr<const reduction::InterfaceBasis> interface) {
  std::vector<model::Substructure> parts;
  for (const auto& member : members) parts.push_back(part(member.name, {member}, true));
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {kModes};
  options.interface = std::move(interface);
  coupling::CouplingOptions how;
  how.assembly = assembly;
  how.connections.frames = frames();
  return coupling::synthesise(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList("Reduction")), options,
      how);
}

double hertz(double eigenvalue) { return std::sqrt(eigenvalue) / constants::twoPi; }

/// Static force that the rest of the frame exerts on a part at node 5, from the multipliers.
double forceAt(const coupling::Synthesis& dual, const std::string& name, int component) {
  const auto& model = dual.coupled.model;
  const Vector z = linalg::DirectSolver(model.stiffnessAt(0.0)).solve(model.loadAt(0.0));
  for (const auto& multiplier : dual.coupled.multipliers)
    if (multiplier.part == name && multiplier.dof.entity == 5 &&
        multiplier.dof.component == component)
      return multiplier.force(z);
  throw ModelError("No multiplier acts on part \"" + name + "\" at node 5.");
}

int run() {
  reduction::InterfaceOptions five, two;
  five.modes = 5;
  two.modes = 2;
  const auto whole = part("whole", members, false).model;
  const std::array<const char*, 4> names{"primal", "dual", "system", "local"};
  const std::array<coupling::Synthesis, 4> ways{
      join(coupling::Assembly::Primal, nullptr), join(coupling::Assembly::Dual, nullptr),
      join(coupling::Assembly::Primal, reduction::systemInterfaceModes(five)),
      join(coupling::Assembly::Primal, reduction::localInterfaceModes(two))};
  constexpr int count = 8;
  const Vector exact = coupling::lowestModes(whole, count).values;
  std::array<Vector, 4> found;
  for (std::size_t w = 0; w < ways.size(); ++w)
    found[w] = coupling::lowestModes(ways[w].coupled.model, count).values;

  const bool prints = parallel::rank() == 0;
  bool right = true;
  if (prints) {
    std::printf("one piece: %d dofs\n", whole.size());
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const auto& c = ways[w].coupled;
      std::printf("%-9s: %d dofs, %d of them join parts", names[w], c.model.size(),
                  static_cast<int>(c.interface.size()));
      if (c.interfaceModes >= 0)
        std::printf(": kept %d modes of %d joined dofs", c.interfaceModes, c.joinedDofs);
      if (!c.multipliers.empty()) std::printf(", %zu forces between parts", c.multipliers.size());
      std::printf("\n");
    }
    std::printf(
        "\nmode   one piece [Hz]      primal       dual     system      local   (relative "
        "error)\n");
  }
  for (int i = 0; i < count; ++i) {
    if (prints) std::printf("%4d   %14.6f", i + 1, hertz(exact[i]));
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const double error = std::sqrt(found[w][i] / exact[i]) - 1.0;
      if (prints) std::printf("  %+9.1e", error);
      right = right && error > -1e-9;  // Rayleigh-Ritz gives upper bounds
      if (w < 3) right = right && error < (w < 2 ? 1e-3 : 1e-2);
    }
    if (prints) std::printf("\n");
    right = right && std::abs(found[1][i] / found[0][i] - 1.0) < 1e-9;
  }
  // By symmetry the rafters exert no vertical force on each other at the apex, and their horizontal
  // forces are equal and opposite.
  const double push = forceAt(ways[1], "right rafter", 0),
               lift = forceAt(ways[1], "right rafter", 1);
  if (prints)
    std::printf(
        "\nweight at rest: the left rafter pushes the right one at the apex with %.3f N sideways "
        "and %.1e N up\n",
        push, lift);
  return right && std::abs(lift) < 1e-6 * std::abs(push) ? 0 : 1;
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
