// SPDX-License-Identifier: BSD-3-Clause
// Parts as files, to be imported by decks.
#include <algorithm>
#include <cstdint>
#include <map>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Bind.hpp"
#include "Calls.hpp"
#include "Models.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "parts/file/PartFile.hpp"

namespace tooljoint::python {

namespace {

using Sets = std::map<std::string, std::vector<int>>;

parts::InterfaceSet interfaceSet(const model::SecondOrderModel& model, const std::string& name,
                                 const std::vector<int>& dofs) {
  parts::InterfaceSet set{name, dofs, {}};
  for (const int i : dofs) {
    if (i < 0 || i >= model.size())
      throw ModelError("The interface \"" + name + "\" names dof " + std::to_string(i) +
                       "; the part has " + std::to_string(model.size()) + ".");
    const auto node = model.dofs[at(i)].entity;
    if (std::find(set.nodes.begin(), set.nodes.end(), node) == set.nodes.end())
      set.nodes.push_back(node);
  }
  return set;
}

void write(const PartPointer& part, const std::string& path, const Sets& interfaces,
           const std::map<std::int64_t, Vector>& positions) {
  parts::PartContent content;
  content.part = *part;
  for (const auto& [name, dofs] : interfaces)
    content.interfaces.push_back(interfaceSet(part->model, name, dofs));
  for (const auto& [node, position] : positions) {
    if (std::none_of(part->model.dofs.begin(), part->model.dofs.end(),
                     [n = node](const auto& dof) { return dof.entity == n; }))
      throw ModelError("A position is given for node " + std::to_string(node) + ", which part \"" +
                       part->name + "\" does not have.");
    if (position.size() != 3)
      throw ModelError("The position of node " + std::to_string(node) + " has " +
                       std::to_string(position.size()) + " coordinates; expected are three.");
    content.positions.emplace(node, Vector3(position[0], position[1], position[2]));
  }
  for (const auto& points : part->model.points) {
    content.omitted.push_back(points.name);
    log::warn("Part \"" + part->name + "\" is written without its point law \"" + points.name +
              "\", which a part file cannot hold.");
  }
  const auto ending = path.rfind(".h5");
  const bool hdf5 = ending != std::string::npos && ending + 3 == path.size();
  longCall([&] {  // all ranks wait for the writing rank
    parallel::agree([&] {
      parts::writePart(content, path, hdf5 ? parts::FileKind::Hdf5 : parts::FileKind::MatrixMarket);
    });
  });
}

using Laws = std::map<std::string, model::ScalarLaw>;

/// The laws of time that a file names without defining them.
void setLaws(parts::PartContent& content, Laws given) {
  const std::string who = "Part \"" + content.part.name + "\" (" + content.file + ")";
  for (auto& law : content.part.model.laws.own()) {
    if (law.isOne()) continue;
    const auto known = given.find(law.name);
    if (known == given.end())
      throw DeckError(who + " has terms times the law of time \"" + law.name +
                      "\", which its file does not hold. Give it: read_part(path, laws={\"" +
                      law.name + "\": function of the time}).");
    law = known->second;
    given.erase(known);
  }
  if (!given.empty())
    throw DeckError(who + " has no law of time \"" + given.begin()->first + "\". Leave it out.");
}

PartPointer read(const std::string& path, const std::string& name, const py::dict& laws) {
  Laws given;
  for (const auto& [key, function] : laws) {
    const auto law = key.cast<std::string>();
    given.emplace(law, lawOfTime(law, function.cast<py::object>()));
  }
  return longCall([&] {
    auto content = parts::readPartEverywhere(path, name);
    content.part.name = name;
    setLaws(content, given);
    for (const auto& law : content.omitted)
      log::warn("Part \"" + name + "\" had the point law \"" + law +
                "\" where it came from; it is not in the file.");
    return std::make_shared<model::Substructure>(std::move(content.part));
  });
}

}  // namespace

void bindPartFiles(py::module_& module) {
  module.def("write_part", &write, py::arg("part"), py::arg("path"), py::arg("interfaces"),
             py::arg("positions"), "Write a part: a file .h5, or a folder.");
  module.def("read_part", &read, py::arg("path"), py::arg("name"), py::arg("laws") = py::dict(),
             "Read a part; its interface consists of all its interface sets.");
}

}  // namespace tooljoint::python
