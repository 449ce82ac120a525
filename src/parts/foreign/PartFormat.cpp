// SPDX-License-Identifier: BSD-3-Clause
#include "parts/foreign/PartFormat.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "common/Index.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"

namespace tooljoint::parts {

namespace {

constexpr std::int64_t largestNumber = 2147483647;

/// The first nonempty line, shortened if it is too long for a line of text.
std::string openingOf(const std::string& path) {
  try {
    InputFile in(path);
    for (std::string text; in.line(text, longestLine);)
      if (!trim(text).empty()) return text;
  } catch (const FileError&) {
    // not a text; the selected reader reports that
  }
  return "";
}

const char* nameOf(Quantity quantity) {
  return quantity == Quantity::Mass        ? "mass"
         : quantity == Quantity::Stiffness ? "stiffness"
                                           : "damping";
}

/// The labelled matrices of a part as named values.
class ForeignSource : public PartSource {
 public:
  explicit ForeignSource(LabelledPart part) : part_(std::move(part)) {
    collectDofs();
    collectComponents();
  }

  std::string file() const override { return part_.file; }

  bool has(const std::string& path) const override { return contains(names(""), path); }

  std::vector<std::string> names(const std::string& group) const override {
    if (!group.empty()) fail(group, "is no group");
    std::vector<std::string> out{"format", "components", "dofs", "mass", "stiffness"};
    if (!matricesOf("damping").empty()) out.emplace_back("damping");
    if (!part_.loads.empty()) out.emplace_back("loads");
    if (!knownPositions().empty()) out.emplace_back("positions");
    return out;
  }

  std::string text(const std::string& path) const override {
    if (path != "format") fail(path, "is no text");
    return "tooljoint part 1";
  }

  std::vector<std::string> texts(const std::string& path) const override {
    if (path != "components") fail(path, "is no list of texts");
    return components_;
  }

  std::vector<DofName> dofs(const std::string& path) const override {
    if (path != "dofs") fail(path, "is no list of dofs");
    std::vector<DofName> out;
    for (const auto& [dof, position] : positions_) {
      DofName name;
      name.node = dof.point;
      name.component = componentName(dof);
      out.push_back(name);
    }
    return out;
  }

  Sparse matrix(const std::string& path) const override { fail(path, "is no matrix"); }

  Matrix table(const std::string& path) const override {
    if (path != "positions") fail(path, "is no table");
    const auto known = knownPositions();
    Matrix out(static_cast<Eigen::Index>(known.size()), 4);
    Eigen::Index row = 0;
    for (const auto& [point, x] : known)
      out.row(row++) << static_cast<double>(point), x[0], x[1], x[2];
    return out;
  }

  std::vector<NamedTerm> terms(const std::string& path) const override {
    std::vector<NamedTerm> out;
    if (path == "loads")
      for (const auto& load : part_.loads)
        out.push_back({load.name, load.law, load.where, vector(load)});
    else if (path == "mass")
      out.push_back({"mass", "1", "mass", sum(matricesOf(path))});
    else
      for (const auto* one : matricesOf(path))
        out.push_back({one->name, "1", one->where, sum({one})});
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw DeckError(part_.file + ": " + inQuotes(path) + " " + what + ".");
  }

  std::vector<const LabelledMatrix*> matricesOf(const std::string& quantity) const {
    std::vector<const LabelledMatrix*> out;
    for (const auto& one : part_.matrices)
      if (quantity == nameOf(one.quantity)) out.push_back(&one);
    return out;
  }

  /// Collects the dofs in the order of their labels, as rows.
  void collectDofs() {
    for (const char* needed : {"mass", "stiffness"})
      if (matricesOf(needed).empty())
        throw DeckError(part_.file + " has no " + needed +
                        " matrix. A part needs mass and stiffness.");
    for (const auto& one : part_.matrices)
      for (const auto& entry : one.entries)
        for (const auto& dof : {entry.row, entry.column})
          if (part_.held.count(dof) == 0) positions_.emplace(dof, 0);
    if (positions_.empty())
      throw DeckError(part_.file + " has no free dof: its matrices are empty.");
    int next = 0;
    const PointDof* before = nullptr;
    for (auto& [dof, position] : positions_) {
      position = next++;
      if (before != nullptr && before->point == dof.point && before->component == 0)
        throw DeckError(part_.file + ": point " + std::to_string(dof.point) +
                        " is a scalar point (component 0) and has component " +
                        std::to_string(dof.component) + ". A point is one or the other.");
      before = &dof;
    }
    for (const auto& load : part_.loads)
      for (const auto& [dof, force] : load.forces)
        if (force != 0.0 && part_.held.count(dof) == 0 && positions_.count(dof) == 0)
          throw DeckError(load.where + " acts on " + describe(dof) +
                          ", which neither mass nor stiffness has.");
  }

  /// As many components as the largest number, so that position and number agree.
  void collectComponents() {
    int largest = 0;
    bool scalar = false;
    for (const auto& [dof, position] : positions_) {
      largest = std::max(largest, dof.component);
      scalar = scalar || dof.component == 0;
    }
    components_.assign(gridComponents().begin(), gridComponents().begin() + largest);
    if (scalar) components_.emplace_back(scalarComponent);
  }

  static std::string componentName(const PointDof& dof) {
    return dof.component == 0 ? scalarComponent : gridComponents()[at(dof.component - 1)];
  }

  std::map<std::int64_t, Vector3> knownPositions() const {
    std::map<std::int64_t, Vector3> out;
    for (const auto& [dof, position] : positions_)
      if (const auto it = part_.positions.find(dof.point); it != part_.positions.end())
        out.insert(*it);
    return out;
  }

  Sparse sum(const std::vector<const LabelledMatrix*>& matrices) const {
    Triplets entries;
    for (const auto* one : matrices)
      for (const auto& entry : one->entries) {
        const auto row = positions_.find(entry.row), column = positions_.find(entry.column);
        if (row != positions_.end() && column != positions_.end())
          entries.emplace_back(row->second, column->second, entry.value);
      }
    return sparse(sizeOf(positions_), sizeOf(positions_), entries);
  }

  Sparse vector(const LabelledLoad& load) const {
    Triplets entries;
    for (const auto& [dof, force] : load.forces)
      if (const auto row = positions_.find(dof); row != positions_.end())
        entries.emplace_back(row->second, 0, force);
    return sparse(sizeOf(positions_), 1, entries);
  }

  LabelledPart part_;
  std::map<PointDof, int> positions_;  ///< row of every dof
  std::vector<std::string> components_;
};

}  // namespace

std::string describe(const PointDof& dof) {
  return dof.component == 0 ? "scalar point " + std::to_string(dof.point)
                            : "component " + std::to_string(dof.component) + " of point " +
                                  std::to_string(dof.point);
}

std::string PartFiles::main() const {
  if (!whole.empty()) return whole;
  const auto it = named.find("stiffness");
  return it == named.end() ? "" : it->second;
}

std::vector<std::string> PartFormat::companions(const std::string&) const { return {}; }

std::unique_ptr<PartFormat> partFormatByExtension(const std::string& path) {
  const auto extension = lower(std::filesystem::path(path).extension().string());
  for (const auto& [name, entry] : PartFormats::instance().entries())
    if (auto format = entry.make(); contains(format->extensions(), extension)) return format;
  return nullptr;
}

std::unique_ptr<PartFormat> partFormatOf(const std::string& path) {
  if (auto format = partFormatByExtension(path)) return format;
  const auto opening = openingOf(path);
  if (opening.empty()) return nullptr;
  for (const auto& [name, entry] : PartFormats::instance().entries())
    if (auto format = entry.make(); format->recognises(opening)) return format;
  return nullptr;
}

std::unique_ptr<PartSource> openForeignPart(const PartFormat& format, const PartFiles& files) {
  try {
    return std::make_unique<ForeignSource>(format.read(files));
  } catch (const FileError& fault) {
    throw DeckError(fault.what());
  }
}

const std::vector<std::string>& gridComponents() {
  static const std::vector<std::string> names{"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  return names;
}

std::int64_t wholeNumber(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  const bool good = result.ec == std::errc() && result.ptr == end && value >= 0 &&
                    value <= largestNumber && text[0] != '-';
  return good ? value : -1;
}

bool fortranNumber(const std::string& text, bool point, double& value) {
  // mantissa, then E or D with a signed number, or only a sign and a number
  std::string plain;
  bool exponent = false, digit = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool mark = c == 'E' || c == 'e' || c == 'D' || c == 'd';
    const bool sign = c == '+' || c == '-';
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || (c == '.' && !exponent)) {
      digit = digit || c != '.';
      plain += c;
    } else if (i == 0 && sign) {
      if (c == '-') plain += c;
    } else if (digit && !exponent && (mark || sign)) {
      exponent = true;
      plain += 'e';
      if (sign) plain += c;
      if (mark && i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-'))
        plain += text[++i];
    } else {
      return false;
    }
  }
  if (point && plain.find('.') == std::string::npos) return false;
  const char* end = plain.data() + plain.size();
  const auto result = std::from_chars(plain.data(), end, value);
  return digit && result.ec == std::errc() && result.ptr == end && std::isfinite(value);
}

}  // namespace tooljoint::parts
