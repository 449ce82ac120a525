// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and the real and imaginary displacement halves of complex fixed-interface
/// modes, as real vectors: the part stays second order. Complex modes of damped components: T. K.
/// Hasselman, A. Kaplan, Dynamic analysis of large systems by complex mode synthesis, J. Dyn. Syst.
/// Meas. Control 96 (1974) 327-333; R. R. Craig Jr., Z. Ni, Component mode synthesis for model
/// order reduction of nonclassically damped systems, J. Guid. Control Dyn. 12 (1989) 577-584. Their
/// displacement halves as a real basis of a second-order model: F. Tisseur, K. Meerbergen, The
/// quadratic eigenvalue problem, SIAM Rev. 43 (2001) 235-286, section 3.10 and 5.2.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <complex>

#include "common/Error.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/part/InteriorStatics.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

/// Smallest fraction of a real or imaginary part (mass norm) that is independent of the other
/// vectors; a lightly damped mode has one independent part.
constexpr double independent = 1e-6;

/// The quadratic pencil of one interior block and the vectors taken from it.
struct DampedBlock {
  const InteriorBlock* block;
  Sparse C, K;
  std::unique_ptr<OrthonormalSet> set = {};
  Matrix floating = {};  ///< zero-energy modes; computed if the block floats

  /// True if its modes are real: no damping, gyroscopic or circulatory terms.
  bool conservative() const { return C.norm() == 0.0 && nearlySymmetric(K, 1e-13); }
};

/// One complex mode of one interior block.
struct ComplexMode {
  Complex value;  ///< s [1/s]
  DampedBlock* home = nullptr;
  Eigen::VectorXcd shape;
  double residual = 0;
};

/// Re and Im of e^(i alpha) phi, the longer one first. With this alpha they are M-orthogonal (phi'
/// M phi real without conjugate), and Im is as short as possible.
Matrix halves(const Eigen::VectorXcd& phi, const Sparse& M) {
  Matrix parts(phi.size(), 2);
  parts << phi.real(), phi.imag();
  const Matrix gram = parts.transpose() * (M * parts);
  const Complex turn =
      std::exp(Complex(0, -0.5 * std::arg(Complex(gram(0, 0) - gram(1, 1), 2.0 * gram(0, 1)))));
  const Eigen::VectorXcd turned = turn * phi;
  parts << turned.real(), turned.imag();
  return parts;
}

class ComplexCraigBampton : public ReductionMethod {
 public:
  explicit ComplexCraigBampton(const Teuchos::ParameterList& list)
      : time_(list.get<double>("Time")) {}

  Basis build(const PartView& part, const ModeRequest& request) const override {
    const int interior = sizeOf(part.partition().interior);
    std::vector<DampedBlock> blocks = makeBlocks(part);
    Taken taken;
    // Modes are sorted by |s| and give one or two vectors each. As many modes as requested vectors,
    // plus two beyond the cut, are therefore enough, or all.
    for (int perBlock = firstCount(blocks, request, interior);;
         perBlock = std::min(2 * perBlock, interior)) {
      taken = take(part, blocks, compute(part, blocks, perBlock), request);
      if (taken.enough || perBlock >= interior) break;
    }
    InteriorVectors vectors;
    vectors.groups = part.blockPositions();
    for (int i = 0; i < sizeOf(blocks); ++i)
      addRitzVectors(blocks[at(i)].block->symmetricStiffness, blocks[at(i)].block->mass,
                     blocks[at(i)].set->basis(), i, "complex mode", vectors);
    for (auto& vector : vectors.vectors) vector.residual = taken.residual;
    vectors.keepAll();
    const int found = vectors.kept;
    vectors.complete = found == interior;
    if (request.kind == ModeRequest::Kind::All && !vectors.complete)
      throw ConvergenceError(who(part) + "their real and imaginary parts span " +
                             std::to_string(found) + " of " + std::to_string(interior) +
                             " interior dofs. Choose the basis \"Craig-Bampton\".");
    vectors.method = std::to_string(taken.modes) + " complex modes";
    if (request.kind == ModeRequest::Kind::Count && found != request.count)
      vectors.remarks.push_back(
          "requested " + std::to_string(request.count) + " vectors, kept " +
          (vectors.complete
               ? "all " + std::to_string(interior)
               : std::to_string(found) + " to keep conjugate parts and close pairs together"));
    return fixedInterfaceBasis(part, vectors);
  }

 private:
  struct Taken {
    int modes = 0;
    bool enough = false;
    double residual = 0;
  };

  static constexpr const char* quantity = "complex fixed-interface modes";
  static std::string who(const PartView& part) { return part.who(quantity); }

  std::vector<DampedBlock> makeBlocks(const PartView& part) const {
    const Sparse C = part.model().dampingAt(time_), K = part.model().stiffnessAt(time_);
    std::vector<DampedBlock> blocks;
    for (int i = 0; i < part.blocks(); ++i) {
      const InteriorBlock& b = part.interiorBlock(i);
      blocks.push_back(
          {&b, block(C, b.positions, b.positions), block(K, b.positions, b.positions)});
      if (!blocks.back().conservative()) requireMass(part, b);
      if (b.floats()) blocks.back().floating = floatingModes(b);
    }
    return blocks;
  }

  /// Without mass a damped block has modes that do not vibrate and span no basis.
  static void requireMass(const PartView& part, const InteriorBlock& b) {
    if (!linalg::hasSingularMass(b.mass)) return;
    Eigen::Index least = 0;
    Vector(b.mass.diagonal()).minCoeff(&least);
    throw ModelError(who(part) + "the mass of its interior is singular, least at " +
                     b.name(static_cast<int>(least)) +
                     ". Give every interior dof a mass, retain the massless dofs, or "
                     "choose the basis \"Craig-Bampton\".");
  }

  static int firstCount(const std::vector<DampedBlock>& blocks, const ModeRequest& request,
                        int interior) {
    int count = interior;
    if (request.kind == ModeRequest::Kind::Count)
      count = request.count == 0 ? 0 : request.count + 2;
    if (request.kind == ModeRequest::Kind::Below) {
      count = 2;
      for (const auto& damped : blocks)
        count = std::max(count, 2 + linalg::eigenvaluesBelow(damped.block->symmetricStiffness,
                                                             damped.block->mass,
                                                             request.omegaMax * request.omegaMax));
    }
    return std::min(count, interior);
  }

  /// Up to `count` modes of every block (all of them if the block is not larger), by |s|.
  static std::vector<ComplexMode> compute(const PartView& part, std::vector<DampedBlock>& blocks,
                                          int count) {
    std::vector<ComplexMode> modes;
    for (auto& damped : blocks) {
      if (count == 0) break;
      try {
        append(damped, std::min(count, damped.block->size()), modes);
      } catch (const Error& error) {
        part.fail(quantity, error);
      }
    }
    std::stable_sort(modes.begin(), modes.end(), [](const ComplexMode& a, const ComplexMode& b) {
      return std::abs(a.value) < std::abs(b.value);
    });
    return modes;
  }

  static void append(DampedBlock& damped, int count, std::vector<ComplexMode>& modes) {
    const InteriorBlock& b = *damped.block;
    if (damped.conservative()) {
      linalg::EigenOptions options;
      options.name = b.name;
      const auto pairs = linalg::lowestModes(symmetricPart(damped.K), b.mass, count, options);
      for (Eigen::Index k = 0; k < pairs.values.size(); ++k)
        modes.push_back({std::sqrt(Complex(-pairs.values[k])), &damped,
                         pairs.vectors.col(k).cast<Complex>(), pairs.residuals[k]});
      return;
    }
    const auto found = count == b.size()
                           ? linalg::dampedModes(Matrix(b.mass), Matrix(damped.C), Matrix(damped.K))
                           : linalg::lowestDampedModes(b.mass, damped.C, damped.K, count, b.name);
    for (Eigen::Index k = 0; k < found.values.size(); ++k)
      if (found.values[k].imag() >= 0)
        modes.push_back({found.values[k], &damped, found.vectors.col(k), found.residuals[k]});
  }

  /// Takes modes by |s| until their parts fill the request.
  Taken take(const PartView& part, std::vector<DampedBlock>& blocks,
             const std::vector<ComplexMode>& modes, const ModeRequest& request) const {
    Taken taken;
    int vectors = 0;
    for (auto& damped : blocks) {
      damped.set = std::make_unique<OrthonormalSet>(damped.block->mass, independent, who(part));
      const bool wanted = request.kind != ModeRequest::Kind::Count || request.count > 0;
      for (Eigen::Index k = 0; wanted && k < damped.floating.cols(); ++k)
        vectors += damped.set->add(damped.floating.col(k)) ? 1 : 0;
    }
    Vector squares(sizeOf(modes));
    for (int k = 0; k < sizeOf(modes); ++k) squares[k] = std::norm(modes[at(k)].value);
    std::size_t last = modes.size();  // one past the last mode used
    for (std::size_t k = 0; k < last; ++k) {
      const bool full =
          (request.kind == ModeRequest::Kind::Count && vectors >= request.count) ||
          (request.kind == ModeRequest::Kind::Below && std::abs(modes[k].value) > request.omegaMax);
      if (full && last == modes.size()) {
        last =
            static_cast<std::size_t>(roundUp(squares, static_cast<int>(k), request.pairTolerance));
        taken.enough = k + 2 <= modes.size();
        if (k >= last) break;
      }
      ++taken.modes;
      taken.residual = std::max(taken.residual, modes[k].residual);
      vectors += addHalves(modes[k]);
    }
    taken.enough = taken.enough || request.kind == ModeRequest::Kind::All ||
                   (request.kind == ModeRequest::Kind::Count && request.count == 0);
    return taken;
  }

  /// Number of new halves of a mode; a half shorter than `tolerance` relative to the other is
  /// rounding.
  int addHalves(const ComplexMode& mode) const {
    OrthonormalSet& set = *mode.home->set;
    const Matrix parts = halves(mode.shape, mode.home->block->mass);
    int added = set.add(parts.col(0)) ? 1 : 0;
    if (set.norm(parts.col(1)) > independent * set.norm(parts.col(0)))
      added += set.add(parts.col(1)) ? 1 : 0;
    return added;
  }

  double time_;  ///< of the laws of damping and stiffness [s]
};

deck::ListSpec complexCraigBamptonParameters() {
  using deck::Range;
  deck::ListSpec list(
      "Complex Craig-Bampton",
      "Complex modes of the interior with its damping, gyroscopics and unsymmetric stiffness.");
  list.removed({"Independence"},
               "the part of a vector that must be new is a constant. Leave it out.");
  list.real("Time", "s", 0.0, Range::any(),
            "Time at which damping and stiffness are evaluated. Gyroscopic terms need a time at "
            "which the rotor turns.");
  return list;
}

const bool complexCraigBamptonRegistered = addMethod<ComplexCraigBampton>(
    "Complex Craig-Bampton",
    "Constraint modes and the real and imaginary parts of complex fixed-interface modes, for "
    "damped and gyroscopic parts (Hasselman and Kaplan 1974; Craig and Ni 1989).",
    complexCraigBamptonParameters());

}  // namespace

}  // namespace tooljoint::reduction
