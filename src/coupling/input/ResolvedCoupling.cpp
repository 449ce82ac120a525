// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/ResolvedCoupling.hpp"

#include <Eigen/Dense>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/LinkLoops.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;

constexpr const char* kStaticForce = "static force of released dofs";

class Planner {
 public:
  Planner(const std::vector<model::Substructure>& parts, const CouplingInput& input)
      : plan_(input) {
    out_.parts = parts;
    out_.options.assembly = input.assembly;
    if (out_.parts.empty()) throw ModelError("The model has no part to couple.");
    std::vector<PartOutline> outlines;
    for (const auto& part : parts) outlines.push_back({part.name, {}});
    checkNames(input, outlines, names());
    if (input.ownNumbers) numberTogetherByJoints(parts);
  }

  ResolvedCoupling run() {
    auto& c = out_.options.connections;
    for (const auto& one : plan_.frames) {
      Frame frame = one.frame;
      if (frame.node > 0) frame.node = translated({frame.part, frame.node}, one.path).node;
      c.frames.push_back(frame);
    }
    for (const auto& one : plan_.releases)
      for (const auto& component : one.components)
        release({translated(one.node, one.path), component});
    for (const auto& one : plan_.constraints) {
      Constraint constraint = one.constraint;
      for (auto& term : constraint.terms)
        term.dof.node = translated({term.dof.part, term.dof.node}, one.path).node;
      add(constraint);
    }
    LinkLoops loops(names());
    for (const auto& one : plan_.links) {
      const PartNode from = translated(one.from, one.path), to = translated(one.to, one.path);
      loops.add(place(from), place(to), one.arm, one.path);
      for (const auto& constraint : rigidLink(from, to, one.arm, names()))
        add(named(constraint, "rigid link", one.name));
    }
    for (const auto& one : plan_.hinges) addHinge(one);
    for (const auto& one : plan_.points) addPoint(one);
    // The static forces of released dofs are evaluated when all released dofs are known.
    if (plan_.keepStaticForces) keepStaticForces();
    return std::move(out_);
  }

 private:
  struct Released {
    PartNode node;
    std::string component;
  };

  const model::ComponentNames& names() const { return out_.parts.front().model.componentNames; }

  void numberTogetherByJoints(const std::vector<model::Substructure>& parts) {
    std::vector<std::vector<PartNode>> joints;
    for (const auto& joint : plan_.joints) joints.push_back(joint.nodes);
    out_.parts = numberTogether(parts, joints);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      auto& number = numbers_[parts[p].name];
      for (std::size_t i = 0; i < parts[p].model.dofs.size(); ++i)
        number[parts[p].model.dofs[i].entity] = out_.parts[p].model.dofs[i].entity;
      for (std::size_t i = 0; i < parts[p].model.recoveryNodes.size(); ++i)
        number[parts[p].model.recoveryNodes[i]] = out_.parts[p].model.recoveryNodes[i];
    }
  }

  /// The node with its present number.
  PartNode translated(const PartNode& node, const std::string& path) const {
    if (!plan_.ownNumbers) return node;
    if (node.part.empty())
      throw ModelError(
          path + " names node " + std::to_string(node.node) +
          " without its part, but every part has its own node numbers. Write PART:NODE.");
    const auto part = numbers_.find(node.part);
    if (part == numbers_.end()) return node;  // couple() throws
    const auto number = part->second.find(node.node);
    if (number == part->second.end())
      throw ModelError(path + " names node " + std::to_string(node.node) + " of part \"" +
                       node.part + "\", but the part has no such node.");
    return {node.part, number->second};
  }

  /// The representative of all parts that a joint connects at this node, unless a dof is released
  /// there.
  LinkLoops::Node place(const PartNode& node) const {
    return {out_.options.connections.releases(node.node) ? node.part : "", node.node};
  }

  /// Calls visit(part, position) for every part that has the dof.
  template <class Visit>
  void everywhere(const PartDof& dof, Visit&& visit) {
    const auto component = std::find(names().begin(), names().end(), dof.component);
    const auto label =
        DofLabel::physical(dof.node, static_cast<std::int32_t>(component - names().begin()));
    for (auto& part : out_.parts) {
      if (!dof.part.empty() && dof.part != part.name) continue;
      const auto it = std::find(part.model.dofs.begin(), part.model.dofs.end(), label);
      if (it != part.model.dofs.end()) visit(part, static_cast<int>(it - part.model.dofs.begin()));
    }
  }

  /// Retains the dof of a connection; in a frame all dofs of its node.
  void retain(const PartDof& dof) {
    everywhere(dof, [&](model::Substructure& part, int position) {
      retain(part, position);
      if (frameOf(part.name, dof.node) != nullptr)
        for (int i = 0; i < part.model.size(); ++i)
          if (part.model.dofs[at(i)].entity == dof.node) retain(part, i);
    });
  }
  static void retain(model::Substructure& part, int position) {
    if (contains(part.interface, position) || contains(part.retained, position)) return;
    part.retained.insert(std::lower_bound(part.retained.begin(), part.retained.end(), position),
                         position);
  }

  /// Displacement of the dof in the reference state, in the common frame; 0 if the parts have no
  /// reference state.
  double reference(const PartDof& dof) {
    double value = 0;
    everywhere(dof, [&](model::Substructure& part, int position) {
      if (part.reference.size() == 0) return;
      value = part.reference[position];
      if (const Frame* frame = frameOf(part.name, dof.node)) value = turned(part, *frame, dof);
    });
    return value;
  }
  const Frame* frameOf(const std::string& part, std::int64_t node) const {
    const Frame* found = nullptr;
    for (const auto& frame : out_.options.connections.frames)
      if (frame.part == part &&
          (frame.node == node || (frame.node == 0 && (found == nullptr || found->node == 0))))
        found = &frame;
    return found;
  }
  /// d_common = axes d_part
  double turned(const model::Substructure& part, const Frame& frame, const PartDof& dof) const {
    const ComponentAxes axes = componentAxes(names());
    const auto component = static_cast<int>(
        std::find(names().begin(), names().end(), dof.component) - names().begin());
    for (const auto& triad : {axes.translation, axes.rotation})
      for (int a = 0; a < 3; ++a) {
        if (triad[at(a)] != component) continue;
        double value = 0;
        for (int b = 0; b < 3; ++b)
          for (int i = 0; i < part.model.size(); ++i)
            if (part.model.dofs[at(i)] == DofLabel::physical(dof.node, triad[at(b)]))
              value += frame.axes(a, b) * part.reference[i];
        return value;
      }
    return 0;
  }

  void add(Constraint constraint) {
    for (const auto& term : constraint.terms) {
      retain(term.dof);
      constraint.value += term.factor * reference(term.dof);
    }
    out_.options.connections.constraints.push_back(constraint);
  }

  void release(const Released& one) {
    released_.push_back(one);
    out_.options.connections.released.push_back({one.node.part, one.node.node, one.component});
  }

  /// Sets the name used in the deck, since node numbers differ here.
  static Constraint named(Constraint constraint, const std::string& kind, const std::string& name) {
    constraint.name =
        kind + " \"" + name + "\"" + constraint.name.substr(constraint.name.rfind(", "));
    return constraint;
  }

  void addHinge(const HingeInput& one) {
    const PartNode first = translated(one.first, one.path),
                   second = translated(one.second, one.path);
    if (first.node == second.node)
      for (const auto& component : names()) {
        bool joined = false;
        everywhere({second.part, second.node, component}, [&](model::Substructure& part, int i) {
          joined = joined || contains(part.interface, i);
        });
        if (joined) release({second, component});
      }
    for (const auto& constraint : hinge(first, second, one.axis, names()))
      add(named(constraint, "hinge", one.name));
  }

  /// Separation along a direction, or of a component; the displacement of `first` if there is no
  /// second node.
  std::vector<Term> row(const PointInput& one, const PartNode& first,
                        const std::optional<PartNode>& second, const Vector3& direction) const {
    std::vector<Term> terms;
    if (!one.component.empty()) {
      if (second) terms.push_back({{second->part, second->node, one.component}, 1.0});
      terms.push_back({{first.part, first.node, one.component}, second ? -1.0 : 1.0});
      return terms;
    }
    for (const auto& term : separation(second ? first : PartNode{first.part, -1},
                                       second ? *second : first, direction, names()))
      if (term.dof.node != -1) terms.push_back(term);
    return terms;
  }

  void addPoint(const PointInput& one) {
    const PartNode first = translated(one.first, one.path);
    std::optional<PartNode> second;
    if (one.second) second = translated(*one.second, one.path);
    Connector connector;
    connector.name = one.name;
    connector.rows.push_back(row(one, first, second, one.direction.value_or(Vector3::Zero())));
    if (connector.rows.front().empty())
      throw ModelError(
          one.path +
          "/Direction has no part along the components of the node. Give another direction.");
    std::vector<Vector3> tangents;
    if (one.direction) {
      const Vector3 e = one.direction->normalized(), across = e.unitOrthogonal();
      if (componentAxes(names()).translation[2] < 0)
        tangents = {Vector3(-e.y(), e.x(), 0)};
      else
        tangents = {across, Vector3(e.cross(across))};
    }
    connector.law = one.law(1 + static_cast<int>(tangents.size()));
    const auto width = at(connector.law->width());
    if (width > 1 + tangents.size())
      throw DeckError(one.path + " has a law of " + std::to_string(width) +
                      " coordinates, but the connection has " +
                      std::to_string(1 + tangents.size()) +
                      ": the separation and, with a Direction, the motion across it.");
    for (std::size_t t = 0; t + 1 < width; ++t)
      connector.rows.push_back(row(one, first, second, tangents[t]));
    connector.offset = Vector::Zero(static_cast<Eigen::Index>(connector.rows.size()));
    for (std::size_t r = 0; r < connector.rows.size(); ++r)
      for (const auto& term : connector.rows[r]) {
        retain(term.dof);
        connector.offset[static_cast<Eigen::Index>(r)] -= term.factor * reference(term.dof);
      }
    out_.options.connections.connectors.push_back(connector);
  }

  /// r = K D_s - F - f(D_s) of constant terms: the force of the rest of the model on the part.
  static Vector jointForces(const model::Substructure& part) {
    const auto& m = part.model;
    Vector force = reduction::constantStiffness(m) * part.reference -
                   m.pointForce(0.0, part.reference, Vector::Zero(m.size()));
    for (const auto& load : m.loads)
      if (m.laws[at(load.law)].isOne()) force -= load.vector;
    return force;
  }

  void keepStaticForces() {
    std::map<std::string, Vector> forces, loads;
    const auto force = [&](const model::Substructure& part) -> const Vector& {
      auto& known = forces[part.name];
      if (known.size() == 0) known = jointForces(part);
      return known;
    };
    const auto put = [&](const model::Substructure& part, int i, double value) {
      auto& load = loads[part.name];
      if (load.size() == 0) load = Vector::Zero(part.model.size());
      load[i] += value;
    };
    std::set<std::pair<std::string, DofLabel>> done;
    for (const auto& one : released_)
      everywhere(
          {one.node.part, one.node.node, one.component}, [&](model::Substructure& part, int i) {
            const auto label = part.model.dofs[at(i)];
            if (part.reference.size() == 0 || !done.insert({part.name, label}).second) return;
            if (frameOf(part.name, label.entity) != nullptr)
              throw ModelError("Node " + std::to_string(label.entity) + " of part \"" + part.name +
                               "\" is released in a rotated frame, where static forces cannot be "
                               "kept. Set \"Keep Static Forces\" to false.");
            const double value = force(part)[i];
            put(part, i, value);
            if (one.node.part.empty()) return;  // released in every part: each keeps its own force
            // The reaction on the rest of the model.
            everywhere({"", one.node.node, one.component},
                       [&, given = false](model::Substructure& other, int j) mutable {
                         if (given || other.name == part.name || isReleased(other.name, one))
                           return;
                         put(other, j, -value);
                         given = true;
                       });
          });
    for (auto& part : out_.parts)
      if (const auto it = loads.find(part.name); it != loads.end() && !it->second.isZero(0.0))
        part.model.loads.push_back({kStaticForce, it->second, 0});
  }
  bool isReleased(const std::string& part, const Released& one) const {
    return std::any_of(released_.begin(), released_.end(), [&](const Released& other) {
      return other.node.node == one.node.node && other.component == one.component &&
             (other.node.part == part || other.node.part.empty());
    });
  }

  const CouplingInput& plan_;
  ResolvedCoupling out_;
  std::map<std::string, std::map<std::int64_t, std::int64_t>> numbers_;
  std::vector<Released> released_;
};

}  // namespace

ResolvedCoupling resolve(const std::vector<model::Substructure>& parts,
                         const CouplingInput& input) {
  return Planner(parts, input).run();
}

}  // namespace tooljoint::coupling
