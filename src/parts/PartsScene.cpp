// SPDX-License-Identifier: BSD-3-Clause
#include "parts/PartsScene.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <tuple>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/ResolvedCoupling.hpp"
#include "model/SpeedLaw.hpp"
#include "parts/ContentEdits.hpp"
#include "parts/JointReader.hpp"
#include "parts/RestState.hpp"
#include "parts/TimeLaw.hpp"

namespace tooljoint::parts {

namespace {

using model::DofLabel;

class Builder {
 public:
  Builder(const PartsSettings& settings, const coupling::CouplingInput& given,
          const std::function<std::string(const std::string&)>& resolve)
      : settings_(settings), plan_(given), resolve_(resolve) {}

  PartsScene build() {
    read();
    unifyComponents();
    giveLoads();
    giveLaws();
    holdAndRetain();
    raise();
    join();
    refuseHeldAndFree();
    raise();
    auto resolved = coupling::resolve(plain(), plan_);
    scene_.parts = std::move(resolved.parts);
    scene_.coupling = std::move(resolved.options);
    nameNodes();
    return std::move(scene_);
  }

 private:
  const std::vector<ImportedPart>& imported() const { return settings_.imported; }

  template <class Work>
  void attempt(const std::string& where, const Work& work) {
    try {
      work();
    } catch (const DeckError& fault) {
      const std::string what = fault.what();
      faults_.push_back(where.empty() ? what
                                      : where + " " + what + (what.back() == '?' ? "" : "."));
    }
  }
  void raise() const {
    if (!faults_.empty()) throw DeckError(join_(faults_));
  }
  static std::string join_(const std::vector<std::string>& lines) {
    return tooljoint::join(lines, "\n");
  }

  /// Reads each file once, however many parts use it.
  void read() {
    std::map<std::string, PartContent> known;
    for (const auto& part : imported()) {
      const auto path = isPartText(part.file) ? part.file : resolve_(part.file);
      try {
        if (known.count(path) == 0) known.emplace(path, readPartEverywhere(path, part.name));
        scene_.contents.push_back(known.at(path));
        scene_.contents.back().part.name = part.name;
      } catch (const DeckError& fault) {
        faults_.push_back(part.where + "/File: " + fault.what());
      } catch (const ModelError& fault) {
        if (faults_.empty()) throw ModelError(part.where + "/File: " + fault.what());
      }
    }
    raise();
  }

  void unifyComponents() {
    model::ComponentNames names;
    for (const auto& content : scene_.contents)
      for (const auto& name : content.part.model.componentNames)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    for (std::size_t p = 0; p < scene_.contents.size(); ++p)
      if (imported()[p].turned) addTurned(scene_.contents[p], imported()[p].axes, names);
    for (const auto& frame : plan_.frames)
      for (const auto& content : scene_.contents)
        if (content.part.name == frame.frame.part) addTurned(content, frame.frame.axes, names);
    for (auto& content : scene_.contents) widen(content, names);
  }

  /// Adds components in which a turned part moves and that no part has.
  static void addTurned(const PartContent& content, const Matrix3& axes,
                        model::ComponentNames& names) {
    for (const auto& name : coupling::namesTurnedInto(content.part.model.componentNames, axes))
      if (std::none_of(names.begin(), names.end(),
                       [&](const auto& other) { return coupling::sameDirection(name, other); }))
        names.push_back(name);
  }

  int partNumber(const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t p = 0; p < imported().size(); ++p) {
      names.push_back(imported()[p].name);
      if (names.back() == name) return static_cast<int>(p);
    }
    const auto meant = closest(name, names);
    throw DeckError("names part " + inQuotes(name) + ", but " +
                    (meant.empty()
                         ? "the parts are " + quotedList(names)
                         : "no part has this name. Did you mean " + inQuotes(meant) + "?"));
  }

  void giveLoads() {
    for (const auto& load : settings_.loads)
      attempt(load.where, [&] {
        auto& content = scene_.contents[static_cast<std::size_t>(partNumber(load.part))];
        const auto at = positionsOf(content, std::to_string(load.node) + " " + load.component);
        Vector force = Vector::Zero(content.part.model.size());
        force[at.front()] = load.value;
        content.part.model.loads.push_back(
            {load.name, force, content.part.model.lawIndex({load.law, {}})});
        loaded_.emplace_back(load.where, static_cast<int>(&content - scene_.contents.data()),
                             content.part.model.dofs[static_cast<std::size_t>(at.front())]);
      });
  }

  void giveLaws() {
    std::set<std::string> used;
    for (auto& content : scene_.contents)
      for (auto& law : content.part.model.laws.own()) {
        if (law.isOne()) continue;
        used.insert(law.name);
        const auto it = std::find_if(settings_.laws.begin(), settings_.laws.end(),
                                     [&](const auto& one) { return one.name == law.name; });
        if (it != settings_.laws.end()) {
          law = *it;
          if (model::speedLaw(law) != nullptr) used.insert(rotarySpeedName);
        } else {
          faults_.push_back(settings_.where + "/Laws has no law " + inQuotes(law.name) +
                            ", but terms or loads of part " + inQuotes(content.part.name) + " (" +
                            content.file + ") use it. Add a list " + inQuotes(law.name) +
                            " with its Form.");
        }
      }
    for (const auto& law : settings_.laws)
      if (used.count(law.name) == 0)
        faults_.push_back(
            settings_.where + "/Laws/" + law.name +
            " has no effect: no part and no load uses it. Remove it, or correct its name.");
  }

  void holdAndRetain() {
    for (std::size_t p = 0; p < imported().size(); ++p) {
      const auto& given = imported()[p];
      auto& content = scene_.contents[p];
      std::vector<char> held(static_cast<std::size_t>(content.part.model.size()), 0);
      for (const auto& text : given.fixed)
        attempt(given.where + "/Fixed", [&] {
          for (int i : positionsOf(content, text)) held[static_cast<std::size_t>(i)] = 1;
        });
      std::set<int> kept(content.part.retained.begin(), content.part.retained.end());
      for (const auto& text : given.retained)
        attempt(given.where + "/Retained", [&] {
          const auto named = positionsOf(content, text);
          if (std::all_of(named.begin(), named.end(),
                          [&](int i) { return held[static_cast<std::size_t>(i)] != 0; }))
            throw DeckError("names " + inQuotes(text) +
                            ", whose dofs are all in Fixed of this part. Take it out of one of "
                            "the two");
          kept.insert(named.begin(), named.end());
        });
      for (int i = 0; i < content.part.model.size(); ++i) {
        if (!given.reduce) kept.insert(i);
        if (held[static_cast<std::size_t>(i)]) checkHeld(given, content, i);
      }
      const auto& inner = content.part.interface;
      content.part.retained.clear();
      for (int i : kept)
        if (!std::binary_search(inner.begin(), inner.end(), i)) content.part.retained.push_back(i);
      if (std::count(held.begin(), held.end(), char{0}) == 0)
        faults_.push_back(
            given.where +
            "/Fixed fixes every dof of the part. Remove the part, or free some dofs.");
      else
        hold(content, held);
    }
    for (const auto& [where, p, label] : loaded_)
      if (held_.count({p, label}) > 0)
        faults_.push_back(where + " acts on a fixed dof. Free the dof, or remove the load.");
  }

  void checkHeld(const ImportedPart& given, const PartContent& content, int i) {
    const auto& m = content.part.model;
    held_.insert(
        {static_cast<int>(&content - scene_.contents.data()), m.dofs[static_cast<std::size_t>(i)]});
    if (m.initialDisplacement[i] == 0.0 && m.initialVelocity[i] == 0.0) return;
    faults_.push_back(given.where + "/Fixed fixes " + dofName(m, i) + ", which " + content.file +
                      " starts at " + formatNumber(m.initialDisplacement[i]) + " with velocity " +
                      formatNumber(m.initialVelocity[i]) + ". A fixed dof must start at zero.");
  }

  /// Converts the joints of the list Parts to joints and releases of the coupling input.
  void join() {
    if (settings_.joints.empty()) return;
    plan_.ownNumbers = true;
    const JointReader reader(scene_.contents, held_, settings_.where + "/Joints");
    for (const auto& text : settings_.joints)
      attempt("", [&] {
        const auto joint = reader.read(text);
        for (const auto& side : joint.mixed)
          if (imported()[static_cast<std::size_t>(side)].turned)
            throw DeckError(
                settings_.where + "/Joints joins only some components in " + inQuotes(text) +
                ", and part \"" + imported()[static_cast<std::size_t>(side)].name +
                "\" is rotated: its rotation mixes them with others. Join all components along "
                "the three axes, or none.");
        plan_.joints.insert(plan_.joints.end(), joint.joints.begin(), joint.joints.end());
        plan_.releases.insert(plan_.releases.end(), joint.releases.begin(), joint.releases.end());
      });
  }

  /// Rejects dofs at nodes of equal numbers that are fixed in one part and free in another. Joints
  /// check this themselves.
  void refuseHeldAndFree() {
    if (plan_.ownNumbers) return;
    for (const auto& [p, label] : held_)
      for (const auto& other : scene_.contents) {
        const auto& m = other.part.model;
        const auto it = std::find(m.dofs.begin(), m.dofs.end(), label);
        if (label.kind != DofLabel::Kind::Physical || it == m.dofs.end()) continue;
        const auto& given = imported()[static_cast<std::size_t>(p)];
        faults_.push_back(given.where + "/Fixed fixes " + model::describe(label, m.componentNames) +
                          ", which is free in part " + inQuotes(other.part.name) +
                          ". Fix it in both, or give Joints or Coupling/Node Numbers \"Own\" where "
                          "equal numbers are different nodes.");
      }
  }

  /// The parts for coupling::resolve: their interface dofs are those that another part has.
  std::vector<model::Substructure> plain() {
    std::map<DofLabel, int> owners;
    for (const auto& content : scene_.contents)
      for (const auto& label : content.part.model.dofs) ++owners[label];
    std::vector<model::Substructure> parts;
    for (std::size_t p = 0; p < scene_.contents.size(); ++p) {
      parts.push_back(scene_.contents[p].part);
      auto& part = parts.back();
      std::set<int> kept(part.retained.begin(), part.retained.end());
      std::vector<int> joined;
      for (int i : part.interface) {
        const bool shared =
            !plan_.ownNumbers && owners.at(part.model.dofs[static_cast<std::size_t>(i)]) > 1;
        if (shared)
          joined.push_back(i);
        else
          kept.insert(i);
      }
      part.interface = joined;
      part.retained.assign(kept.begin(), kept.end());
      if (imported()[p].turned) {
        coupling::FrameInput frame;
        frame.name = imported()[p].name;
        frame.path = imported()[p].where + "/Rotation Angle";
        frame.frame.part = imported()[p].name;
        frame.frame.axes = imported()[p].axes;
        for (const auto& given : plan_.frames)
          if (given.frame.part == frame.name && given.frame.node == 0)
            throw DeckError(imported()[p].where + "/Rotation Angle has no effect: " + given.path +
                            " gives the axes of the whole part. Leave one out.");
        plan_.frames.insert(plan_.frames.begin(), frame);  // frames of single nodes override it
      }
    }
    return parts;
  }

  void nameNodes() {
    for (std::size_t p = 0; p < scene_.parts.size(); ++p) {
      auto& now = scene_.parts[p].model;
      const auto& own = scene_.contents[p].part.model;
      std::set<std::int64_t> done;
      const auto note = [&](std::int64_t number, std::int64_t node) {
        if (done.insert(number).second) scene_.nodes[number].push_back({static_cast<int>(p), node});
      };
      for (std::size_t i = 0; i < now.dofs.size(); ++i) {
        if (now.dofs[i].kind == DofLabel::Kind::Physical)
          note(now.dofs[i].entity, own.dofs[i].entity);
        if (now.dofs[i].kind == DofLabel::Kind::Modal)
          now.dofs[i].entity = static_cast<std::int64_t>(p);
      }
      for (std::size_t i = 0; i < now.recoveryNodes.size(); ++i)
        note(now.recoveryNodes[i], own.recoveryNodes[i]);
    }
    std::vector<std::string> names;
    for (const auto& part : scene_.parts) names.push_back(part.name);
    const bool alone = names.size() < 2;
    const auto nodes = std::make_shared<const decltype(scene_.nodes)>(scene_.nodes);
    for (auto& part : scene_.parts)
      part.model.nodeName = [nodes, names, alone](const DofLabel& label) {
        const auto found = nodes->find(label.entity);
        if (found == nodes->end()) return "node " + std::to_string(label.entity);
        const NodeName* node = &found->second.front();
        for (const auto& one : found->second)
          if (one.part == label.part) node = &one;
        const std::string name = "node " + std::to_string(node->node);
        return alone ? name
                     : name + " of part " + inQuotes(names[static_cast<std::size_t>(node->part)]);
      };
  }

  const PartsSettings& settings_;
  coupling::CouplingInput plan_;
  const std::function<std::string(const std::string&)>& resolve_;
  PartsScene scene_;
  std::vector<std::string> faults_;
  std::set<std::pair<int, DofLabel>> held_;
  std::vector<std::tuple<std::string, int, DofLabel>> loaded_;
};

}  // namespace

int PartsScene::dofs() const {
  int sum = 0;
  for (const auto& part : parts) sum += part.model.size();
  return sum;
}

PartsScene buildScene(const PartsSettings& settings, const coupling::CouplingInput& given,
                      const std::function<std::string(const std::string&)>& resolve) {
  return Builder(settings, given, resolve).build();
}

namespace {

/// Checks a start of a dof that a constraint holds at `value`.
void requireHeldThere(const PartStart& start, double value) {
  constexpr double rounding = 1e-9;
  if (start.velocity == 0.0 &&
      std::abs(start.displacement - value) <= rounding * std::max(1.0, std::abs(value)))
    return;
  throw DeckError(start.where + " gives a start of a dof that a constraint holds at " +
                  formatNumber(value) + ". Leave it out.");
}

}  // namespace

Vector findStart(const PartsSettings& settings, double t, const model::NonlinearSolver& solver,
                 PartsScene& scene) {
  if (!settings.atRest && settings.starts.empty()) return {};
  auto options = scene.coupling;
  options.assembly = coupling::Assembly::Primal;
  options.requireAgreeingStarts = false;  // starts are computed here
  const auto full = coupling::coupleWithPositions(scene.parts, options);
  Vector z = settings.atRest ? restState(full.model, t, solver) : full.model.initialDisplacement;
  Vector zDot = settings.atRest ? Vector(Vector::Zero(z.size())) : full.model.initialVelocity;
  if (settings.atRest)
    for (std::size_t p = 0; p < scene.parts.size(); ++p)
      scene.parts[p].reference = full.maps[p] * z + full.offsets[p];
  const Vector rest = settings.atRest ? z : Vector();
  std::vector<std::pair<Vector, const PartStart*>> given;
  for (const auto& start : settings.starts) {
    const auto it =
        std::find_if(scene.contents.begin(), scene.contents.end(),
                     [&](const auto& content) { return content.part.name == start.part; });
    if (it == scene.contents.end())
      throw DeckError(start.where + "/Part names part " + inQuotes(start.part) +
                      ", but no part has this name.");
    int position = 0;
    try {
      position = positionsOf(*it, std::to_string(start.node) + " " + start.component).front();
    } catch (const DeckError& fault) {
      throw DeckError(start.where + " " + fault.what() + ".");
    }
    // z += row' v: rows of a primal coupling in turned frames are orthonormal; any other row would
    // not give the requested value
    const auto part = static_cast<std::size_t>(it - scene.contents.begin());
    const Vector row = Vector(full.maps[part].row(position).transpose());
    if (row.isZero(0.0)) {
      requireHeldThere(start, full.offsets[part][position]);
      continue;
    }
    if (std::abs(row.squaredNorm() - 1.0) > 1e-9)
      throw DeckError(start.where +
                      " gives a start of a dof that depends on others by a constraint. Give the "
                      "start of the independent dofs.");
    for (const auto& [other, first] : given)
      if (std::abs(row.dot(other)) > 1e-9)
        throw DeckError(start.where + " gives a start of the dof that " + first->where +
                        " starts: they are joined. Leave one of the two out.");
    given.emplace_back(row, &start);
    z += row * start.displacement;
    zDot += row * start.velocity;
  }
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    scene.parts[p].model.initialDisplacement = full.maps[p] * z + full.offsets[p];
    scene.parts[p].model.initialVelocity = full.maps[p] * zDot;
  }
  return rest;
}

}  // namespace tooljoint::parts
