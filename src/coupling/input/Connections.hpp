// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Connections of parts in addition to equal labels: frames, released dofs, linear constraints,
/// point laws between parts. All refer to nodes, components and names of parts, and to the common
/// frame if a node has its own frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::coupling {

/// A node of a part.
struct PartNode {
  std::string part;  ///< name of the part; empty: any part that has the node
  std::int64_t node = 0;
};

/// A dof of a part; an interface or a retained dof if the part is reduced.
struct PartDof {
  std::string part;  ///< name of the part; empty: the parts that have it share it
  std::int64_t node = 0;
  std::string component;  ///< one of the model's componentNames
};

/// factor * displacement of the dof, in the common frame.
struct Term {
  PartDof dof;
  double factor = 1;
};

/// sum_k factor_k d_k = value. [value: m, rad, or these times the unit of the factors]
struct Constraint {
  std::string name;  ///< for messages; empty: "constraint 3"
  std::vector<Term> terms;
  double value = 0;
  bool sameKind = false;  ///< the terms must be all translations or all rotations (tie() sets it)
};

/// The triad in which a part gives the dofs of a node. Its columns are the axes of the part in the
/// common frame, d_common = axes d_part, both for the three translations and for the three
/// rotations; in a plane (u, v, theta) a rotation about the third axis. The rotated components of
/// the node must all be boundary dofs of the part (interface or retained), or none of them.
struct Frame {
  std::string part;
  std::int64_t node = 0;  ///< 0: all nodes of the part (a later entry for a node replaces it)
  Matrix3 axes = Matrix3::Identity();
};

/// A point law on dofs of any parts: coordinate r of the law is offset_r + sum_k factor_k d_k.
struct Connector {
  std::string name;                            ///< of the point set
  std::shared_ptr<const model::PointLaw> law;  ///< src/model/laws/Connectors.hpp, or any other
  std::vector<std::vector<Term>> rows;         ///< size() * width() of the law, point by point
  Vector offset;                               ///< likewise; zero if empty
};

/// All connections of parts other than labels.
struct Connections {
  std::vector<Frame> frames;
  std::vector<PartDof> released;  ///< dofs that are not joined although their labels are equal
                                  ///< (hinges, slides); without a part: released in every part
  std::vector<Constraint> constraints;
  std::vector<Connector> connectors;
  /// True if a component of a node, or any component if none is given, is released, so that parts
  /// can move apart there.
  bool releases(std::int64_t node, const std::string& component = "") const {
    return std::any_of(released.begin(), released.end(), [&](const PartDof& dof) {
      return dof.node == node && (component.empty() || dof.component == component);
    });
  }
  bool empty() const {
    return frames.empty() && released.empty() && constraints.empty() && connectors.empty();
  }
};

/// Method that enforces constraints and equal labels.
enum class Assembly {
  Primal,  ///< coordinates are eliminated: q = L z
  Dual,  ///< every part keeps its coordinates; Lagrange multipliers, the forces between parts, are
         ///< additional massless coordinates
};

struct CouplingOptions {
  Assembly assembly = Assembly::Primal;
  Connections connections;
  bool requireAgreeingStarts = true;  ///< initial states that violate a constraint are an error
};

// Functions that make connections. Component names are recognised by meaning: "u" "v" "w" (or "x",
// "ux", "u_x" ...) are translations, "theta_x" "theta_y" "theta_z" (or "rx", "phi_x" ...)
// rotations; "theta" alone is the rotation in the plane. ModelError if a required one does not
// exist.

/// a = b.
Constraint tie(const PartDof& a, const PartDof& b);
/// A rigid link of `to` to `from`: u_to = u_from + theta_from x arm, theta_to = theta_from. One
/// constraint per existing component.
/// \param arm  from `from` to `to`, in the common frame [m]
std::vector<Constraint> rigidLink(const PartNode& from, const PartNode& to, const Vector3& arm,
                                  const model::ComponentNames& names);
/// The nodes share their translations and the rotations normal to the axis; they rotate freely
/// about the axis (of any length). The nodes must not be joined by their labels: give them
/// different numbers, or release the dofs.
std::vector<Constraint> hinge(const PartNode& a, const PartNode& b, const Vector3& axis,
                              const model::ComponentNames& names);
/// b's displacement minus a's along `direction` (normalised) in the common frame, as a row of a
/// connector. Missing components are omitted.
std::vector<Term> separation(const PartNode& a, const PartNode& b, const Vector3& direction,
                             const model::ComponentNames& names);

/// Unique node numbers for parts with their own numbers, as in files. A node of part p (0-based)
/// gets the number (p + 1) 10^k + node with the smallest sufficient k. All nodes of a joint get the
/// number of its first node, so that they are joined by their labels. Renames dofs, recovery nodes
/// and points. `interface` is kept and extended by the dofs of the joints. ModelError: a joint
/// names a part or node that does not exist, or two nodes of one part.
std::vector<model::Substructure> numberTogether(const std::vector<model::Substructure>& parts,
                                                const std::vector<std::vector<PartNode>>& joints);

}  // namespace tooljoint::coupling
