// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "io/MatrixMarket.hpp"
#include "parts/file/PartFile.hpp"
#include "parts/file/PartSource.hpp"

namespace tooljoint::parts {

namespace {

using model::DofLabel;

const std::vector<std::string> knownNames{
    "format",           "name",      "components", "dofs",     "mass",      "damping",
    "stiffness",        "loads",     "interfaces", "retained", "reference", "initial_displacement",
    "initial_velocity", "positions", "basis",      "omitted",  "matrices"};

std::string shapeText(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

/// Builds a part from a source and reports inconsistencies.
class Reader {
 public:
  Reader(const std::string& path, const std::string& name) : name_(name), source_(open(path)) {
    content_.file = source_->file();
  }

  PartContent read() {
    checkNames();
    auto& m = content_.part.model;
    content_.part.name = name_;
    readComponents();
    m.dofs = labels("dofs");
    if (m.dofs.empty()) fail("dofs", "is empty: a part needs at least one dof");
    refuseTwice("dofs", m.dofs);
    for (int i = 0; i < static_cast<int>(m.dofs.size()); ++i)
      positions_[m.dofs[static_cast<std::size_t>(i)]] = i;
    const auto mass = squareTerms("mass");
    if (mass.size() != 1 || !model::ScalarLaw::isOne(mass.front().law))
      fail("mass", "must be one matrix without a law");
    m.mass = mass.front().matrix;
    for (const auto& term : squareTerms("stiffness"))
      m.stiffness.push_back({term.name, term.matrix, law(term.law)});
    if (source_->has("damping"))
      for (const auto& term : squareTerms("damping"))
        m.damping.push_back({term.name, term.matrix, law(term.law)});
    if (source_->has("loads")) readLoads();
    readState();
    readInterfaces();
    if (source_->has("basis")) readBasis();
    if (source_->has("positions")) readPositions();
    if (source_->has("omitted")) content_.omitted = source_->texts("omitted");
    recoverNodes();
    checkMass(content_);
    checkStiffness(content_);
    return std::move(content_);
  }

 private:
  std::unique_ptr<PartSource> open(const std::string& path) const {
    try {
      return openPart(path);
    } catch (const DeckError& fault) {
      throw DeckError("Part " + inQuotes(name_) + ": " + fault.what());
    }
  }

  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw DeckError(source_->file() + ": " + inQuotes(path) + " " + what + ".");
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(content_.part.model.dofs.size()); }
  std::string describe(const DofLabel& label) const {
    return label.kind == DofLabel::Kind::Modal
               ? "mode " + std::to_string(label.component + 1)
               : model::describe(label, content_.part.model.componentNames);
  }

  void checkNames() const {
    if (!source_->has("format"))
      fail("format", std::string("is missing: a part file has \"") + partFormat + "\" there");
    const auto format = source_->text("format");
    if (format != partFormat)
      fail("format", "is " + inQuotes(format) + ", expected " + inQuotes(partFormat) +
                         ". The file has another version or another kind");
    for (const auto& name : source_->names("")) {
      if (std::find(knownNames.begin(), knownNames.end(), name) != knownNames.end()) continue;
      const auto meant = closest(name, knownNames);
      fail(name, "is not an entry of a part file" +
                     (meant.empty() ? ". Available: " + quotedList(knownNames)
                                    : ". Did you mean " + inQuotes(meant) + "?"));
    }
    if (source_->has("name")) source_->text("name");  // for readers only: the deck names the part
    for (const char* needed : {"components", "dofs", "mass", "stiffness"})
      if (!source_->has(needed))
        fail(needed, "is missing: a part has \"components\", \"dofs\", \"mass\" and \"stiffness\"");
  }

  void readComponents() {
    auto& names = content_.part.model.componentNames;
    names = source_->texts("components");
    if (names.empty())
      fail("components",
           "is empty: name the components of a node, for example \"u\", \"v\", \"w\"");
    for (auto it = names.begin(); it != names.end(); ++it) {
      if (it->empty()) fail("components", "holds an empty name");
      if (std::find(names.begin(), it, *it) != it)
        fail("components", "names " + inQuotes(*it) + " twice");
    }
  }

  /// 0-based component of a dof name.
  int component(const std::string& path, const DofName& dof) const {
    const auto& names = content_.part.model.componentNames;
    if (!dof.component.empty()) {
      const auto it = std::find(names.begin(), names.end(), dof.component);
      if (it == names.end())
        fail(path, "names the component " + inQuotes(dof.component) + " of node " +
                       std::to_string(dof.node) + "; the components are " + quotedList(names));
      return static_cast<int>(it - names.begin());
    }
    if (dof.number < 1 || dof.number > static_cast<int>(names.size()))
      fail(path, "names component " + std::to_string(dof.number) + " of node " +
                     std::to_string(dof.node) + ". Components are numbered 1 to " +
                     std::to_string(names.size()));
    return dof.number - 1;
  }

  DofLabel label(const std::string& path, const DofName& dof) const {
    if (dof.mode) {
      if (dof.number < 1)
        fail(path, "names mode " + std::to_string(dof.number) + ". Modes are numbered from 1");
      return DofLabel::modal(0, dof.number - 1);
    }
    if (dof.node < 1)
      fail(path, "names node " + std::to_string(dof.node) + ". Nodes are numbered from 1");
    if (dof.whole())
      fail(path, "names node " + std::to_string(dof.node) +
                     " without a component. A dof is a node and a component");
    return DofLabel::physical(dof.node, component(path, dof));
  }

  std::vector<DofLabel> labels(const std::string& path) const {
    std::vector<DofLabel> out;
    for (const auto& dof : source_->dofs(path)) out.push_back(label(path, dof));
    return out;
  }

  void refuseTwice(const std::string& path, const std::vector<DofLabel>& all) const {
    std::map<DofLabel, std::size_t> seen;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto [it, isNew] = seen.emplace(all[i], i);
      if (!isNew)
        fail(path, "gives " + describe(all[i]) + " twice, as dof " +
                       std::to_string(it->second + 1) + " and as dof " + std::to_string(i + 1) +
                       ". Give every dof its own label");
    }
  }

  int law(const std::string& name) {
    return content_.part.model.lawIndex(
        {name, [](double) { return std::numeric_limits<double>::quiet_NaN(); }});
  }

  /// Terms of a matrix; an error on an entry that is not finite names its dofs.
  std::vector<NamedTerm> termsOf(const std::string& path) const {
    try {
      auto terms = source_->terms(path);
      if (terms.empty()) fail(path, "is empty");
      std::set<std::pair<std::string, std::string>> names;
      for (const auto& term : terms)
        if (!names.emplace(term.name, term.law).second)
          fail(path, "has two terms with the name " + inQuotes(term.name) + " and the law " +
                         inQuotes(term.law));
      return terms;
    } catch (const io::MatrixFileError& fault) {
      throw explained(fault);
    }
  }

  DeckError explained(const io::MatrixFileError& fault) const {
    std::string where;
    const auto& dofs = content_.part.model.dofs;
    if (fault.row >= 0 && fault.row < size()) {
      where = " That is the row of " + describe(dofs[static_cast<std::size_t>(fault.row)]);
      if (fault.column >= 0 && fault.column < size())
        where += " and the column of " + describe(dofs[static_cast<std::size_t>(fault.column)]);
      where += ".";
    }
    return DeckError("Part " + inQuotes(name_) + ": " + fault.what() + where);
  }

  std::vector<NamedTerm> squareTerms(const std::string& path) const {
    auto terms = termsOf(path);
    for (const auto& term : terms) {
      const auto rows = term.matrix.rows(), columns = term.matrix.cols();
      if (rows != columns)
        fail(term.where, "is " + shapeText(rows, columns) + ", which is not square. The part has " +
                             std::to_string(size()) + " dofs");
      if (rows != size())
        fail(term.where, "is " + shapeText(rows, columns) + ", but \"dofs\" names " +
                             std::to_string(size()) +
                             " dofs. Give one label for each row of the matrices");
    }
    return terms;
  }

  Vector vectorOf(const std::string& path, Eigen::Index rows) const {
    Matrix values;
    try {
      values = source_->table(path);
    } catch (const io::MatrixFileError& fault) {
      throw explained(fault);
    }
    if (values.cols() != 1 || values.rows() != rows)
      fail(path, "is " + shapeText(values.rows(), values.cols()) + ", expected " +
                     std::to_string(rows) + " numbers in one column");
    return values.col(0);
  }

  void readLoads() {
    for (const auto& term : termsOf("loads")) {
      if (term.matrix.cols() != 1 || term.matrix.rows() != size())
        fail(term.where, "is " + shapeText(term.matrix.rows(), term.matrix.cols()) + ", expected " +
                             std::to_string(size()) + " numbers in one column, one for each dof");
      content_.part.model.loads.push_back(
          {term.name, Vector(Matrix(term.matrix).col(0)), law(term.law)});
    }
  }

  void readState() {
    auto& part = content_.part;
    if (source_->has("reference")) part.reference = vectorOf("reference", size());
    part.model.initialDisplacement = source_->has("initial_displacement")
                                         ? vectorOf("initial_displacement", size())
                                     : part.reference.size() > 0 ? part.reference
                                                                 : Vector(Vector::Zero(size()));
    part.model.initialVelocity = source_->has("initial_velocity")
                                     ? vectorOf("initial_velocity", size())
                                     : Vector(Vector::Zero(size()));
  }

  /// Positions of dofs and whole nodes, in the order given.
  std::vector<int> positions(const std::string& path) const {
    std::vector<int> out;
    const auto& dofs = content_.part.model.dofs;
    for (const auto& one : source_->dofs(path)) {
      const std::size_t before = out.size();
      if (!one.whole()) {
        const auto it = positions_.find(label(path, one));
        if (it != positions_.end()) out.push_back(it->second);
      } else {
        for (int i = 0; i < size(); ++i)
          if (const auto& l = dofs[static_cast<std::size_t>(i)];
              l.kind == DofLabel::Kind::Physical && l.entity == one.node)
            out.push_back(i);
      }
      if (out.size() > before) continue;
      const std::string what =
          one.whole() ? "node " + std::to_string(one.node) : describe(label(path, one));
      fail(path, "names " + what + ", but the part has no such " + (one.whole() ? "node" : "dof") +
                     ": \"dofs\" does not list it" + nodeRange());
    }
    for (auto it = out.begin(); it != out.end(); ++it)
      if (std::find(out.begin(), it, *it) != it)
        fail(path, "names " + describe(dofs[static_cast<std::size_t>(*it)]) + " twice");
    return out;
  }

  std::string nodeRange() const {
    std::int64_t low = std::numeric_limits<std::int64_t>::max(), high = 0;
    for (const auto& l : content_.part.model.dofs)
      if (l.kind == DofLabel::Kind::Physical) {
        low = std::min(low, l.entity);
        high = std::max(high, l.entity);
      }
    return high == 0
               ? ""
               : " (its nodes are " + std::to_string(low) + " to " + std::to_string(high) + ")";
  }

  void readInterfaces() {
    auto& part = content_.part;
    std::set<int> joined;
    if (source_->has("interfaces"))
      for (const auto& name : source_->names("interfaces")) {
        InterfaceSet set{name, positions("interfaces/" + name), {}};
        for (int i : set.dofs) {
          const auto& l = part.model.dofs[static_cast<std::size_t>(i)];
          if (l.kind == DofLabel::Kind::Modal)
            fail("interfaces/" + name,
                 "names " + describe(l) + ", which cannot be a dof of another part");
          if (std::find(set.nodes.begin(), set.nodes.end(), l.entity) == set.nodes.end())
            set.nodes.push_back(l.entity);
          joined.insert(i);
        }
        content_.interfaces.push_back(std::move(set));
      }
    part.interface.assign(joined.begin(), joined.end());
    std::set<int> kept;
    if (source_->has("retained"))
      for (int i : positions("retained"))
        if (joined.count(i) == 0) kept.insert(i);
    part.retained.assign(kept.begin(), kept.end());
  }

  void readPositions() {
    const auto known = nodesOf(content_);
    const Matrix rows = source_->table("positions");
    if (rows.cols() != 4)
      fail("positions",
           "is " + shapeText(rows.rows(), rows.cols()) + ", expected rows \"node x y z\"");
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const auto node = static_cast<std::int64_t>(rows(i, 0));
      if (static_cast<double>(node) != rows(i, 0) || node < 1)
        fail("positions",
             "has " + formatNumber(rows(i, 0)) + " for a node in row " + std::to_string(i + 1));
      if (known.count(node) == 0)
        fail("positions", "names node " + std::to_string(node) + " in row " +
                              std::to_string(i + 1) + ", which the part does not have" +
                              nodeRange());
      if (!content_.positions.emplace(node, rows.row(i).tail(3).transpose()).second)
        fail("positions", "gives node " + std::to_string(node) + " twice");
    }
  }

  void readBasis() {
    auto& basis = content_.basis;
    for (const char* needed : {"basis/dofs", "basis/vectors"})
      if (!source_->has(needed))
        fail(needed, "is missing: a basis has \"dofs\" (its rows) and \"vectors\"");
    basis.dofs = labels("basis/dofs");
    refuseTwice("basis/dofs", basis.dofs);
    try {
      basis.vectors = source_->matrix("basis/vectors");
    } catch (const io::MatrixFileError& fault) {
      throw DeckError("Part " + inQuotes(name_) + ": " + fault.what());
    }
    const auto rows = static_cast<Eigen::Index>(basis.dofs.size());
    if (basis.vectors.rows() != rows || basis.vectors.cols() != size())
      fail("basis/vectors",
           "is " + shapeText(basis.vectors.rows(), basis.vectors.cols()) + ", expected " +
               shapeText(rows, size()) +
               ": a row for each of \"basis/dofs\" and a column for each of \"dofs\"");
    basis.offset =
        source_->has("basis/offset") ? vectorOf("basis/offset", rows) : Vector(Vector::Zero(rows));
  }

  /// D of all nodes: from the basis if there is one, otherwise the dofs themselves; missing dofs
  /// are 0.
  void recoverNodes() {
    auto& m = content_.part.model;
    const auto& rows = content_.basis.empty() ? m.dofs : content_.basis.dofs;
    const int width = static_cast<int>(m.componentNames.size());
    std::map<std::int64_t, int> order;
    for (const auto& l : rows) {
      if (l.kind != DofLabel::Kind::Physical || order.count(l.entity) > 0) continue;
      order.emplace(l.entity, static_cast<int>(m.recoveryNodes.size()));
      m.recoveryNodes.push_back(l.entity);
    }
    const auto all = static_cast<Eigen::Index>(m.recoveryNodes.size()) * width;
    m.recoveryOffset = Vector::Zero(all);
    Triplets entries;
    for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
      const auto& l = rows[static_cast<std::size_t>(i)];
      if (l.kind != DofLabel::Kind::Physical) continue;
      const int row = order.at(l.entity) * width + l.component;
      if (content_.basis.empty()) {
        entries.emplace_back(row, i, 1.0);
        continue;
      }
      m.recoveryOffset[row] = content_.basis.offset[i];
      for (Sparse::InnerIterator it(content_.basis.vectors.sparse(), i); it; ++it)
        entries.emplace_back(row, static_cast<int>(it.col()), it.value());
    }
    m.recovery.resize(all, size());
    m.recovery.setFromTriplets(entries.begin(), entries.end());
  }

  std::string name_;
  std::unique_ptr<PartSource> source_;
  PartContent content_;
  std::map<DofLabel, int> positions_;
};

}  // namespace

std::set<std::int64_t> nodesOf(const PartContent& content) {
  std::set<std::int64_t> out;
  for (const auto* labels : {&content.part.model.dofs, &content.basis.dofs})
    for (const auto& l : *labels)
      if (l.kind == DofLabel::Kind::Physical) out.insert(l.entity);
  return out;
}

PartContent readPart(const std::string& path, const std::string& name) {
  return Reader(path, name).read();
}

PartContent readPartEverywhere(const std::string& path, const std::string& name) {
  PartContent content;
  parallel::agree([&] { content = readPart(path, name); });
  return content;
}

}  // namespace tooljoint::parts
