// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "parts/foreign/Dmig.hpp"
#include "parts/foreign/ForeignWriters.hpp"
#include "parts/foreign/PartFormat.hpp"
#include "reduction/part/Partition.hpp"

namespace tooljoint::parts {

namespace {

using namespace dmig;
/// Differences of transposed entries below this, relative to the diagonal, are rounding.
constexpr double rounding = 1e-10;
constexpr std::size_t fieldWidth = 16;

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

/// As many digits as 16 columns can hold with a D exponent, 10 to 12: -1.2345678901D+5.
std::string largeNumber(double value) {
  for (int digits = 15;; --digits) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.*e", digits, value);
    const std::string plain = text;
    const auto e = plain.find('e');
    std::string exponent = plain.substr(e + 2);
    exponent.erase(0, std::min(exponent.find_first_not_of('0'), exponent.size() - 1));
    const std::string out = plain.substr(0, e) + "D" + plain[e + 1] + exponent;
    if (out.size() <= fieldWidth) return padded(out, fieldWidth);
  }
}

class DmigWriter {
 public:
  explicit DmigWriter(const PartContent& content)
      : content_(content), matrices_(constantMatrices(content, "Nastran DMIG")) {}

  std::string text() {
    label();
    for (const auto& line : {std::string("part ") + content_.part.name,
                             std::string("written by Tooljoint as DMIG entries"), legend()})
      text_ += "$ " + excerpt(line, 70) + "\n";
    grids();
    matrix("KAAX", matrices_.stiffness, true);
    matrix("MAAX", matrices_.mass, false);
    matrix("BAAX", matrices_.damping, false);
    loads();
    return text_;
  }

 private:
  /// Point and component of every row.
  void label() {
    const auto& m = content_.part.model;
    const auto numbers = componentNumbers(content_);
    std::int64_t largest = 0;
    for (const auto& l : m.dofs)
      if (l.kind == model::DofLabel::Kind::Physical) largest = std::max(largest, l.entity);
    std::map<std::int64_t, int> kinds;  // of points: 1 scalar, 2 grid
    for (const auto& l : m.dofs) {
      PointDof dof;
      if (l.kind == model::DofLabel::Kind::Physical)
        dof = {l.entity, numbers[static_cast<std::size_t>(l.component)]};
      else
        scalars_.push_back((dof = {largest + l.component + 1, 0}).point);
      kinds[dof.point] |= dof.component == 0 ? 1 : 2;
      if (kinds[dof.point] == 3)
        throw ModelError("Part " + inQuotes(content_.part.name) +
                         " cannot be written as Nastran DMIG: node " + std::to_string(dof.point) +
                         " has the component \"s\" of a scalar point and others.");
      labels_.push_back(dof);
    }
  }

  std::string legend() const {
    const auto& names = content_.part.model.componentNames;
    const auto numbers = componentNumbers(content_);
    std::vector<std::string> out;
    for (std::size_t c = 0; c < names.size(); ++c)
      out.push_back(std::to_string(numbers[c]) + " = " + names[c]);
    return "components: " + join(out, ", ");
  }

  void grids() {
    for (const auto& [node, x] : content_.positions)
      if (std::any_of(labels_.begin(), labels_.end(),
                      [n = node](const auto& dof) { return dof.point == n && dof.component > 0; }))
        text_ += "GRID*   " + whole(node) + padded("", fieldWidth) + largeNumber(x[0]) +
                 largeNumber(x[1]) + "\n*       " + largeNumber(x[2]) + "\n";
    for (const auto point : scalars_) text_ += "SPOINT  " + padded(std::to_string(point), 8) + "\n";
  }

  static std::string whole(std::int64_t number) {
    return padded(std::to_string(number), fieldWidth);
  }

  void header(const std::string& name, int form, int columns) {
    text_ += "DMIG    " + name + std::string(8 - name.size(), ' ') + "       0" +
             padded(std::to_string(form), 8) + "       2       0" +
             (columns > 0 ? std::string(16, ' ') + padded(std::to_string(columns), 8) : "") + "\n";
  }
  void column(const std::string& name, const PointDof& at) {
    text_ += "DMIG*   " + name + std::string(fieldWidth - name.size(), ' ') + whole(at.point) +
             whole(at.component) + "\n";
  }
  void entry(const PointDof& at, double value) {
    text_ += "*       " + whole(at.point) + whole(at.component) + largeNumber(value) + "\n";
  }

  /// Writes the columns one after the other; with `all` every dof is listed, even with a zero
  /// diagonal.
  void matrix(const std::string& name, const Sparse& A, bool all) {
    if (!all && A.nonZeros() == 0) return;
    const bool half = reduction::nearlySymmetric(A, rounding);
    header(name, half ? symmetric : square, 0);
    const Sparse columns = A.transpose();
    for (int j = 0; j < columns.outerSize(); ++j) {
      std::vector<std::pair<int, double>> entries;
      if (all && columns.coeff(j, j) == 0.0) entries.emplace_back(j, 0.0);
      for (Sparse::InnerIterator it(columns, j); it; ++it) {
        const int i = static_cast<int>(it.col());
        const double value = half ? 0.5 * (it.value() + columns.coeff(i, j)) : it.value();
        if (value != 0.0 && (!half || i >= j)) entries.emplace_back(i, value);
      }
      if (entries.empty()) continue;
      column(name, labels_[static_cast<std::size_t>(j)]);
      for (const auto& [i, value] : entries) entry(labels_[static_cast<std::size_t>(i)], value);
    }
  }

  void loads() {
    const auto& m = content_.part.model;
    Vector sum = Vector::Zero(m.size());
    for (const auto& load : m.loads) {
      const auto& law = m.laws[static_cast<std::size_t>(load.law)];
      if (!law.isOne())
        throw ModelError("Part " + inQuotes(content_.part.name) +
                         " cannot be written as Nastran DMIG: its load " + inQuotes(load.name) +
                         " varies in time with the law " + inQuotes(law.name) +
                         ", and the file holds constant loads. Write HDF5 or Matrix Market "
                         "instead.");
      sum += load.vector;
    }
    if (sum.isZero(0.0)) return;
    header("PAX", columnsByNumber, 1);
    column("PAX", {1, 0});
    for (Eigen::Index i = 0; i < sum.size(); ++i)
      if (sum[i] != 0.0) entry(labels_[static_cast<std::size_t>(i)], sum[i]);
  }

  const PartContent& content_;
  ConstantMatrices matrices_;
  std::vector<PointDof> labels_;
  std::vector<std::int64_t> scalars_;
  std::string text_;
};

}  // namespace

std::string dmigText(const PartContent& content) { return DmigWriter(content).text(); }

}  // namespace tooljoint::parts
