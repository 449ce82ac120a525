// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/AlignedParts.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "coupling/assembly/Congruence.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/DofLookup.hpp"
#include "model/DofNames.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;
using model::SecondOrderModel;

AlignedPart unchanged(const std::string& name, const SecondOrderModel& model) {
  AlignedPart part;
  part.name = name;
  part.model = &model;
  part.coordinates = model.size();
  part.offset = Vector::Zero(model.size());
  return part;
}

/// A with `more` zero rows and columns.
Sparse extended(const Sparse& A, Eigen::Index rows, Eigen::Index columns) {
  Sparse out = A;
  out.conservativeResize(rows, columns);
  return out;
}

/// Appends the interface dofs to the coordinates of a part that does not have them as coordinates.
void appendInterface(const reduction::DerivedInterface& boundary, AlignedPart& alignedPart) {
  auto m = std::make_shared<SecondOrderModel>(*alignedPart.model);
  const Eigen::Index n = m->size(), all = n + static_cast<Eigen::Index>(boundary.dofs.size());
  if (boundary.rows.rows() != all - n || boundary.rows.cols() != n ||
      boundary.offset.size() != all - n || boundary.forces < 0 ||
      (boundary.forces > 0 && boundary.forces != all - n))
    throw ModelError("Part \"" + alignedPart.name +
                     "\": the rows of its interface do not match its " + std::to_string(all - n) +
                     " interface dofs and " + std::to_string(n) + " coordinates.");
  changeEachMatrix(*m, [&](model::SharedSparse& A) { A = extended(A, all, all); });
  for (auto& load : m->loads) load.vector.conservativeResizeLike(Vector::Zero(all));
  for (auto& set : m->points) set.rows = extended(set.rows, set.rows.rows(), all);
  m->recovery = extended(m->recovery, m->recovery.rows(), all);
  m->initialDisplacement.conservativeResize(all);
  m->initialDisplacement.tail(all - n) = boundary.rows * m->initialDisplacement.head(n);
  m->initialVelocity.conservativeResize(all);
  m->initialVelocity.tail(all - n) = boundary.rows * m->initialVelocity.head(n);
  for (Eigen::Index i = n; i < all; ++i) alignedPart.interface.push_back(static_cast<int>(i));
  m->dofs.insert(m->dofs.end(), boundary.dofs.begin(), boundary.dofs.end());
  alignedPart.boundaryRows = boundary.rows;
  alignedPart.offset.conservativeResize(all);
  alignedPart.offset.tail(all - n) = boundary.offset;
  alignedPart.forces = boundary.forces;
  alignedPart.staticForces = boundary.staticForces;
  alignedPart.own = m;
  alignedPart.model = m.get();
}

}  // namespace

std::vector<AlignedPart> alignParts(const std::vector<reduction::ReducedSubstructure>& parts) {
  std::vector<AlignedPart> alignedParts;
  for (const auto& part : parts) {
    AlignedPart alignedPart = unchanged(part.name, part.model);
    alignedPart.reduced = true;
    const auto& known =
        part.derivedInterface ? part.basis->partition.retained : part.basis->partition.boundary;
    for (int i = 0; i < part.interface + part.retained; ++i) {
      (i < part.interface ? alignedPart.interface : alignedPart.retained).push_back(i);
      if (part.offset.size() > 0) alignedPart.offset[i] = part.offset[known[at(i)]];
    }
    if (part.derivedInterface) appendInterface(*part.derivedInterface, alignedPart);
    alignedParts.push_back(std::move(alignedPart));
  }
  return alignedParts;
}

std::vector<AlignedPart> alignParts(const std::vector<model::Substructure>& parts) {
  std::vector<AlignedPart> alignedParts;
  for (const auto& part : parts) {
    reduction::checkPart(part);
    AlignedPart alignedPart = unchanged(part.name, part.model);
    alignedPart.interface = part.interface;
    alignedPart.retained = part.retained;
    alignedParts.push_back(std::move(alignedPart));
  }
  return alignedParts;
}

void alignComponents(std::vector<AlignedPart>& alignedParts) {
  const auto first = alignedParts.front().model->componentNames;
  for (auto& alignedPart : alignedParts) {
    const auto& names = alignedPart.model->componentNames;
    if (names == first) continue;
    if (names.size() != first.size() ||
        !std::is_permutation(names.begin(), names.end(), first.begin()))
      throw ModelError("Parts \"" + alignedParts.front().name + "\" and \"" + alignedPart.name +
                       "\" have different node components: " + quotedList(first) +
                       " in the first and " + quotedList(names) + " in the second.");
    auto m = std::make_shared<SecondOrderModel>(*alignedPart.model);
    const int width = static_cast<int>(first.size());
    std::vector<int> to;  // of each component of the part
    for (const auto& name : names)
      to.push_back(static_cast<int>(std::find(first.begin(), first.end(), name) - first.begin()));
    for (auto& label : m->dofs)
      if (label.kind == DofLabel::Kind::Physical) label.component = to[at(label.component)];
    Triplets rows, order;
    Vector offset(m->recoveryOffset.size());
    for (int i = 0; i < m->recovery.rows(); ++i) {
      const int row = i / width * width + to[at(i % width)];
      offset[row] = m->recoveryOffset[i];
      order.emplace_back(row, i, 1.0);
      forEachInRow(m->recovery.sparse(), i,
                   [&](int column, double value) { rows.emplace_back(row, column, value); });
    }
    m->recovery = sparse(m->recovery.rows(), m->recovery.cols(), rows);
    m->recoveryOffset = offset;
    alignedPart.recoveryTurn = sparse(m->recovery.rows(), m->recovery.rows(), order);
    m->componentNames = first;
    alignedPart.own = m;
    alignedPart.model = m.get();
  }
}

namespace {

/// Removes entries that are rounding, such as cos(pi/2). They would give a massless dof 1e-33 of
/// the mass of its neighbour, and a scale would then treat it as a dof with mass.
Matrix3 withoutRounding(const Matrix3& axes) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  return (axes.array().abs() > rounding).select(axes, 0.0);
}

/// The frames of one part by node.
class PartFrames {
 public:
  void set(const Frame& frame) {
    if (frame.node == 0) {
      nodes_.clear();
      everywhere_ = withoutRounding(frame.axes);
      any_ = true;
    } else {
      nodes_[frame.node] = withoutRounding(frame.axes);
    }
  }
  bool empty() const { return !any_ && nodes_.empty(); }
  const std::map<std::int64_t, Matrix3>& nodes() const { return nodes_; }
  /// Null if the node has no frame.
  const Matrix3* of(std::int64_t node) const {
    const auto it = nodes_.find(node);
    return it != nodes_.end() ? &it->second : any_ ? &everywhere_ : nullptr;
  }

 private:
  std::map<std::int64_t, Matrix3> nodes_;
  Matrix3 everywhere_ = Matrix3::Identity();
  bool any_ = false;
};

void checkRotation(const Frame& frame) {
  const double defect =
      (frame.axes.transpose() * frame.axes - Matrix3::Identity()).cwiseAbs().maxCoeff();
  const std::string who =
      "The frame of " +
      (frame.node == 0 ? std::string("all nodes") : "node " + std::to_string(frame.node)) +
      " of part \"" + frame.part + "\"";
  if (!(defect <= 1e-8))
    throw ModelError(who + " is not a rotation: its axes are not orthonormal, |axes' axes - 1| = " +
                     formatNumber(defect) +
                     ". Give three unit vectors at right angles, as columns.");
  if (frame.axes.determinant() < 0)
    throw ModelError(
        who + " is not a rotation: its axes are left-handed. Reverse one of them, or swap two.");
}

/// Turns one part into the common frame.
class Turning {
 public:
  Turning(AlignedPart& alignedPart, const PartFrames& frames)
      : alignedPart_(alignedPart),
        frames_(frames),
        axes_(componentAxes(alignedPart.model->componentNames)) {}

  void run() {
    checkNodes();
    auto m = std::make_shared<SecondOrderModel>(*alignedPart_.model);
    const Sparse T = dofTurn();
    const Sparse back = T.transpose();
    turnRecovery(*m);
    substitute(*m, {T, Vector::Zero(T.rows()), m->dofs, back * m->initialDisplacement,
                    back * m->initialVelocity});
    alignedPart_.offset = back * alignedPart_.offset;
    const Eigen::Index n = alignedPart_.coordinates, more = T.rows() - n;
    if (more > 0)
      alignedPart_.boundaryRows =
          Sparse(Sparse(back.bottomRightCorner(more, more)) * alignedPart_.boundaryRows) *
          Sparse(T.topLeftCorner(n, n));
    alignedPart_.turn = T;
    alignedPart_.own = m;
    alignedPart_.model = m.get();
  }

 private:
  void checkNodes() const {
    for (const auto& [node, axes] : frames_.nodes()) {
      bool known = contains(alignedPart_.model->recoveryNodes, node);
      for (const auto& label : alignedPart_.model->dofs)
        known = known || (label.kind == DofLabel::Kind::Physical && label.entity == node);
      if (!known)
        throw ModelError("A frame is given for node " + std::to_string(node) + " of part \"" +
                         alignedPart_.name + "\", but the part has no such node.");
    }
  }

  /// q of the part = T * turned coordinates: blocks axes' for the vectors of each node.
  Sparse dofTurn() {
    const auto& dofs = alignedPart_.model->dofs;
    std::map<std::int64_t, std::map<int, int>> nodes;  // node -> component -> position
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (dofs[i].kind == DofLabel::Kind::Physical)
        nodes[dofs[i].entity][dofs[i].component] = static_cast<int>(i);
    Triplets entries;
    std::vector<char> turned(dofs.size(), 0);
    for (const auto& [node, positions] : nodes)
      if (const Matrix3* axes = frames_.of(node))
        for (const auto& vector : {axes_.translation, axes_.rotation})
          turnVector(positions, vector, *axes, entries, turned);
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (!turned[i]) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
    return sparse(sizeOf(dofs), sizeOf(dofs), entries);
  }

  /// One of the two vectors of a node: the named components, restricted to the dofs that the part
  /// has.
  void turnVector(const std::map<int, int>& positions, const std::array<int, 3>& vector,
                  const Matrix3& axes, Triplets& entries, std::vector<char>& turned) {
    std::vector<int> have;  // axes
    for (int a = 0; a < 3; ++a)
      if (vector[at(a)] >= 0 && positions.count(vector[at(a)]) > 0) have.push_back(a);
    if (have.empty()) return;
    const Matrix R = Matrix(axes(have, have)).transpose();
    const auto position = [&](int i) { return positions.at(vector[at(have[at(i)])]); };
    if ((R * R.transpose() - Matrix::Identity(R.rows(), R.cols())).cwiseAbs().maxCoeff() > 1e-8) {
      refusePartial(positions, vector, have);
      for (int i = 0; i < sizeOf(have); ++i)
        alignedPart_.unturned.insert(alignedPart_.model->dofs[at(position(i))]);
      return;
    }
    for (int i = 0; i < sizeOf(have); ++i) {
      turned[at(position(i))] = 1;
      for (int j = 0; j < sizeOf(have); ++j)
        if (R(i, j) != 0.0) entries.emplace_back(position(i), position(j), R(i, j));
    }
  }

  /// Rejects a frame that mixes dofs of an interface with dofs that the part does not have.
  void refusePartial(const std::map<int, int>& positions, const std::array<int, 3>& vector,
                     const std::vector<int>& have) const {
    const auto& names = alignedPart_.model->componentNames;
    std::vector<std::string> missing;
    for (int a = 0; a < 3; ++a)
      if (!contains(have, a))
        missing.push_back(vector[at(a)] >= 0 ? names[at(vector[at(a)])]
                                             : "component along axis " + std::to_string(a + 1));
    for (int a : have) {
      const int position = positions.at(vector[at(a)]);
      if (!contains(alignedPart_.interface, position)) continue;
      throw ModelError(
          "The frame of part \"" + alignedPart_.name + "\" mixes " +
          model::dofName(*alignedPart_.model, position) + " with " + quotedList(missing) +
          ", but these are not interface or retained dofs of the part. Make all of them interface "
          "dofs, or give a frame that rotates only the dofs the part has.");
    }
  }

  /// Turns the rows of the recovery of a node into the common frame, component by component.
  void turnRecovery(SecondOrderModel& m) {
    const int width = static_cast<int>(m.componentNames.size());
    if (m.recovery.rows() != static_cast<Eigen::Index>(m.recoveryNodes.size()) * width) return;
    Triplets entries;
    for (std::size_t n = 0; n < m.recoveryNodes.size(); ++n) {
      const int first = static_cast<int>(n) * width;
      const Matrix3* axes = frames_.of(m.recoveryNodes[n]);
      std::vector<char> done(at(width), 0);
      for (const auto& vector : {axes_.translation, axes_.rotation})
        for (int a = 0; axes != nullptr && a < 3; ++a) {
          if (vector[at(a)] < 0) continue;
          done[at(vector[at(a)])] = 1;
          for (int b = 0; b < 3; ++b)
            if (vector[at(b)] >= 0 && (*axes)(a, b) != 0.0)
              entries.emplace_back(first + vector[at(a)], first + vector[at(b)], (*axes)(a, b));
        }
      for (int c = 0; c < width; ++c)
        if (!done[at(c)]) entries.emplace_back(first + c, first + c, 1.0);
    }
    const Sparse R = sparse(m.recovery.rows(), m.recovery.rows(), entries);
    m.recovery = R * m.recovery;
    m.recoveryOffset = R * m.recoveryOffset;
    alignedPart_.recoveryTurn =
        alignedPart_.recoveryTurn.size() > 0 ? Sparse(R * alignedPart_.recoveryTurn) : R;
  }

  AlignedPart& alignedPart_;
  const PartFrames& frames_;
  ComponentAxes axes_;
};

}  // namespace

void turn(std::vector<AlignedPart>& alignedParts, const std::vector<Frame>& frames) {
  std::map<std::string, PartFrames> byPart;
  for (const auto& frame : frames) {
    partNumber(namesOf(alignedParts), frame.part, "A frame");
    checkRotation(frame);
    byPart[frame.part].set(frame);
  }
  for (auto& alignedPart : alignedParts) {
    const auto it = byPart.find(alignedPart.name);
    if (it != byPart.end() && !it->second.empty()) Turning(alignedPart, it->second).run();
  }
}

}  // namespace tooljoint::coupling
