// SPDX-License-Identifier: BSD-3-Clause
#include "Models.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <pybind11/stl.h>
#include <string>
#include <utility>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::python {

namespace {

using model::SecondOrderModel;
using Nodes = std::vector<std::int64_t>;
using Components = std::vector<std::int32_t>;

/// D of all nodes, in the order in which they first occur: row (node, component) has a 1 at its
/// dof.
void recoverAll(SecondOrderModel& model) {
  std::map<std::int64_t, int> number;
  Nodes nodes;
  for (const auto& dof : model.dofs)
    if (number.emplace(dof.entity, static_cast<int>(nodes.size())).second)
      nodes.push_back(dof.entity);
  const auto width = static_cast<int>(model.componentNames.size());
  Triplets entries;
  for (int i = 0; i < model.size(); ++i) {
    const auto& dof = model.dofs[at(i)];
    entries.emplace_back(number[dof.entity] * width + dof.component, i, 1.0);
  }
  Sparse recovery(static_cast<Eigen::Index>(nodes.size()) * width, model.size());
  recovery.setFromTriplets(entries.begin(), entries.end());
  model.recovery = recovery;
  model.recoveryOffset = Vector::Zero(model.recovery.rows());
  model.recoveryNodes = nodes;
}

/// Every dof has its own label, and every component a name.
void requireOwnNames(const SecondOrderModel& model) {
  std::map<std::string, std::size_t> position;
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (const auto [it, isNew] = position.emplace(describe(model.dofs[i], model.componentNames), i);
        !isNew)
      throw ModelError("Dofs " + std::to_string(it->second) + " and " + std::to_string(i) +
                       " are both " + it->first +
                       ". Give every dof a node and a component of its own.");
}

ModelPointer makeModel(const py::object& mass, const py::object& stiffness, const Nodes& nodes,
                       const Components& components, const std::vector<std::string>& names) {
  auto model = std::make_shared<SecondOrderModel>();
  model->mass = toSparse(mass, "mass matrix");
  model->stiffness.push_back({"stiffness", toSparse(stiffness, "stiffness matrix"), 0});
  model->componentNames = names;
  if (nodes.size() != components.size() || static_cast<int>(nodes.size()) != model->size())
    throw ModelError("The mass matrix has " + std::to_string(model->size()) + " rows, but " +
                     std::to_string(nodes.size()) + " nodes and " +
                     std::to_string(components.size()) + " components name them.");
  const Vector inertia = model->mass.diagonal();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (components[i] < 0 || components[i] >= static_cast<int>(names.size()))
      throw ModelError("Dof " + std::to_string(i) + " has component " +
                       std::to_string(components[i]) + ", but component_names has " +
                       std::to_string(names.size()) + " names. Give a name to each component.");
    if (inertia[static_cast<Eigen::Index>(i)] < 0)
      throw ModelError("The mass of dof " + std::to_string(i) + " is negative.");
    model->dofs.push_back(model::DofLabel::physical(nodes[i], components[i]));
  }
  requireOwnNames(*model);
  model->initialDisplacement = model->initialVelocity = Vector::Zero(model->size());
  recoverAll(*model);
  model->validate();
  return model;
}

/// The index of the law f(t) `function` of that name; None is the constant 1.
int lawOf(SecondOrderModel& model, const std::string& name, const py::object& function) {
  return function.is_none() ? 0 : model.lawIndex(lawOfTime(name, function));
}

py::dict terms(const model::SharedList<model::MatrixTerm>& list) {
  py::dict matrices;
  for (const auto& term : list) {
    const py::str name(term.name);
    const py::object matrix = toScipy(term.matrix);
    matrices[name] = matrices.contains(name) ? py::object(matrices[name]) + matrix : matrix;
  }
  return matrices;
}

CsrMatrix sum(const Sparse& matrix) { return toScipy(matrix); }

/// A refused change does not modify the model. Copies share unchanged data.
template <class Change>
void change(SecondOrderModel& model, const Change& make) {
  SecondOrderModel changed = model;
  make(changed);
  changed.validate();
  model = std::move(changed);
}

void addPoints(SecondOrderModel& model, const std::string& name,
               std::shared_ptr<const model::PointLaw> law, const py::object& rows, Vector offset,
               const Nodes& nodes) {
  model::PointSet set{name, std::move(law), nodes, toSparse(rows, "rows of the points"),
                      std::move(offset)};
  const Eigen::Index wanted = set.law->size() * set.law->width();
  if (set.rows.rows() != wanted || set.rows.cols() != model.size())
    throw ModelError("The rows of the points \"" + name + "\" are " +
                     std::to_string(set.rows.rows()) + " x " + std::to_string(set.rows.cols()) +
                     "; expected are " + std::to_string(wanted) + " x " +
                     std::to_string(model.size()) + ": coordinates of the points x dofs.");
  if (set.offset.size() == 0) set.offset = Vector::Zero(wanted);
  if (set.entities.empty()) set.entities.assign(at(set.law->size()), 0);
  change(model, [&](SecondOrderModel& changed) { changed.points.push_back(std::move(set)); });
}

std::vector<std::string> dofNames(const SecondOrderModel& model) {
  std::vector<std::string> names;
  for (const auto& dof : model.dofs) names.push_back(describe(dof, model.componentNames));
  return names;
}

/// SI unit of a coordinate: by the name of its component, that of a mass-normalised mode, or that
/// of a force between parts.
std::string unitOf(const SecondOrderModel& model, const model::DofLabel& dof) {
  if (dof.kind != model::DofLabel::Kind::Physical) return "m kg^0.5";
  const auto kind = coupling::kindOf(model.componentNames[at(dof.component)]);
  const bool turns = kind == coupling::ComponentKind::Rotation;
  if (dof.force != 0) return turns ? "N m" : "N";
  return turns ? "rad" : "m";
}

std::vector<std::string> dofUnits(const SecondOrderModel& model) {
  std::vector<std::string> units;
  for (const auto& dof : model.dofs) units.push_back(unitOf(model, dof));
  return units;
}

std::vector<std::string> componentUnits(const SecondOrderModel& model) {
  std::vector<std::string> units;
  for (std::size_t i = 0; i < model.componentNames.size(); ++i)
    units.push_back(unitOf(model, model::DofLabel::physical(1, static_cast<std::int32_t>(i))));
  return units;
}

void bindMatrices(py::class_<SecondOrderModel, ModelPointer>& type) {
  type.def_property_readonly(
          "mass", [](const SecondOrderModel& m) { return toScipy(m.mass); }, "M, dofs x dofs [kg].")
      .def(
          "stiffness", [](const SecondOrderModel& m, double t) { return sum(m.stiffnessAt(t)); },
          py::arg("t") = 0.0, "K(t), dofs x dofs [N/m].")
      .def(
          "damping", [](const SecondOrderModel& m, double t) { return sum(m.dampingAt(t)); },
          py::arg("t") = 0.0, "C(t), dofs x dofs [N s/m].")
      .def(
          "load", [](const SecondOrderModel& m, double t) { return m.loadAt(t); },
          py::arg("t") = 0.0, "F(t), dofs [N].")
      .def(
          "point_force",
          [](const SecondOrderModel& m, double t, const Numbers& q, const Numbers& v) {
            return m.pointForce(t, toVector(q, m.size(), "The displacement"),
                                toVector(v, m.size(), "The velocity"));
          },
          py::arg("t"), py::arg("q"), py::arg("v"),
          "Forces of the point laws on the dofs at this state [N].")
      .def_property_readonly(
          "stiffness_terms", [](const SecondOrderModel& m) { return terms(m.stiffness); },
          "Constant matrices of the stiffness by name.")
      .def_property_readonly(
          "damping_terms", [](const SecondOrderModel& m) { return terms(m.damping); },
          "Constant matrices of the damping by name.")
      .def_property_readonly(
          "recovery", [](const SecondOrderModel& m) { return toScipy(m.recovery); },
          "Rows (node, component) x dofs: D = recovery_offset + recovery q.")
      .def_property_readonly(
          "recovery_offset", [](const SecondOrderModel& m) { return m.recoveryOffset; },
          "D at q = 0, rows of the recovery.")
      .def_property_readonly(
          "recovery_nodes",
          [](const SecondOrderModel& m) { return toNumpy(Nodes(m.recoveryNodes)); },
          "Numbers of the recovered nodes.");
}

void bindChanges(py::class_<SecondOrderModel, ModelPointer>& type) {
  type.def(
          "add_damping",
          [](SecondOrderModel& m, const py::object& matrix, const std::string& name,
             const py::object& law) {
            change(m, [&](SecondOrderModel& changed) {
              const int index = lawOf(changed, name, law);
              changed.damping.push_back({name, toSparse(matrix, "damping matrix"), index});
            });
          },
          py::arg("matrix"), py::arg("name") = "damping", py::arg("law") = py::none(),
          "Add law(t) C; without a law C is constant. ModelError.")
      .def(
          "add_stiffness",
          [](SecondOrderModel& m, const py::object& matrix, const std::string& name,
             const py::object& law) {
            change(m, [&](SecondOrderModel& changed) {
              const int index = lawOf(changed, name, law);
              changed.stiffness.push_back({name, toSparse(matrix, "stiffness matrix"), index});
            });
          },
          py::arg("matrix"), py::arg("name"), py::arg("law") = py::none(),
          "Add law(t) K; without a law K is constant. ModelError.")
      .def(
          "add_load",
          [](SecondOrderModel& m, const Numbers& vector, const std::string& name,
             const py::object& law) {
            change(m, [&](SecondOrderModel& changed) {
              const Vector force = toVector(vector, changed.size(), "The load");
              const int index = lawOf(changed, name, law);
              changed.loads.push_back({name, force, index});
            });
          },
          py::arg("vector"), py::arg("name") = "load", py::arg("law") = py::none(),
          "Add law(t) F [N]; without a law F is constant. Equal names mean one law. ModelError.")
      .def("add_points", &addPoints, py::arg("name"), py::arg("law"), py::arg("rows"),
           py::arg("offset") = Vector(), py::arg("nodes") = Nodes(),
           "Add points with the forces rows^T f(d, d', t), d = offset + rows q [m]. ModelError.")
      .def(
          "set_start",
          [](SecondOrderModel& m, const Numbers& displacement, const Numbers& velocity) {
            change(m, [&](SecondOrderModel& changed) {
              changed.initialDisplacement = toVector(displacement, m.size(), "The displacement");
              changed.initialVelocity = toVector(velocity, m.size(), "The velocity");
            });
          },
          py::arg("displacement"), py::arg("velocity"),
          "q(0) [m] and q'(0) [m/s], dofs. ModelError.");
}

void bindParts(py::module_& module) {
  using model::Substructure;
  py::class_<Substructure, PartPointer>(
      module, "Part", "A part before its reduction: a model with an interface and retained dofs.")
      .def(py::init([](const std::string& name, const ModelPointer& model,
                       std::vector<int> interface, std::vector<int> retained) {
             auto part = std::make_shared<Substructure>(
                 Substructure{name, *model, std::move(interface), std::move(retained), Vector()});
             reduction::checkPart(*part);
             return part;
           }),
           py::arg("name"), py::arg("model"), py::arg("interface"), py::arg("retained"))
      .def_readonly("name", &Substructure::name, "Name of the part.")
      .def_property_readonly(
          "model", [](const PartPointer& part) { return ModelPointer(part, &part->model); },
          "The model; changes of it change the part.")
      .def_property_readonly(
          "interface", [](const Substructure& part) { return toNumpy(part.interface); },
          "Positions of the dofs that may be joined.")
      .def_property_readonly(
          "retained", [](const Substructure& part) { return toNumpy(part.retained); },
          "Positions of further dofs that remain coordinates.")
      .def_property_readonly(
          "interior", [](const Substructure& part) { return toNumpy(part.interior()); },
          "Positions of all other dofs.")
      .def("__len__", [](const Substructure& part) { return part.model.size(); })
      .def("__repr__", [](const Substructure& part) {
        return "<Part \"" + part.name + "\": " + std::to_string(part.model.size()) + " dofs, " +
               std::to_string(part.interface.size()) + " of them interface>";
      });
}

}  // namespace

model::ScalarLaw lawOfTime(const std::string& name, const py::object& function) {
  if (PyCallable_Check(function.ptr()) == 0)
    throw ModelError("The law of time \"" + name + "\" is " +
                     py::repr(function).cast<std::string>() +
                     ", which cannot be called. Give a function of the time.");
  const Kept kept(function);
  return {name, [kept, name](double t) {
            const std::string who = "The law of time \"" + name + "\"";
            double value = 0;
            fromPython(who, [&] { value = (*kept)(t).cast<double>(); });
            if (!std::isfinite(value))
              throw ModelError(who + " returned " + formatNumber(value) +
                               " at t = " + formatNumber(t) + " s; expected are finite numbers.");
            return value;
          }};
}

std::vector<model::Substructure> valuesOf(const std::vector<PartPointer>& parts) {
  std::vector<model::Substructure> values;
  for (const auto& part : parts) values.push_back(*part);
  return values;
}

void bindModels(py::module_& module) {
  py::class_<SecondOrderModel, ModelPointer> type(
      module, "Model", "M q'' + C(t) q' + K(t) q = F(t) + point forces; full, reduced or coupled.");
  type.def(py::init(&makeModel), py::arg("mass"), py::arg("stiffness"), py::arg("nodes"),
           py::arg("components"), py::arg("component_names"))
      .def("__len__", &SecondOrderModel::size)
      .def(
          "copy", [](const SecondOrderModel& m) { return std::make_shared<SecondOrderModel>(m); },
          "An independent model; matrices are shared until one of the models is changed.")
      .def_property_readonly("dof_names", &dofNames, "\"u of node 3\", one for each dof.")
      .def_property_readonly("dof_units", &dofUnits, "SI unit of each dof.")
      .def_property_readonly("component_units", &componentUnits,
                             "SI unit of each component of a node.")
      .def_property_readonly(
          "component_names",
          [](const SecondOrderModel& m) { return std::vector<std::string>(m.componentNames); },
          "Names of the components of a node.")
      .def_property_readonly(
          "initial_displacement", [](const SecondOrderModel& m) { return m.initialDisplacement; },
          "q(0) [m], dofs.")
      .def_property_readonly(
          "initial_velocity", [](const SecondOrderModel& m) { return m.initialVelocity; },
          "q'(0) [m/s], dofs.")
      .def(
          "position",
          [](const SecondOrderModel& m, std::int64_t node, const std::string& component) {
            const auto& names = m.componentNames;
            for (std::size_t i = 0; i < m.dofs.size(); ++i) {
              const auto& dof = m.dofs[i];
              if (dof.kind == model::DofLabel::Kind::Physical && dof.force == 0 &&
                  dof.entity == node && names[at(dof.component)] == component)
                return static_cast<int>(i);
            }
            throw ModelError("The model has no dof " + component + " of node " +
                             std::to_string(node) + ".");
          },
          py::arg("node"), py::arg("component"), "Position of a dof of a node. ModelError.")
      .def("__repr__", [](const SecondOrderModel& m) {
        return "<Model of " + std::to_string(m.size()) + " dofs>";
      });
  bindMatrices(type);
  bindChanges(type);
  bindParts(module);
}

}  // namespace tooljoint::python
