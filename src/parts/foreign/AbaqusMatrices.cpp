// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Matrices in the format of Abaqus with *MATRIX GENERATE and *MATRIX OUTPUT, FORMAT=MATRIX INPUT
/// (or LABELS): JOB_STIFn.mtx, JOB_MASSn.mtx, JOB_DMPVn.mtx and JOB_LOADn.mtx with lines "node,
/// dof, node, dof, value" (Abaqus Analysis User's Guide, "Generating structural matrices", and
/// Keywords Reference Guide, *MATRIX OUTPUT and *MATRIX INPUT).
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

namespace fs = std::filesystem;

/// A dof with this value on the diagonal of the stiffness has a boundary condition.
constexpr double boundaryCondition = 1e36;

struct Tag {
  const char* name;  ///< in JOB_NAMEn.mtx
  const char* key;   ///< in part.json
};
constexpr Tag tags[] = {
    {"STIF", "stiffness"}, {"MASS", "mass"}, {"DMPV", "damping"}, {"LOAD", "loads"}};

/// One file of lines with numbers.
class MtxFile {
 public:
  explicit MtxFile(const std::string& path) : path_(path), in_(path) {}

  LabelledMatrix matrix(Quantity quantity, const std::string& name) {
    Entries given;
    bool whole = false;
    for (long keyword = 0; next();) {
      if (text_[0] == '*') {
        if (keyword > 0 || !given.empty())
          fail("is the keyword " + inQuotes(text_) +
               " below entries of a matrix. Expected one matrix, in a file of its own");
        keyword = line_;
        whole = isUnsymmetric();
        continue;
      }
      const auto fields = split();
      if (fields.size() == 3)
        fail(
            "has 3 numbers: FORMAT=COORDINATE has no labels of dofs. Write the matrices with "
            "FORMAT=MATRIX INPUT, lines \"node, dof, node, dof, value\"");
      if (fields.size() != 5)
        fail("has " + std::to_string(fields.size()) +
             " numbers, expected 5: \"node, dof, node, dof, value\"");
      const PointDof row = dof(fields, 0), column = dof(fields, 2);
      const auto place = std::make_pair(row, column);
      if (!given.emplace(place, value(fields, 4)).second)
        fail("gives the entry of " + describe(place.first) + " and " + describe(place.second) +
             " twice");
    }
    if (given.empty())
      throw DeckError(
          path_ + " has no entry of a matrix. Expected lines \"node, dof, node, dof, value\"" +
          (quantity == Quantity::Damping ? "; remove the file where there is no damping." : "."));
    const bool symmetric = !whole && isOneTriangle(given);
    LabelledMatrix out{quantity, name, path_, {}};
    for (const auto& [place, number] : given) {
      out.entries.push_back({place.first, place.second, number});
      if (symmetric && !(place.first == place.second) &&
          given.count({place.second, place.first}) == 0)
        out.entries.push_back({place.second, place.first, number});
    }
    return out;
  }

  LabelledLoad load() {
    LabelledLoad out{"loads", "1", path_, {}};
    while (next()) {
      if (text_[0] == '*') {
        const auto words = upper(text_);
        if (words.rfind("*CLOAD", 0) != 0 || words.find("IMAGINARY") != std::string::npos)
          fail("is the keyword " + inQuotes(text_) + ", expected *CLOAD with real loads");
        continue;
      }
      const auto fields = split();
      if (fields.size() != 3)
        fail("has " + std::to_string(fields.size()) + " numbers, expected 3: \"node, dof, force\"");
      out.forces[dof(fields, 0)] += value(fields, 2);
    }
    return out;
  }

 private:
  using Entries = std::map<std::pair<PointDof, PointDof>, double>;

  /// True if the keyword *MATRIX INPUT of this line has TYPE=UNSYMMETRIC.
  bool isUnsymmetric() const {
    auto words = tooljoint::split(upper(text_), ',');
    const auto keyword = trim(words.front());
    if (keyword != "*MATRIX INPUT" && keyword != "*MATRIXINPUT")
      fail("is the keyword " + inQuotes(text_) +
           ". Expected the output of *MATRIX GENERATE and *MATRIX OUTPUT, lines \"node, dof, "
           "node, dof, value\"");
    bool unsymmetric = false;
    for (auto word = words.begin() + 1; word != words.end(); ++word) {
      const auto equals = word->find('=');
      const auto name = trim(word->substr(0, equals));
      const auto value = equals == std::string::npos ? "" : trim(word->substr(equals + 1));
      if (name == "TYPE" && (value == "SYMMETRIC" || value == "UNSYMMETRIC"))
        unsymmetric = value == "UNSYMMETRIC";
      else if (name != "NAME")
        fail("gives " + inQuotes(trim(*word)) +
             ", expected of *MATRIX INPUT a NAME, and TYPE = SYMMETRIC or UNSYMMETRIC");
    }
    return unsymmetric;
  }

  /// True if the file contains one triangle of a symmetric matrix: nonzero entries have no
  /// transpose. DeckError if equal pairs occur beside such entries.
  bool isOneTriangle(const Entries& given) const {
    const Entries::value_type *alone = nullptr, *paired = nullptr;
    bool unequal = false;
    for (const auto& entry : given) {
      if (entry.first.first == entry.first.second) continue;
      const auto transposed = given.find({entry.first.second, entry.first.first});
      if (transposed == given.end()) {
        if (entry.second != 0.0) alone = &entry;
      } else if (entry.second != 0.0) {
        paired = &entry;
        unequal = unequal || entry.second != transposed->second;
      }
    }
    if (alone != nullptr && paired != nullptr && !unequal)
      throw DeckError(path_ + " gives the entry of " + describe(paired->first.first) + " and " +
                      describe(paired->first.second) + " in both triangles, but that of " +
                      describe(alone->first.first) + " and " + describe(alone->first.second) +
                      " in one. Expected one triangle of a symmetric matrix, or both.");
    return paired == nullptr;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw DeckError(path_ + ":" + std::to_string(line_) + " " + what + ".");
  }
  [[noreturn]] void failAt(std::size_t field, const std::string& text,
                           const std::string& expected) const {
    throw DeckError(path_ + ":" + std::to_string(line_) + ": field " + std::to_string(field + 1) +
                    " is " + inQuotes(text) + ", expected " + expected + ".");
  }

  /// Goes to the next line that is neither comment nor empty.
  bool next() {
    while (in_.line(text_, longestLine)) {
      ++line_;
      text_ = trim(text_);
      if (text_.rfind("%%MatrixMarket", 0) == 0)
        fail(
            "is a Matrix Market file, which has no labels of dofs. Name it in a part.json as "
            "\"stiffness\" or \"mass\", beside \"dofs\"");
      if (!text_.empty() && text_.rfind("**", 0) != 0) return true;
    }
    return false;
  }

  /// Fields separated by commas or blanks.
  std::vector<std::string> split() const {
    std::vector<std::string> out;
    std::string field;
    bool comma = false;
    for (const char c : text_ + ",") {
      const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
      if (c != ',' && !blank) {
        field += c;
        comma = false;
      } else if (!field.empty()) {
        out.push_back(field);
        field.clear();
        comma = c == ',';
      } else if (c == ',') {
        if (comma) out.emplace_back();
        comma = true;
      }
    }
    return out;
  }

  PointDof dof(const std::vector<std::string>& fields, std::size_t at) const {
    const auto node = wholeNumber(fields[at]), number = wholeNumber(fields[at + 1]);
    if (!fields[at].empty() && fields[at][0] == '-')
      failAt(at, fields[at],
             "a node from 1. Negative ones are internal to Abaqus (hybrid elements, Lagrange "
             "multipliers) and cannot be joined or held");
    if (node < 1) failAt(at, fields[at], "a node from 1");
    if (number < 1 || number > 6)
      failAt(at + 1, fields[at + 1],
             "a displacement or rotation, 1 to 6. Temperatures, pressures and warping are no dofs "
             "of a part");
    return {node, static_cast<int>(number)};
  }

  double value(const std::vector<std::string>& fields, std::size_t at) const {
    double out = 0.0;
    if (!fortranNumber(fields[at], false, out)) failAt(at, fields[at], "a finite number");
    return out;
  }

  std::string path_;
  InputFile in_;
  std::string text_;
  long line_ = 0;
};

/// The set of files written by Abaqus: JOB_STIFn.mtx, JOB_MASSn.mtx ...
class Job {
 public:
  /// The job of one of its files; none for a file with another name.
  static std::optional<Job> of(const std::string& path) {
    const auto stem = fs::path(path).stem().string();
    for (const auto& tag : tags)
      if (const auto mark = upper(stem).rfind(std::string("_") + tag.name);
          mark != std::string::npos)
        return Job(path, mark + 1);
    return std::nullopt;
  }

  /// The file with this tag, whether it exists or not.
  std::string file(const std::string& tag) const {
    const auto stem = path_.stem().string();
    const auto name = stem.substr(0, mark_) + tag + stem.substr(mark_ + tag.size());
    return (path_.parent_path() / (name + path_.extension().string())).string();
  }

  /// The existing files by content.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> out;
    std::error_code ignored;
    for (const auto& tag : tags)
      if (const auto name = file(tag.name); fs::exists(name, ignored)) out[tag.key] = name;
    return out;
  }

 private:
  Job(fs::path path, std::size_t mark) : path_(std::move(path)), mark_(mark) {}
  fs::path path_;
  std::size_t mark_;  ///< where the tag begins in the stem
};

class AbaqusMatrices : public PartFormat {
 public:
  std::vector<std::string> extensions() const override { return {".mtx"}; }
  bool recognises(const std::string&) const override { return false; }

  LabelledPart read(const PartFiles& given) const override {
    const auto files = given.whole.empty() ? given.named : beside(given.whole);
    LabelledPart part;
    part.file = given.main();
    for (const auto& [key, file] : files) {
      if (key == "loads")
        part.loads.push_back(MtxFile(file).load());
      else if (key == "mapping")
        throw DeckError(file +
                        " is named as \"mapping\", but the matrices of Abaqus carry their "
                        "labels themselves. Remove it.");
      else
        part.matrices.push_back(MtxFile(file).matrix(key == "stiffness" ? Quantity::Stiffness
                                                     : key == "mass"    ? Quantity::Mass
                                                                        : Quantity::Damping,
                                                     key));
    }
    for (const auto& one : part.matrices)
      if (one.quantity == Quantity::Stiffness)
        for (const auto& entry : one.entries)
          if (entry.row == entry.column && entry.value >= boundaryCondition)
            part.held.insert(entry.row);
    return part;
  }

  std::vector<std::string> companions(const std::string& path) const override {
    std::vector<std::string> out;
    if (const auto job = Job::of(path))
      for (const auto& [key, file] : job->files()) out.push_back(file);
    return out;
  }

 private:
  /// All files of the job by content.
  static std::map<std::string, std::string> beside(const std::string& path) {
    const auto job = Job::of(path);
    if (!job) return alone(path);
    std::error_code ignored;
    if (const auto structural = job->file("DMPS"); fs::exists(structural, ignored))
      throw DeckError(structural +
                      " is structural damping, a complex stiffness without meaning in time. "
                      "Remove it, or give viscous damping.");
    auto files = job->files();
    for (const auto& needed : {tags[0], tags[1]})
      if (files.count(needed.key) == 0)
        throw DeckError(path + " has no " + needed.key + " beside it: expected the file " +
                        job->file(needed.name) +
                        ". Ask for STIFFNESS and MASS in *MATRIX OUTPUT, or name the files in a "
                        "part.json as \"matrices\".");
    return files;
  }

  /// Reports why this file is not a part.
  [[noreturn]] static std::map<std::string, std::string> alone(const std::string& path) {
    if (const std::string reason = whyUnreadable(path); !reason.empty())
      throw DeckError(path + " cannot be read: " + reason + ".");
    MtxFile(path).matrix(Quantity::Stiffness, "");  // reports its other faults
    throw DeckError(path +
                    " is one matrix of a part. Name JOB_STIFn.mtx, beside which JOB_MASSn.mtx is, "
                    "or a part.json with \"matrices\": {\"stiffness\": ..., \"mass\": ...}.");
  }
};

const bool abaqusMatricesRegistered = PartFormats::instance().add(
    "Abaqus matrices", {"Files of *MATRIX OUTPUT, FORMAT=MATRIX INPUT.", {}, [] {
                          return std::make_unique<AbaqusMatrices>();
                        }});

}  // namespace

}  // namespace tooljoint::parts
