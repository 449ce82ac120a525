// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Parallel.hpp"
#include "io/MatrixMarket.hpp"
#include "io/ResultsFile.hpp"
#include "io/TextFile.hpp"
#include "parts/file/PartFile.hpp"
#include "parts/foreign/ForeignWriters.hpp"

namespace tooljoint::parts {

namespace {

using Json = nlohmann::ordered_json;
using model::DofLabel;

const std::string& lawName(const model::SecondOrderModel& m, int law) {
  return m.laws[static_cast<std::size_t>(law)].name;
}

/// Writes part.json and its matrices into a folder.
class FolderWriter {
 public:
  FolderWriter(const PartContent& content, const std::string& folder)
      : content_(content), m_(content.part.model), folder_(folder) {}

  void write() {
    std::error_code failed;
    std::filesystem::create_directories(folder_, failed);
    if (failed)
      throw FileError("The folder \"" + folder_ + "\" cannot be created: " + failed.message() +
                      ".");
    root_["format"] = partFormat;
    root_["name"] = content_.part.name;
    root_["components"] = m_.componentNames;
    root_["dofs"] = names(m_.dofs);
    root_["mass"] = matrix("mass.mtx", m_.mass);
    root_["stiffness"] = terms("stiffness", m_.stiffness);
    if (!m_.damping.empty()) root_["damping"] = terms("damping", m_.damping);
    if (!m_.loads.empty()) loads();
    if (!content_.interfaces.empty()) interfaces();
    if (!content_.part.retained.empty())
      root_["retained"] = names(labelsAt(content_.part.retained));
    if (content_.part.reference.size() > 0)
      root_["reference"] = column("reference.mtx", content_.part.reference);
    root_["initial_displacement"] = column("initial_displacement.mtx", m_.initialDisplacement);
    root_["initial_velocity"] = column("initial_velocity.mtx", m_.initialVelocity);
    for (const auto& [node, x] : content_.positions)
      root_["positions"].push_back({node, x[0], x[1], x[2]});
    if (!content_.basis.empty()) {
      root_["basis"]["dofs"] = names(content_.basis.dofs);
      root_["basis"]["vectors"] = matrix("basis.mtx", content_.basis.vectors);
      root_["basis"]["offset"] = column("basis_offset.mtx", content_.basis.offset);
    }
    if (!content_.omitted.empty()) root_["omitted"] = content_.omitted;
    io::writeText((std::filesystem::path(folder_) / "part.json").string(), root_.dump(1) + "\n");
  }

 private:
  Json name(const DofLabel& label) const {
    if (label.kind == DofLabel::Kind::Modal) return Json::array({"mode", label.component + 1});
    return Json::array(
        {label.entity, m_.componentNames[static_cast<std::size_t>(label.component)]});
  }
  Json names(const std::vector<DofLabel>& labels) const {
    Json out = Json::array();
    for (const auto& label : labels) out.push_back(name(label));
    return out;
  }
  std::vector<DofLabel> labelsAt(const std::vector<int>& positions) const {
    std::vector<DofLabel> out;
    for (int i : positions) out.push_back(m_.dofs[static_cast<std::size_t>(i)]);
    return out;
  }
  std::string matrix(const std::string& file, const Sparse& values) const {
    io::writeText((std::filesystem::path(folder_) / file).string(), io::matrixMarketText(values));
    return file;
  }
  std::string column(const std::string& file, const Vector& values) const {
    io::writeText((std::filesystem::path(folder_) / file).string(),
                  io::matrixMarketText(Matrix(values)));
    return file;
  }
  Json terms(const std::string& kind, const std::vector<model::MatrixTerm>& all) const {
    Json out = Json::array();
    for (const auto& term : all)
      out.push_back(
          {{"name", term.name},
           {"law", lawName(m_, term.law)},
           {"matrix", matrix(kind + "_" + std::to_string(out.size() + 1) + ".mtx", term.matrix)}});
    return out;
  }
  void loads() {
    Json out = Json::array();
    for (const auto& term : m_.loads)
      out.push_back(
          {{"name", term.name},
           {"law", lawName(m_, term.law)},
           {"vector", column("load_" + std::to_string(out.size() + 1) + ".mtx", term.vector)}});
    root_["loads"] = out;
  }
  void interfaces() {
    for (const auto& set : content_.interfaces)
      root_["interfaces"][set.name] = names(labelsAt(set.dofs));
  }

  const PartContent& content_;
  const model::SecondOrderModel& m_;
  std::string folder_;
  Json root_;
};

/// Writes one HDF5 file with the same names.
class Hdf5Writer {
 public:
  Hdf5Writer(const PartContent& content, const std::string& path)
      : content_(content), m_(content.part.model), file_(path, {}, {}) {}

  void write() {
    file_.write("/components", m_.componentNames, "Names of the components of a node");
    names("/dofs", m_.dofs,
          "Node and component (from 1) of every dof; node 0: a mode and its number");
    matrix("/mass", m_.mass, "Mass");
    terms("/stiffness", m_.stiffness);
    terms("/damping", m_.damping);
    for (std::size_t i = 0; i < m_.loads.size(); ++i) load(m_.loads[i]);
    for (const auto& set : content_.interfaces)
      names("/interfaces/" + set.name, labelsAt(set.dofs),
            "Dofs that may be joined with those of another part");
    if (!content_.part.retained.empty())
      names("/retained", labelsAt(content_.part.retained), "Dofs that a reduction keeps");
    if (content_.part.reference.size() > 0)
      column("/reference", content_.part.reference, "m, rad", "State the matrices are taken about");
    column("/initial_displacement", m_.initialDisplacement, "m, rad", "State at the start");
    column("/initial_velocity", m_.initialVelocity, "m/s, rad/s", "Velocity at the start");
    if (!content_.positions.empty()) positions();
    if (!content_.basis.empty()) {
      names("/basis/dofs", content_.basis.dofs,
            "Rows of the basis: dofs of the part this one was reduced from");
      matrix("/basis/vectors", content_.basis.vectors, "Phi: D = offset + Phi q");
      column("/basis/offset", content_.basis.offset, "m, rad", "D at q = 0");
    }
    if (!content_.omitted.empty())
      file_.write("/omitted", content_.omitted, "Point laws that are not in this file");
    file_.attribute("/", "format", std::string(partFormat));
    file_.attribute("/", "name", content_.part.name);
    file_.finish();
  }

 private:
  std::vector<DofLabel> labelsAt(const std::vector<int>& positions) const {
    std::vector<DofLabel> out;
    for (int i : positions) out.push_back(m_.dofs[static_cast<std::size_t>(i)]);
    return out;
  }
  void names(const std::string& path, const std::vector<DofLabel>& labels,
             const std::string& longName) {
    std::vector<double> rows;
    for (const auto& label : labels) {
      rows.push_back(label.kind == DofLabel::Kind::Modal ? 0.0 : static_cast<double>(label.entity));
      rows.push_back(label.component + 1.0);
    }
    file_.write(path, rows, {labels.size(), 2}, "1", longName);
  }
  void matrix(const std::string& path, const model::SharedSparse& A, const std::string& longName) {
    const auto count = static_cast<std::size_t>(A.nonZeros());
    const auto indices = [&](const std::string& name, const auto& of, const std::string& text) {
      std::vector<int> list;
      list.reserve(count);
      forEachEntry(A, [&](int i, int j, double) { list.push_back(of(i, j)); });
      file_.write(path + name, list, {count}, "1", longName + text);
    };
    indices(
        "/row", [](int i, int) { return i; }, ": row of each entry, from 0");
    indices(
        "/column", [](int, int j) { return j; }, ": column of each entry, from 0");
    file_.write(path + "/value", A.valuePtr(), {count}, "1", longName + ": entries, SI");
    file_.write(path + "/shape",
                std::vector<int>{static_cast<int>(A.rows()), static_cast<int>(A.cols())}, {2}, "1",
                longName + ": rows and columns");
  }
  void column(const std::string& path, const Vector& values, const std::string& unit,
              const std::string& longName) {
    file_.write(path, values, {static_cast<std::size_t>(values.size())}, unit, longName);
  }
  void terms(const std::string& path, const std::vector<model::MatrixTerm>& all) {
    for (const auto& term : all) {
      const std::string group = path + "/" + plain(term.name);
      matrix(group, term.matrix, term.name);
      file_.attribute(group, "law", lawName(m_, term.law));
      file_.attribute(group, "name", term.name);
    }
  }
  void load(const model::LoadTerm& term) {
    const std::string path =
        "/loads/" + plain(term.name) +
        (model::ScalarLaw::isOne(lawName(m_, term.law)) ? ""
                                                        : " times " + plain(lawName(m_, term.law)));
    column(path, term.vector, "N, N m", "Load \"" + term.name + "\"");
    file_.attribute(path, "law", lawName(m_, term.law));
    file_.attribute(path, "name", term.name);
  }
  /// A name without the separator of paths.
  static std::string plain(std::string name) {
    for (char& c : name)
      if (c == '/') c = '|';
    return name;
  }
  void positions() {
    std::vector<double> rows;
    for (const auto& [node, x] : content_.positions)
      rows.insert(rows.end(), {static_cast<double>(node), x[0], x[1], x[2]});
    file_.write("/positions", rows, {content_.positions.size(), 4}, "m",
                "Rows node, x, y, z in the frame of the part");
  }

  const PartContent& content_;
  const model::SecondOrderModel& m_;
  io::ResultsFile file_;
};

}  // namespace

void writePart(const PartContent& content, const std::string& path, FileKind kind,
               const LoadTimes& times) {
  if (parallel::rank() != 0) return;
  switch (kind) {
    case FileKind::MatrixMarket:
      FolderWriter(content, path).write();
      break;
    case FileKind::Hdf5:
      Hdf5Writer(content, path).write();
      break;
    case FileKind::NastranDmig:
      io::writeText(path, dmigText(content));
      break;
    case FileKind::ExtPtfm:
      io::writeText(path, extPtfmText(content, times));
      break;
  }
}

}  // namespace tooljoint::parts
