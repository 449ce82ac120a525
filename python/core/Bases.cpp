// SPDX-License-Identifier: BSD-3-Clause
// Reduction bases written in Python: they are added to the registry and can be named like any other
// in a call, a deck or a study.
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Lists.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "reduction/methods/BasisBuilder.hpp"

namespace tooljoint::python {

namespace {

using reduction::Basis;
using reduction::ModeRequest;
using reduction::PartView;

/// A PartView for the time of a call.
struct LentPart {
  const PartView* view;
  const PartView& get() const {
    if (view == nullptr)
      throw UsageError(
          "A part is given to a basis for the time of its call. Copy what is needed later.");
    return *view;
  }
};

struct WrittenBasis {
  Kept build;
  py::dict names;
};

/// By name; changed and read with the GIL only, never destroyed.
std::map<std::string, WrittenBasis>& writtenBases() {
  static auto* bases = new std::map<std::string, WrittenBasis>;
  return *bases;
}

/// Constraint modes and the lowest Ritz vectors in the span of the vectors of build(part, count),
/// interior dofs x vectors.
class PythonBasis final : public reduction::ReductionMethod {
 public:
  PythonBasis(std::string name, Teuchos::ParameterList list)
      : name_(std::move(name)), list_(std::move(list)) {}

  Basis build(const PartView& part, const ModeRequest& request) const override {
    const int all = sizeOf(part.partition().interior);
    if (request.kind == ModeRequest::Kind::Count) return make(part, std::min(request.count, all));
    if (request.kind == ModeRequest::Kind::All) return make(part, all);
    for (int count = firstVectors;; count *= 2) {
      Basis basis = make(part, std::min(count, all));
      const int below = static_cast<int>(std::count_if(
          basis.eigenvalues.begin(), basis.eigenvalues.end(),
          [&](double value) { return reduction::signedOmega(value) <= request.omegaMax; }));
      if (below == basis.modes() && count < all) continue;
      reduction::truncate(basis, below, "above the cut-off frequency");
      return basis;
    }
  }

 private:
  static constexpr int firstVectors = 16;  ///< requested with a cut-off frequency, then doubled

  Basis make(const PartView& part, int count) const {
    const std::string who = "The basis \"" + name_ + "\"";
    Matrix X;
    fromPython(who, [&] {
      const auto& one = writtenBases().at(name_);
      const auto lent = std::make_shared<LentPart>(LentPart{&part});
      struct Withdraw {
        LentPart& part;
        ~Withdraw() { part.view = nullptr; }
      } const withdraw{*lent};
      const py::object made = (*one.build)(lent, count, **keywords(list_, one.names));
      requireReal(made, who);
      const py::object matrix = py::module_::import("numpy").attr("asarray")(made, "float64");
      if (py::len(matrix.attr("shape")) != 2)
        throw ModelError(who +
                         " returned an array that has not two dimensions; expected are interior "
                         "dofs x vectors.");
      X = matrix.cast<Matrix>();
    });
    const auto interior = static_cast<Eigen::Index>(part.partition().interior.size());
    if (X.rows() != interior)
      throw ModelError(who + " returned " + std::to_string(X.rows()) + " rows for part \"" +
                       part.part().name + "\"; expected are its " + std::to_string(interior) +
                       " interior dofs.");
    if (!X.allFinite())
      throw ModelError(who + " returned numbers that are not finite for part \"" +
                       part.part().name + "\".");
    return reduction::subspaceBasis(part, X, count, name_);
  }

  std::string name_;
  Teuchos::ParameterList list_;
};

void registerBasis(const std::string& name, const std::string& doc, const py::list& parameters,
                   const py::dict& names, const py::object& build) {
  auto& bases = writtenBases();
  const bool own = bases.count(name) != 0;
  auto& registry = reduction::MethodRegistry::instance();
  if (!own && registry.entries().count(name) != 0)
    throw UsageError("There is a basis \"" + name + "\" already. Choose another name.");
  if (own && !bases.at(name).names.equal(names))
    throw UsageError("The basis \"" + name +
                     "\" was registered with other parameters. Choose another name, or start "
                     "Python anew.");
  bases.insert_or_assign(name, WrittenBasis{Kept(build), names});
  if (own) return;
  registry.add(name,
               {doc, specFrom(name, doc, parameters), [name](const Teuchos::ParameterList& list) {
                  return std::make_unique<PythonBasis>(name, list);
                }});
}

}  // namespace

void bindBases(py::module_& module) {
  py::class_<LentPart, std::shared_ptr<LentPart>>(
      module, "PartView", "Data of a part for a basis; each is computed once, at its first use.")
      .def_property_readonly(
          "name", [](const LentPart& p) { return p.get().part().name; }, "Name of the part.")
      .def_property_readonly(
          "interior_mass",
          [](const LentPart& p) { return toScipy(Sparse(p.get().interiorMass())); },
          "M_II, interior x interior [kg].")
      .def_property_readonly(
          "interior_stiffness",
          [](const LentPart& p) { return toScipy(Sparse(p.get().symmetricInteriorStiffness())); },
          "sym(K)_II, interior x interior [N/m].")
      .def_property_readonly(
          "mass", [](const LentPart& p) { return toScipy(p.get().model().mass); },
          "M, dofs x dofs [kg].")
      .def_property_readonly(
          "stiffness",
          [](const LentPart& p) { return toScipy(Sparse(p.get().symmetricStiffness())); },
          "sym(K), dofs x dofs [N/m].")
      .def_property_readonly(
          "interior", [](const LentPart& p) { return toNumpy(p.get().partition().interior); },
          "Positions of the interior dofs.")
      .def_property_readonly(
          "boundary", [](const LentPart& p) { return toNumpy(p.get().partition().boundary); },
          "Positions of interface and retained dofs.")
      .def_property_readonly(
          "constraint_modes",
          [](const LentPart& p) { return toScipy(Sparse(p.get().constraintModes().vectors)); },
          "Static shapes of unit motions of the boundary, dofs x boundary.")
      .def(
          "solve_interior",
          [](const LentPart& p, const Matrix& loads) {
            return p.get().solveSymmetricInterior(loads);
          },
          py::arg("loads"), "sym(K)_II^-1 f for the columns of loads, interior x columns.");
  module.def("register_basis", &registerBasis, py::arg("name"), py::arg("doc"),
             py::arg("parameters"), py::arg("keywords"), py::arg("build"),
             "Register a basis written in Python.");
  module.def(
      "basis_names", [] { return reduction::MethodRegistry::instance().names(); },
      "Names of the available bases.");
}

}  // namespace tooljoint::python
