// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/PartView.hpp"

#include <optional>
#include <utility>

#include "common/Interrupt.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/factor/FactorMemory.hpp"
#include "linalg/factor/MumpsFactor.hpp"
#include "model/DofNames.hpp"
#include "reduction/part/InteriorStatics.hpp"

namespace tooljoint::reduction {

namespace {

/// A value computed on first use.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) {
    if (!value_) value_.emplace(make());
    return *value_;
  }
  /// The value computed before.
  const T& value() const { return *value_; }

 private:
  std::optional<T> value_;
};

/// A stiffness whose skew part is below this, relative to its diagonal, is symmetric apart from
/// rounding in its assembly.
constexpr double roundingOfAssembly = 1e-14;

}  // namespace

/// Data shared by views of one part with different boundaries.
struct PartView::Stiffness {
  Lazy<model::SharedSparse> full, symmetric;
  Lazy<bool> isSymmetric;
};

/// Factors of a block; for a floating block with its zero-energy modes as a border.
struct PartView::Factor {
  linalg::DirectSolver solver;

  Matrix solve(const Matrix& loads) const {
    if (solver.size() == loads.rows()) return solver.solve(loads);
    Matrix bordered = Matrix::Zero(solver.size(), loads.cols());
    bordered.topRows(loads.rows()) = loads;
    return solver.solve(bordered).topRows(loads.rows());
  }
};

struct PartView::State {
  struct Block {
    Lazy<InteriorBlock> block;
    Lazy<Factor> full, symmetric;
  };

  State(std::shared_ptr<Stiffness> K, std::vector<int> joined, std::vector<int> held)
      : stiffness(std::move(K)), interface(std::move(joined)), retained(std::move(held)) {}

  std::shared_ptr<Stiffness> stiffness;
  std::vector<int> interface, retained;
  Lazy<Partition> partition;
  Lazy<model::SharedSparse> interiorStiffness, symmetricInteriorStiffness, interiorMass;
  std::vector<Block> blocks;
  Lazy<ConstraintModes> constraintModes;
  Lazy<PartView> unsupported;
};

PartView::PartView(const model::Substructure& part)
    : PartView(part, std::make_shared<State>(std::make_shared<Stiffness>(), part.interface,
                                             part.retained)) {}

PartView::PartView(const model::Substructure& part, std::shared_ptr<State> state)
    : part_(&part), state_(std::move(state)) {}

PartView PartView::withBoundary(std::vector<int> interface, std::vector<int> retained,
                                bool symmetric) const {
  if (!symmetric && interface == state_->interface && retained == state_->retained) return *this;
  auto stiffness = state_->stiffness;
  if (symmetric) {
    stiffness = std::make_shared<Stiffness>();
    symmetricStiffness();
    stiffness->full.get([&] { return state_->stiffness->symmetric.value(); });
  }
  return {*part_, std::make_shared<State>(stiffness, std::move(interface), std::move(retained))};
}

const PartView& PartView::unsupported() const {
  if (state_->interface.empty() && state_->retained.empty()) return *this;
  return state_->unsupported.get([&] { return withBoundary({}, {}); });
}

std::string PartView::dofName(Eigen::Index position) const {
  return model::dofName(model(), position);
}

std::string PartView::who(const std::string& what) const {
  return "Part \"" + part_->name + "\"" + (what.empty() ? "" : ", " + what) + ": ";
}

void PartView::fail(const std::string& what, const Error& error) const {
  if (error.code() == ExitCode::Interrupted) throw InterruptedError(error.what());
  if (error.code() == ExitCode::NotConverged) throw ConvergenceError(who(what) + error.what());
  throw ModelError(who(what) + error.what());
}

const Partition& PartView::partition() const {
  return state_->partition.get([&] {
    const Sparse& K = stiffness();
    return reduction::partition(model(), K, state_->interface, state_->retained);
  });
}

const Sparse& PartView::stiffness() const {
  return state_->stiffness->full.get([&]() -> model::SharedSparse {
    checkPart(*part_);
    const model::MatrixTerm* only = nullptr;
    int constant = 0;
    for (const auto& term : model().stiffness)
      if (model().laws[at(term.law)].isOne()) only = &term, ++constant;
    if (constant == 1) return only->matrix;
    return constantStiffness(model());
  });
}

const Sparse& PartView::symmetricStiffness() const {
  stiffness();
  return state_->stiffness->symmetric.get([&]() -> model::SharedSparse {
    const auto& K = state_->stiffness->full.value();
    if (linalg::isExactlySymmetric(K)) return K;
    return symmetricPart(K);
  });
}

bool PartView::symmetric() const {
  return state_->stiffness->isSymmetric.get([&] { return nearlySymmetric(stiffness(), 1e-13); });
}

const Sparse& PartView::interiorStiffness() const {
  stiffness();
  return state_->interiorStiffness.get(
      [&] { return interiorOf(partition(), state_->stiffness->full.value()); });
}

const Sparse& PartView::symmetricInteriorStiffness() const {
  interiorStiffness(), symmetricStiffness();
  return state_->symmetricInteriorStiffness.get([&] {
    const auto& [full, symmetric, isSymmetric] = *state_->stiffness;
    return symmetric.value().sharesWith(full.value()) ? state_->interiorStiffness.value()
                                                      : interiorOf(partition(), symmetric.value());
  });
}

const Sparse& PartView::interiorMass() const {
  return state_->interiorMass.get([&] { return interiorOf(partition(), model().mass); });
}

const InteriorBlock& PartView::interiorBlock(int number) const {
  const Partition& p = partition();
  state_->blocks.resize(p.blocks.size());
  return state_->blocks[at(number)].block.get([&] {
    InteriorBlock b;
    b.indices = p.blocks[at(number)];
    b.touched = p.touched[at(number)];
    for (int i : b.indices) b.positions.push_back(p.interior[at(i)]);
    b.stiffness = block(stiffness(), b.positions, b.positions);
    b.symmetricStiffness = block(symmetricStiffness(), b.positions, b.positions);
    b.mass = block(mass(), b.positions, b.positions);
    b.name = model::namer(model(), b.positions);
    return b;
  });
}

std::vector<std::vector<int>> PartView::blockPositions() const {
  std::vector<std::vector<int>> positions;
  for (int i = 0; i < blocks(); ++i) positions.push_back(interiorBlock(i).positions);
  return positions;
}

const PartView::Factor& PartView::factor(int number, bool symmetric) const {
  const InteriorBlock& b = interiorBlock(number);
  State::Block& cached = state_->blocks[at(number)];
  const bool own = symmetric && !nearlySymmetric(b.stiffness, roundingOfAssembly);
  return (own ? cached.symmetric : cached.full).get([&] {
    const Sparse& K = own ? b.symmetricStiffness : b.stiffness;
    const Matrix floating = b.floats() ? floatingModes(b) : Matrix(K.rows(), 0);
    const Matrix border = b.mass * floating;
    try {
      return Factor{
          linalg::DirectSolver(border.cols() > 0 ? bordered(K, border, border) : K, b.name)};
    } catch (const linalg::MemoryError&) {
      throw;
    } catch (const ModelError& error) {
      throw ModelError(who() + "its interior is a mechanism with its " +
                       std::to_string(partition().boundary.size()) +
                       " interface and retained dofs fixed" +
                       (own ? " (with the symmetric part of its stiffness)" : "") +
                       ". Retain more dofs there, or cut the part elsewhere. " + error.what());
    }
  });
}

Matrix PartView::solve(const Matrix& loads, bool symmetric) const {
  Matrix x = Matrix::Zero(loads.rows(), loads.cols());
  for (int i = 0; i < blocks(); ++i) {
    const auto& indices = partition().blocks[at(i)];
    const Matrix f = loads(indices, Eigen::all);
    if (!f.isZero(0.0)) x(indices, Eigen::all) = factor(i, symmetric).solve(f);
  }
  return x;
}

Matrix PartView::solveInterior(const Matrix& loads) const { return solve(loads, false); }
Matrix PartView::solveSymmetricInterior(const Matrix& loads) const { return solve(loads, true); }
Matrix PartView::solveBlock(int number, const Matrix& loads) const {
  stopIfInterrupted();
  return factor(number, false).solve(loads);
}

const linalg::DirectSolver* PartView::sharedFactors(int number) const {
  const InteriorBlock& b = interiorBlock(number);
  if (b.floats() || !linalg::suitsMumps(b.symmetricStiffness)) return nullptr;
  return &factor(number, true).solver;
}

void PartView::releaseFactors() const {
  for (int i = 0; i < sizeOf(state_->blocks); ++i)
    if (linalg::suitsMumps(interiorBlock(i).stiffness)) {
      state_->blocks[at(i)].full = {};
      state_->blocks[at(i)].symmetric = {};
      state_->constraintModes = {};
    }
}

const ConstraintModes& PartView::constraintModes() const {
  return state_->constraintModes.get([&] { return reduction::constraintModes(*this); });
}

}  // namespace tooljoint::reduction
