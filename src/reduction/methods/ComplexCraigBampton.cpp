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
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <utility>

#include "common/Error.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

using Complex = std::complex<double>;

struct ComplexOptions {
  double time = 0;  ///< of the laws of damping and stiffness [s]
  double tolerance = 1e-6;
};

/// The quadratic pencil of one link and the vectors taken of it.
struct Link {
  int index = 0;  ///< into Partition::links
  bool floats = false;
  linalg::DofNamer name;
  Sparse M, C, K, symmetricK;
  std::unique_ptr<OrthonormalSet> set;
  Matrix floating;  ///< zero-energy modes; computed when it floats

  int size() const { return static_cast<int>(M.rows()); }
  /// Its modes are real: nothing damps, gyrates or follows.
  bool conservative() const { return C.norm() == 0.0 && nearlySymmetric(K, 1e-13); }
};

/// One complex mode of one link.
struct ComplexMode {
  Complex value;  ///< s [1/s]
  Link* link = nullptr;
  Eigen::VectorXcd shape;
  double residual = 0;
};

/// Re and Im of e^(i alpha) phi, longer one first, with alpha such that they are M-orthogonal (phi'
/// M phi real without conjugate): then Im is as short as it can be.
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
  explicit ComplexCraigBampton(const ComplexOptions& options) : options_(options) {}

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    const Partition p = partition(part);
    const ConstraintModes constraint = constraintModes(part, p, constantStiffness(part.model));
    const int interior = static_cast<int>(p.interior.size());
    std::vector<Link> links = makeLinks(part, p);
    Taken taken;
    // Modes come by |s|; each gives one vector or two, so that as many as vectors are asked for,
    // and two to see the cut, are enough or all.
    for (int perLink = firstCount(links, request, interior);;
         perLink = std::min(2 * perLink, interior)) {
      auto modes = compute(part, links, perLink);
      taken = take(part, links, modes, request);
      if (taken.enough || perLink >= interior) break;
    }
    std::vector<ModalVector> vectors;
    double orthogonality = 0;
    for (const auto& link : links) {
      double defect = 0;
      for (auto& vector : ritzVectors(link.symmetricK, link.M, link.set->basis(), link.index,
                                      "complex mode", defect)) {
        vector.residual = taken.residual;
        vectors.push_back(vector);
      }
      orthogonality = std::max(orthogonality, defect);
    }
    const int found = static_cast<int>(vectors.size());
    if (request.kind == ModeRequest::Kind::All && found < interior)
      throw ConvergenceError(
          who(part) + "the halves of all of them span " + std::to_string(found) + " of " +
          std::to_string(interior) +
          " interior dofs. Lower \"Independence\", or take the basis \"Craig-Bampton\".");
    Basis basis = fixedInterfaceBasis(part, p, constraint, p.links, std::move(vectors));
    basis.orthogonality = orthogonality;
    basis.method = std::to_string(taken.modes) + " complex modes";
    if (request.kind == ModeRequest::Kind::Count && found != request.count)
      basis.remarks.push_back(
          "asked for " + std::to_string(request.count) + " vectors, kept " +
          (found == interior ? "all " + std::to_string(interior) + " there are"
                             : std::to_string(found) +
                                   " so as not to part the halves of a mode or a close pair"));
    return basis;
  }

 private:
  struct Taken {
    int modes = 0;
    bool enough = false;
    double residual = 0;
  };

  static std::string who(const model::Substructure& part) {
    return "Part \"" + part.name + "\", complex fixed-interface modes: ";
  }

  std::vector<Link> makeLinks(const model::Substructure& part, const Partition& p) const {
    const Sparse C = part.model.dampingAt(options_.time), K = part.model.stiffnessAt(options_.time);
    const Sparse constant = symmetricPart(constantStiffness(part.model));
    std::vector<Link> links(p.links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const auto inner = positionsOf(p, p.links[i]);
      Link& link = links[i];
      link.index = static_cast<int>(i);
      link.floats = p.ends[i].empty();
      link.name = namer(part, inner);
      link.M = block(part.model.mass, inner, inner);
      link.C = block(C, inner, inner);
      link.K = block(K, inner, inner);
      link.symmetricK = block(constant, inner, inner);
      if (link.floats) link.floating = floatingModes(link.symmetricK, link.M, link.name);
    }
    return links;
  }

  static int firstCount(const std::vector<Link>& links, const ModeRequest& request, int interior) {
    int count = interior;
    if (request.kind == ModeRequest::Kind::Count)
      count = request.count == 0 ? 0 : request.count + 2;
    if (request.kind == ModeRequest::Kind::Below) {
      count = 2;
      for (const auto& link : links)
        count = std::max(count, 2 + linalg::eigenvaluesBelow(link.symmetricK, link.M,
                                                             request.omegaMax * request.omegaMax));
    }
    return std::min(count, interior);
  }

  /// Up to `count` modes of every link (all of them where that is its size), by |s|.
  static std::vector<ComplexMode> compute(const model::Substructure& part, std::vector<Link>& links,
                                          int count) {
    std::vector<ComplexMode> modes;
    for (auto& link : links) {
      if (count == 0) break;
      try {
        append(link, std::min(count, link.size()), modes);
      } catch (const Error& error) {
        if (error.code() == ExitCode::NotConverged)
          throw ConvergenceError(who(part) + error.what());
        throw ModelError(who(part) + error.what());
      }
    }
    std::stable_sort(modes.begin(), modes.end(), [](const ComplexMode& a, const ComplexMode& b) {
      return std::abs(a.value) < std::abs(b.value);
    });
    return modes;
  }

  static void append(Link& link, int count, std::vector<ComplexMode>& modes) {
    if (link.conservative()) {
      linalg::EigenOptions options;
      options.name = link.name;
      const auto pairs = linalg::lowestModes(symmetricPart(link.K), link.M, count, options);
      for (Eigen::Index k = 0; k < pairs.values.size(); ++k)
        modes.push_back({std::sqrt(Complex(-pairs.values[k])), &link,
                         pairs.vectors.col(k).cast<Complex>(), pairs.residuals[k]});
      return;
    }
    const auto found = count == link.size()
                           ? linalg::dampedModes(Matrix(link.M), Matrix(link.C), Matrix(link.K))
                           : linalg::lowestDampedModes(link.M, link.C, link.K, count, link.name);
    for (Eigen::Index k = 0; k < found.values.size(); ++k)
      if (found.values[k].imag() >= 0)
        modes.push_back({found.values[k], &link, found.vectors.col(k), found.residuals[k]});
  }

  /// Modes by |s| until their halves answer the request.
  Taken take(const model::Substructure& part, std::vector<Link>& links,
             const std::vector<ComplexMode>& modes, const ModeRequest& request) const {
    Taken taken;
    int vectors = 0;
    for (auto& link : links) {
      link.set = std::make_unique<OrthonormalSet>(link.M, options_.tolerance, who(part));
      const bool wanted = request.kind != ModeRequest::Kind::Count || request.count > 0;
      for (Eigen::Index k = 0; wanted && k < link.floating.cols(); ++k)
        vectors += link.set->add(link.floating.col(k)) ? 1 : 0;
    }
    Vector squares(static_cast<Eigen::Index>(modes.size()));
    for (std::size_t k = 0; k < modes.size(); ++k)
      squares[static_cast<Eigen::Index>(k)] = std::norm(modes[k].value);
    std::size_t last = modes.size();  // one past the last mode taken
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

  /// Number of the halves of a mode that are new; one shorter than `tolerance` beside the other is
  /// rounding.
  int addHalves(const ComplexMode& mode) const {
    OrthonormalSet& set = *mode.link->set;
    const Matrix parts = halves(mode.shape, mode.link->M);
    int added = set.add(parts.col(0)) ? 1 : 0;
    if (set.norm(parts.col(1)) > options_.tolerance * set.norm(parts.col(0)))
      added += set.add(parts.col(1)) ? 1 : 0;
    return added;
  }

  ComplexOptions options_;
};

deck::ListSpec ownParameters() {
  using deck::Range;
  deck::ListSpec list(
      "Complex Craig-Bampton",
      "Complex modes of the interior with its damping, gyroscopics and unsymmetric stiffness.");
  list.real("Time", "s", 0.0, Range::any(),
            "When laws of time are looked at: damping and stiffness of the modes are those of this "
            "time. Gyroscopics need a time at which the rotor turns.");
  list.real("Independence", "", 1e-6, Range{0.0, 0.1, true, false},
            "The part of a half of a mode, measured by mass, that must be new for it to be taken; "
            "lightly damped modes have one half.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "Complex Craig-Bampton",
    {"Constraint modes and the real and imaginary halves of complex fixed-interface modes, for "
     "damped and gyroscopic parts (Hasselman and Kaplan 1974; Craig "
     "and Ni 1989).",
     ownParameters(), [](const Teuchos::ParameterList& given) {
       Teuchos::ParameterList list(given);  // an absent list has no defaults
       ComplexOptions options;
       options.time = list.get("Time", options.time);
       options.tolerance = list.get("Independence", options.tolerance);
       return std::unique_ptr<ReductionMethod>(new ComplexCraigBampton(options));
     }});

}  // namespace

}  // namespace tooljoint::reduction
