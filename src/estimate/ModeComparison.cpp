// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/ModeComparison.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <optional>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "coupling/CoupledModes.hpp"
#include "estimate/DynamicError.hpp"
#include "estimate/FrequencyEstimate.hpp"
#include "estimate/PartResidual.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "model/DofNames.hpp"
#include "model/HarmonicTangent.hpp"

namespace tooljoint::estimate {

namespace {

using constants::twoPi;
/// Full modes computed in addition to those compared, so that a repeated value is not cut, and
/// coupled modes in addition to the full ones, among which a shape is searched: the rigid-body
/// motions of one body.
constexpr int moreModes = 6;

/// R' J R for tangents J of all points of a set, width x width each, row-major.
Sparse onDofs(const model::PointSet& set, const Vector& tangents) {
  const auto rows = static_cast<int>(set.rows.rows()), width = set.law->width();
  Triplets entries;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < width; ++c)
      if (const double value = tangents[row * width + c]; value != 0)
        entries.emplace_back(row, row / width * width + c, value);
  Sparse tangent(rows, rows);
  tangent.setFromTriplets(entries.begin(), entries.end());
  return Sparse(set.rows.transpose()) * Sparse(tangent * set.rows);
}

/// -sum R' (df/dv) R of the point laws about the initial state.
Sparse pointDamping(const model::SecondOrderModel& model, double t) {
  Sparse sum(model.size(), model.size());
  for (const auto& set : model.points) {
    std::vector<int> active(static_cast<std::size_t>(set.law->size()));
    std::iota(active.begin(), active.end(), 0);
    const int width = set.law->width();
    const Vector d = set.offset + set.rows * model.initialDisplacement;
    const Vector v = set.rows * model.initialVelocity;
    Vector f = Vector::Zero(d.size()), dfdd = Vector::Zero(d.size() * width),
           dfdv = Vector::Zero(d.size() * width);
    set.law->evaluateWithTangent(t, active, d.data(), v.data(), f.data(), dfdd.data(), dfdv.data());
    sum -= onDofs(set, dfdv);
  }
  return sum;
}

/// Coordinates of part p.
ComplexMatrix localShapes(const coupling::Synthesis& synthesis, std::size_t p,
                          const ComplexMatrix& shapes) {
  return synthesis.coupled.maps[p].cast<Complex>() * shapes;
}

}  // namespace

double ModeComparison::fullHz() const {
  return (full.imag() < 0 ? -1.0 : 1.0) * std::abs(full) / twoPi;
}
double ModeComparison::coupledHz() const {
  return (coupled.imag() < 0 ? -1.0 : 1.0) * std::abs(coupled) / twoPi;
}
// -0 + 0 is 0
double ModeComparison::fullImHz() const { return full.imag() / twoPi + 0.0; }
double ModeComparison::coupledImHz() const { return coupled.imag() / twoPi + 0.0; }

Linearised linearise(const model::SecondOrderModel& model, double t) {
  return {reduction::symmetricPart(model.mass), model.dampingAt(t) + pointDamping(model, t),
          model.stiffnessAt(t) +
              model.pointStiffness(t, model.initialDisplacement, model.initialVelocity)};
}

Linearised linearise(const model::SecondOrderModel& model, double t, double omega) {
  return linearise(model, t, Complex(0.0, std::max(omega, model::slowestOmega)));
}

Linearised linearise(const model::SecondOrderModel& model, double t, Complex s) {
  auto matrices = linearise(model, t);
  for (const auto& set : model.points) {
    const auto* law = model::stateful(*set.law);
    if (law == nullptr || law->states() == 0) continue;
    const auto change =
        model::tangentByStates(*law, t, Vector(set.offset + set.rows * model.initialDisplacement),
                               Vector(set.rows * model.initialVelocity), s);
    const Eigen::Map<const ComplexVector> entries(change.data(), sizeOf(change));
    // entries = a + s b with real a and b
    const Vector b =
        s.imag() != 0.0 ? Vector(entries.imag() / s.imag()) : Vector(Vector::Zero(entries.size()));
    matrices.stiffness -= onDofs(set, entries.real() - s.real() * b);
    matrices.damping -= onDofs(set, b);
  }
  return matrices;
}

namespace {

/// z of the full model with D_p = maps[p] z in least squares: (sum_p m_p' m_p) z = sum_p m_p' D_p.
ComplexMatrix fitted(int size, const coupling::Synthesis& synthesis, const ComplexMatrix& shapes,
                     const std::vector<Sparse>& maps) {
  Eigen::SparseMatrix<double> normal(size, size);
  ComplexMatrix right = ComplexMatrix::Zero(size, shapes.cols());
  for (std::size_t p = 0; p < maps.size(); ++p) {
    const Eigen::SparseMatrix<double> transposed = maps[p].transpose();
    normal += Eigen::SparseMatrix<double>(transposed * maps[p]);
    const ComplexMatrix D =
        synthesis.parts[p].basis->vectors.cast<Complex>() * localShapes(synthesis, p, shapes);
    right.real() += transposed * D.real();
    right.imag() += transposed * D.imag();
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  if (solver.info() != Eigen::Success)
    throw ModelError(
        "A dof of the full model is not in any part. Full and coupled modes cannot be compared.");
  ComplexMatrix z(size, shapes.cols());
  z.real() = solver.solve(Matrix(right.real()));
  z.imag() = solver.solve(Matrix(right.imag()));
  return z;
}

}  // namespace

ComplexMatrix recover(const model::SecondOrderModel& full,
                      const std::vector<model::Substructure>& parts,
                      const coupling::Synthesis& synthesis, const ComplexMatrix& shapes,
                      const std::vector<Sparse>& maps) {
  if (!maps.empty()) return fitted(full.size(), synthesis, shapes, maps);
  std::map<model::DofLabel, Eigen::Index> position;
  for (std::size_t i = 0; i < full.dofs.size(); ++i)
    position[full.dofs[i]] = static_cast<Eigen::Index>(i);
  ComplexMatrix out = ComplexMatrix::Zero(full.size(), shapes.cols());
  std::vector<char> found(full.dofs.size(), 0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ComplexMatrix q = localShapes(synthesis, p, shapes);
    const ComplexMatrix D = synthesis.parts[p].basis->vectors.cast<Complex>() * q;
    for (std::size_t i = 0; i < parts[p].model.dofs.size(); ++i) {
      const auto it = position.find(parts[p].model.dofs[i]);
      if (it == position.end()) continue;
      out.row(it->second) = D.row(static_cast<Eigen::Index>(i));
      found[static_cast<std::size_t>(it->second)] = 1;
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!found[i])
      throw ModelError("The " + model::dofName(full, static_cast<Eigen::Index>(i)) +
                       " is not in any part. Full and coupled modes cannot be compared.");
  return out;
}

linalg::EigenPairs modesToCompare(const model::SecondOrderModel& full, int count) {
  return coupling::lowestModes(full, std::min(count + moreModes, full.size()));
}

ComplexVector undampedValues(const Sparse& K, const Sparse& M, const Vector& eigenvalues,
                             const Matrix& shapes) {
  ComplexVector values(eigenvalues.size());
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const Vector phi = shapes.col(j);
    const bool rigid = linalg::isRounding(eigenvalues[j] * phi.dot(M * phi), phi, K);
    values[j] = Complex(0, rigid ? 0.0 : reduction::signedOmega(eigenvalues[j]));
  }
  return values;
}

std::vector<ModeComparison> compareModes(const model::SecondOrderModel& full,
                                         const std::vector<model::Substructure>& parts,
                                         const coupling::Synthesis& synthesis, int count,
                                         const std::vector<Sparse>& maps) {
  return compareModes(full, modesToCompare(full, count), count, parts, synthesis, maps);
}

std::vector<ModeComparison> compareModes(const model::SecondOrderModel& full,
                                         const linalg::EigenPairs& exact, int count,
                                         const std::vector<model::Substructure>& parts,
                                         const coupling::Synthesis& synthesis,
                                         const std::vector<Sparse>& maps) {
  const Sparse mass = reduction::symmetricPart(full.mass);
  const model::SharedSparse stiffness = coupling::undampedStiffness(full);
  const auto& coupled = synthesis.coupled.model;
  const int looked = std::min(exact.count() + moreModes, coupled.size());
  const auto pairs = coupling::lowestPhysicalModes(coupled, looked);
  std::vector<FrequencyEstimate> estimates;
  const bool estimated = estimable(synthesis, [&] {
    estimates = estimateFrequencies(parts, synthesis, {looked, 0});
  });
  const ComplexMatrix shapes = recover(full, parts, synthesis, pairs.vectors.cast<Complex>(), maps);
  const ComplexVector values = undampedValues(stiffness, mass, exact.values, exact.vectors);
  const ComplexVector coupledValues = undampedValues(stiffness, mass, pairs.values, shapes.real());
  const auto matches =
      matchModes(mass, values, exact.vectors.cast<Complex>(), coupledValues, shapes);
  std::vector<ModeComparison> modes(
      static_cast<std::size_t>(std::min<Eigen::Index>(count, values.size())));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    ModeComparison& mode = modes[i];
    mode.full = values[static_cast<Eigen::Index>(i)];
    mode.coupledMode = matches[i].partner;
    mode.mac = matches[i].mac;
    mode.estimated = estimated && mode.coupledMode >= 0;
    mode.error = 1.0;
    if (mode.coupledMode < 0) continue;
    mode.coupled = coupledValues[mode.coupledMode];
    mode.error = mode.full == 0.0 ? 0.0 : mode.coupled.imag() / mode.full.imag() - 1.0;
    if (!estimated) continue;
    const auto& e = estimates[static_cast<std::size_t>(mode.coupledMode)];
    mode.estimate = e.error;
    mode.definite = e.definite;
  }
  return modes;
}

namespace {

/// Damped modes of the full and of the coupled model at one time.
class DampedComparison {
 public:
  DampedComparison(const model::SecondOrderModel& full,
                   const std::vector<model::Substructure>& parts,
                   const coupling::Synthesis& synthesis, double t, const std::vector<Sparse>& maps)
      : full_(full),
        parts_(parts),
        synthesis_(synthesis),
        t_(t),
        maps_(maps),
        whole_(linearise(full, t)),
        small_(linearise(synthesis.coupled.model, t)) {}

  std::vector<ModeComparison> lowest(int count) const {
    const auto exact = linalg::lowestDampedModes(whole_.mass, whole_.damping, whole_.stiffness,
                                                 std::min(count + moreModes, 2 * full_.size()),
                                                 model::namer(full_));
    const auto coupled =
        physicalDampedModes(synthesis_.coupled.model, small_, count + 2 * moreModes,
                            roundingOfParts(parts_, synthesis_));
    return match(exact, coupled, count, {});
  }

  std::vector<ModeComparison> near(linalg::DampedTarget target) const {
    const auto exact =
        linalg::dampedModesNear(whole_.mass, whole_.damping, whole_.stiffness, target);
    target.count = static_cast<int>(exact.values.size()) + moreModes;
    const auto coupled = physicalDampedModes(synthesis_.coupled.model, small_, target,
                                             roundingOfParts(parts_, synthesis_));
    return match(exact, coupled, exact.values.size(), target);
  }

 private:
  /// Compares the first `count` exact modes.
  std::vector<ModeComparison> match(const linalg::QuadraticModes& exact,
                                    const linalg::QuadraticModes& coupled, Eigen::Index count,
                                    const std::optional<linalg::DampedTarget>& target) const {
    ComplexVector errors;
    const bool estimated = !synthesis_.coupled.wholeInterfaces && estimable(synthesis_, [&] {
      const auto matrices = linearise(parts_, t_);
      errors =
          DynamicError(parts_, synthesis_, matrices).ofModes(matrices, small_, coupled, target);
    });
    const auto matches = matchModes(whole_.mass, exact.values, exact.vectors, coupled.values,
                                    recover(full_, parts_, synthesis_, coupled.vectors, maps_));
    std::vector<ModeComparison> modes(
        static_cast<std::size_t>(std::min<Eigen::Index>(count, exact.values.size())));
    for (std::size_t i = 0; i < modes.size(); ++i) {
      ModeComparison& mode = modes[i];
      mode.full = exact.values[static_cast<Eigen::Index>(i)];
      mode.coupledMode = matches[i].partner;
      mode.mac = matches[i].mac;
      mode.estimated = estimated && mode.coupledMode >= 0;
      mode.error = 1.0;
      if (mode.coupledMode < 0) continue;
      mode.coupled = coupled.values[mode.coupledMode];
      mode.error =
          mode.full == 0.0 ? 0.0 : std::abs(mode.coupled - mode.full) / std::abs(mode.full);
      if (estimated)
        mode.estimate =
            mode.coupled == 0.0 ? 0.0 : std::abs(errors[mode.coupledMode]) / std::abs(mode.coupled);
    }
    return modes;
  }

  const model::SecondOrderModel& full_;
  const std::vector<model::Substructure>& parts_;
  const coupling::Synthesis& synthesis_;
  double t_;
  const std::vector<Sparse>& maps_;
  Linearised whole_, small_;
};

}  // namespace

std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full,
                                               const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis, int count,
                                               double t, const std::vector<Sparse>& maps) {
  return DampedComparison(full, parts, synthesis, t, maps).lowest(count);
}

std::vector<ModeComparison> compareDampedModes(const model::SecondOrderModel& full,
                                               const std::vector<model::Substructure>& parts,
                                               const coupling::Synthesis& synthesis,
                                               const linalg::DampedTarget& target, double t,
                                               const std::vector<Sparse>& maps) {
  return DampedComparison(full, parts, synthesis, t, maps).near(target);
}

std::string comparisonTable(const std::vector<ModeComparison>& modes, bool damped) {
  std::string text =
      damped ? "         |s| [Hz]  Im s [Hz]   |s| [Hz]  Im s [Hz]    damping    damping\n"
               "  mode       full       full    coupled    coupled       full    coupled     MAC"
               "     error  estimate\n"
             : "  mode       full [Hz]    coupled [Hz]         MAC       error    estimate\n";
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const ModeComparison& m = modes[i];
    const std::string estimate = m.estimated ? fmt::format("{:9.2e}", m.estimate) : "        -";
    if (m.coupledMode < 0)
      text += fmt::format("  {:4}  {:14.8g}  no coupled mode corresponds\n", i + 1, m.fullHz());
    else if (damped)
      text += fmt::format(
          "  {:4} {:10.6g} {:10.6g} {:10.6g} {:10.6g} {:10.3e} {:10.3e} {:7.5f} {:9.2e} {}\n",
          i + 1, m.fullHz(), m.fullImHz(), m.coupledHz(), m.coupledImHz(), m.fullDamping(),
          m.coupledDamping(), m.mac, m.error, estimate);
    else
      text += fmt::format("  {:4}  {:14.8g}  {:14.8g}  {:10.7f}  {:10.2e}   {}{}\n", i + 1,
                          m.fullHz(), m.coupledHz(), m.mac, m.error, estimate,
                          m.definite ? "" : "  (modes are missing below)");
  }
  return text;
}

}  // namespace tooljoint::estimate
