// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nastran DMIG entries (direct matrix input at points), as in files from EXTSEOUT(DMIGPCH) and
/// PARAM,EXTOUT and in hand-written bulk data: MSC and NX Nastran Quick Reference Guide, "DMIG";
/// the same entry in Altair OptiStruct and Autodesk Nastran.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/Text.hpp"
#include "parts/foreign/Dmig.hpp"
#include "parts/foreign/NastranBulkData.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

/// Largest relative difference of two values for one entry of a symmetric matrix: the digits of
/// double and of single precision.
constexpr double sameInDouble = 1e-9, sameInSingle = 1e-6;

using namespace dmig;

/// Entries other than DMIG that do not affect the matrices.
const std::set<std::string> skipped{"SPOINT", "ASET",   "ASET1",  "QSET",    "QSET1",
                                    "BSET",   "BSET1",  "CSET",   "CSET1",   "USET",
                                    "USET1",  "PARAM",  "EXTRN",  "SECONCT", "CORD1R",
                                    "CORD1C", "CORD1S", "CORD2R", "CORD2C",  "CORD2S"};

class DmigReader {
 public:
  explicit DmigReader(const std::string& path) : path_(path) {}

  LabelledPart read() {
    part_.file = path_;
    NastranBulkData bulk(path_);
    for (BulkEntry entry; bulk.next(entry);) take(entry);
    if (matrices_.empty() && columns_.empty())
      throw DeckError(path_ + " has no DMIG entry. A part needs a stiffness and a mass matrix.");
    for (const auto& entry : columns_) addColumn(entry);
    for (const auto& name : order_) finish(name, matrices_.at(name));
    return std::move(part_);
  }

 private:
  struct Value {
    double value = 0.0;
    long line = 0;
    bool transposed = false;  ///< given in the upper triangle
    bool both = false;        ///< given in both
  };
  struct Dmig {
    long line = 0;
    int form = 0, type = 0;
    std::int64_t columns = 0;
    std::map<std::pair<PointDof, PointDof>, Value> values;  ///< (row, column)
  };

  [[noreturn]] void fail(long line, const std::string& what) const {
    throw DeckError(path_ + ":" + std::to_string(line) + " " + what + ".");
  }
  [[noreturn]] void failAt(const BulkField& field, const std::string& expected) const {
    throw DeckError(path_ + ":" + std::to_string(field.line) + ": field " +
                    std::to_string(field.number) + " is " + inQuotes(field.text) + ", expected " +
                    expected + ".");
  }

  void take(const BulkEntry& entry) {
    if (entry.name == "GRID") return takeGrid(entry);
    if (skipped.count(entry.name) > 0) return;
    if (entry.name != "DMIG")
      fail(entry.line, "is an entry " + inQuotes(entry.name) +
                           ". A part takes its matrices from DMIG entries alone; beside them are "
                           "allowed GRID, SPOINT, sets and PARAM");
    if (entry.fields.front().text.empty()) failAt(entry.fields.front(), "the name of a matrix");
    if (entry.fields[1].text != "0") {
      columns_.push_back(entry);
      return;
    }
    takeHeader(entry);
  }

  void takeHeader(const BulkEntry& entry) {
    const auto name = upper(entry.fields.front().text);
    auto fields = entry.fields;
    fields.resize(8);
    Dmig matrix;
    matrix.line = entry.line;
    matrix.form = static_cast<int>(wholeNumber(fields[2].text));
    if (matrix.form != square && matrix.form != rectangular && matrix.form != symmetric &&
        matrix.form != columnsByNumber)
      failAt(fields[2], "a form IFO: 1 (square), 2 or 9 (rectangular) or 6 (symmetric)");
    matrix.type = static_cast<int>(wholeNumber(fields[3].text));
    if (matrix.type == 3 || matrix.type == 4)
      fail(entry.line, "gives the matrix " + inQuotes(name) +
                           " the complex type TIN = " + fields[3].text +
                           ". A part is real: expected 1 (real single) or 2 (real double)");
    if (matrix.type != singleReal && matrix.type != doubleReal)
      failAt(fields[3], "a type TIN: 1 (real single) or 2 (real double)");
    matrix.columns = fields[7].text.empty() ? 0 : wholeNumber(fields[7].text);
    if (matrix.columns < 0) failAt(fields[7], "a number of columns NCOL");
    const auto [it, isNew] = matrices_.emplace(name, matrix);
    if (!isNew)
      fail(entry.line, "is a second header of the matrix " + inQuotes(name) +
                           "; the first is in line " + std::to_string(it->second.line));
    order_.push_back(name);
  }

  std::int64_t point(const BulkField& field) const {
    const auto number = wholeNumber(field.text);
    if (number < 1) failAt(field, "the number of a grid point or scalar point, from 1");
    return number;
  }

  PointDof dof(const BulkField& pointField, const BulkField& componentField) const {
    const auto number = componentField.text.empty() ? 0 : wholeNumber(componentField.text);
    if (number < 0 || number > 6)
      failAt(componentField, "a component from 1 to 6, or 0 or blank for a scalar point");
    return {point(pointField), static_cast<int>(number)};
  }

  void addColumn(const BulkEntry& entry) {
    const auto& fields = entry.fields;
    const auto name = upper(fields.front().text);
    const auto it = matrices_.find(name);
    if (it == matrices_.end())
      fail(entry.line, "is a column of the matrix " + inQuotes(name) +
                           ", which has no header \"DMIG NAME 0 IFO TIN TOUT\"");
    auto& matrix = it->second;
    const PointDof column = dof(fields[1], fields[2]);
    if (!fields[3].text.empty()) failAt(fields[3], "a blank field");
    if (matrix.form == columnsByNumber && matrix.columns > 0 && column.point > matrix.columns)
      failAt(fields[1], "a column from 1 to NCOL = " + std::to_string(matrix.columns));
    for (std::size_t at = 4; at + 3 < fields.size(); at += 4) {
      if (std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(at),
                      fields.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                      [](const auto& field) { return field.text.empty(); }))
        continue;
      const PointDof row = dof(fields[at], fields[at + 1]);
      double value = 0.0;
      if (!fortranNumber(fields[at + 2].text, true, value))
        failAt(fields[at + 2], "a finite real number with a decimal point, such as 1.5D+3");
      double imaginary = 0.0;
      const auto& second = fields[at + 3];
      if (!second.text.empty() &&
          (!fortranNumber(second.text, true, imaginary) || imaginary != 0.0))
        failAt(second, "a blank field or 0.0: the matrix is real");
      add(matrix, row, column, {value, fields[at].line, row < column, false});
    }
  }

  /// For a symmetric matrix the lower triangle is stored, whichever triangle is given.
  void add(Dmig& matrix, const PointDof& row, const PointDof& column, const Value& value) const {
    auto key = std::make_pair(row, column);
    if (matrix.form == symmetric && value.transposed) std::swap(key.first, key.second);
    const auto [it, isNew] = matrix.values.emplace(key, value);
    if (isNew) return;
    auto& first = it->second;
    const std::string what = "the entry of " + describe(row) + " and " + describe(column);
    if (matrix.form != symmetric || first.both || first.transposed == value.transposed)
      fail(value.line, "gives " + what + " twice; it stands in line " + std::to_string(first.line));
    const double same = matrix.type == singleReal ? sameInSingle : sameInDouble;
    if (std::abs(first.value - value.value) >
        same * std::max(std::abs(first.value), std::abs(value.value)))
      fail(value.line, "gives " + what + " of a symmetric matrix as " + formatNumber(value.value) +
                           ", but line " + std::to_string(first.line) + " gives its transpose as " +
                           formatNumber(first.value));
    first.both = true;
  }

  void finish(const std::string& name, const Dmig& matrix) {
    const std::string where =
        path_ + ":" + std::to_string(matrix.line) + ": the matrix " + inQuotes(name);
    if (name.front() == 'P') return addLoads(name, where, matrix);
    if (name.rfind("K4", 0) == 0)
      throw DeckError(where +
                      " is structural damping, a complex stiffness without meaning in time. Remove "
                      "it, or give viscous damping (BAAX, B2GG)");
    const bool stiffness = name.front() == 'K' || name.rfind("STIF", 0) == 0;
    const bool damping = name.front() == 'B' || name.rfind("DAMP", 0) == 0;
    if (!stiffness && !damping && name.front() != 'M')
      throw DeckError(where +
                      " has a name that does not say what it is. Expected K... (stiffness), M... "
                      "(mass), B... (viscous damping) or P... (loads).");
    if ((matrix.form == rectangular || matrix.form == columnsByNumber) && name.front() == 'M')
      throw DeckError(where + " is rectangular (IFO " + std::to_string(matrix.form) +
                      ") and no mass. Remove it if it is one of the recovery matrices of "
                      "EXTSEOUT.");
    if (matrix.form == columnsByNumber)
      throw DeckError(where +
                      " has numbered columns (IFO 9). Expected IFO 6, 1 or 2: its columns need the "
                      "labels of dofs.");
    if (matrix.values.empty() && !damping)
      throw DeckError(where +
                      " has a header, but no column: the file is cut short, or the matrix is zero. "
                      "Remove the header of a matrix without entries.");
    LabelledMatrix out;
    out.quantity = stiffness ? Quantity::Stiffness : damping ? Quantity::Damping : Quantity::Mass;
    out.name = name;
    out.where = name;
    for (const auto& [at, value] : matrix.values) {
      out.entries.push_back({at.first, at.second, value.value});
      if (matrix.form == symmetric && !(at.first == at.second))
        out.entries.push_back({at.second, at.first, value.value});
    }
    part_.matrices.push_back(std::move(out));
  }

  /// A column is a load case: a single one always acts; several have their own laws.
  void addLoads(const std::string& name, const std::string& where, const Dmig& matrix) {
    if (matrix.form != rectangular && matrix.form != columnsByNumber)
      throw DeckError(where + " holds loads and has IFO = " + std::to_string(matrix.form) +
                      ", expected 2 or 9 (rectangular).");
    std::map<PointDof, LabelledLoad> cases;
    for (const auto& [at, value] : matrix.values) {
      auto& load = cases[at.second];
      load.forces[at.first] += value.value;
    }
    for (auto& [column, load] : cases) {
      load.name = cases.size() == 1 ? name : name + " " + std::to_string(column.point);
      load.law = cases.size() == 1 ? "1" : load.name;
      load.where = path_ + ": the load " + inQuotes(load.name);
      part_.loads.push_back(load);
    }
  }

  void takeGrid(const BulkEntry& entry) {
    auto fields = entry.fields;
    fields.resize(std::max<std::size_t>(fields.size(), 8));
    const auto number = point(fields[0]);
    if (!fields[5].text.empty() && fields[5].text != "0")
      failAt(fields[5], "0 or blank: the dofs of a part have one common frame (CD)");
    Vector3 x = Vector3::Zero();
    for (int i = 0; i < 3; ++i) {
      const auto& field = fields[static_cast<std::size_t>(i) + 2];
      if (!field.text.empty() && !fortranNumber(field.text, true, x[i]))
        failAt(field, "a coordinate with a decimal point");
    }
    // coordinates in another frame (CP) are not in the frame of the part
    if (fields[1].text.empty() || fields[1].text == "0") part_.positions[number] = x;
  }

  std::string path_;
  LabelledPart part_;
  std::map<std::string, Dmig> matrices_;
  std::vector<std::string> order_;  ///< names in the order of the file
  std::vector<BulkEntry> columns_;
};

class NastranDmig : public PartFormat {
 public:
  std::vector<std::string> extensions() const override { return {".pch", ".dmig", ".bdf", ".nas"}; }
  bool recognises(const std::string& opening) const override {
    return opening.rfind("DMIG", 0) == 0;
  }
  LabelledPart read(const PartFiles& files) const override {
    if (files.whole.empty())
      throw DeckError(files.main() +
                      " is a file of DMIG entries, which holds all matrices of a part. Name it "
                      "alone: \"matrices\": \"FILE\".");
    return DmigReader(files.whole).read();
  }
};

const bool nastranDmigRegistered = PartFormats::instance().add(
    "Nastran DMIG", {"DMIG entries of a punch file or bulk data.", {}, [] {
                       return std::make_unique<NastranDmig>();
                     }});

}  // namespace

}  // namespace tooljoint::parts
