// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "io/MatrixMarket.hpp"
#include "parts/file/PartFile.hpp"
#include "parts/file/PartSource.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

using Json = nlohmann::ordered_json;

/// Largest JSON file of a part; larger matrices must be in separate files [bytes].
constexpr std::uint64_t largestJson = 1ULL << 28U;

/// A JSON file whose matrices are in Matrix Market files in the same folder, or lists of rows in
/// the JSON file.
class JsonSource : public PartSource {
 public:
  explicit JsonSource(const std::string& path) : file_(path), inDeck_(isPartText(path)) {
    std::error_code ignored;
    if (inDeck_)
      file_ = "the part in the deck";
    else if (std::filesystem::is_directory(path, ignored))
      file_ = (std::filesystem::path(path) / "part.json").string();
    try {
      root_ = parsed(inDeck_ ? path : readInput(file_, largestJson));
    } catch (const FileError& fault) {
      throw DeckError(fault.what());
    } catch (const Json::exception& fault) {
      throw DeckError(file_ + " is no JSON: " + printable(fault.what()) + ".");
    }
    if (!root_.is_object())
      throw DeckError(file_ + " must hold one object, {\"format\": ..., \"dofs\": ..., ...}.");
  }

  std::string file() const override { return file_; }
  bool has(const std::string& path) const override { return find(path) != nullptr; }

  std::vector<std::string> names(const std::string& group) const override {
    const Json& value = group.empty() ? root_ : at(group);
    if (!value.is_object()) fail(group, "must be an object of names");
    std::vector<std::string> out;
    for (const auto& [key, one] : value.items()) out.push_back(key);
    return out;
  }

  std::string text(const std::string& path) const override {
    if (!at(path).is_string()) fail(path, "must be a text");
    return at(path).get<std::string>();
  }

  std::vector<std::string> texts(const std::string& path) const override {
    std::vector<std::string> out;
    for (const auto& one : list(path)) {
      if (!one.is_string()) fail(path, "must be a list of texts");
      out.push_back(one.get<std::string>());
    }
    return out;
  }

  std::vector<DofName> dofs(const std::string& path) const override {
    std::vector<DofName> out;
    if (at(path).is_string()) {
      const Matrix rows = table(path);
      for (Eigen::Index i = 0; i < rows.rows(); ++i) out.push_back(fromRow(path, rows.row(i)));
      return out;
    }
    for (const auto& one : list(path)) out.push_back(fromJson(path, one));
    return out;
  }

  Sparse matrix(const std::string& path) const override { return matrixOf(path, at(path)); }

  Matrix table(const std::string& path) const override {
    const Json& value = at(path);
    return value.is_string() ? io::readMatrixMarketDense(beside(value))
                             : Matrix(matrixOf(path, value));
  }

  std::vector<NamedTerm> terms(const std::string& path) const override {
    const Json& value = at(path);
    std::vector<NamedTerm> out;
    const bool several = value.is_array() && !value.empty() && value[0].is_object();
    if (!several) return {term(path, value, path)};
    for (const auto& one : value)
      out.push_back(term(path, one, path + " " + std::to_string(out.size() + 1)));
    return out;
  }

 private:
  /// DeckError for an object with a repeated name, of which a parser would take either.
  Json parsed(const std::string& text) const {
    std::vector<std::set<std::string>> open;
    return Json::parse(text, [&](int, Json::parse_event_t event, const Json& value) {
      if (event == Json::parse_event_t::object_start)
        open.emplace_back();
      else if (event == Json::parse_event_t::object_end)
        open.pop_back();
      else if (event == Json::parse_event_t::key && !open.back().insert(value).second)
        throw DeckError(file_ + " gives " + inQuotes(value.get<std::string>()) +
                        " twice in one object. Keep one of them.");
      return true;
    });
  }

  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw DeckError(file_ + ": " + inQuotes(path) + " " + what + ".");
  }

  const Json* find(const std::string& path) const {
    const Json* value = &root_;
    for (const auto& step : split(path, '/')) {
      if (!value->is_object() || !value->contains(step)) return nullptr;
      value = &(*value)[step];
    }
    return value;
  }
  const Json& at(const std::string& path) const {
    const Json* value = find(path);
    if (value == nullptr) fail(path, "is missing");
    return *value;
  }
  const Json& list(const std::string& path) const {
    if (!at(path).is_array()) fail(path, "must be a list");
    return at(path);
  }

  NamedTerm term(const std::string& path, const Json& value, const std::string& name) const {
    NamedTerm out;
    out.name = name;
    if (value.is_object()) {
      for (const auto& [key, one] : value.items())
        if (key != "matrix" && key != "vector" && key != "law" && key != "name")
          fail(path, "holds " + inQuotes(key) +
                         ". A term has \"name\", \"law\" and \"matrix\" (or \"vector\")");
      for (const char* key : {"law", "name"})
        if (value.contains(key)) {
          if (!value[key].is_string())
            fail(path, std::string("has a \"") + key + "\" that is not a text");
          (std::string(key) == "law" ? out.law : out.name) = value[key].get<std::string>();
        }
      const char* key = value.contains("vector") ? "vector" : "matrix";
      if (!value.contains(key)) fail(path, "has a term without \"matrix\"");
      out.matrix = matrixOf(path, value[key]);
      out.where = where(out.name, value[key]);
      return out;
    }
    out.matrix = matrixOf(path, value);
    out.where = where(path, value);
    return out;
  }

  static std::string where(const std::string& name, const Json& value) {
    return name + (value.is_string() ? " (" + value.get<std::string>() + ")" : "");
  }

  /// A file named in the JSON file, relative to its folder unless absolute.
  std::string beside(const Json& value) const {
    const std::filesystem::path name = value.get<std::string>();
    if (inDeck_ && !name.is_absolute())
      throw DeckError(file_ + " names the file " + inQuotes(name.string()) +
                      ", but stands in no folder: give a list of rows, or an absolute path.");
    return name.is_absolute() ? name.string()
                              : (std::filesystem::path(file_).parent_path() / name).string();
  }

  /// Reads the name of a Matrix Market file, a list of rows, or a list of numbers (one column).
  Sparse matrixOf(const std::string& path, const Json& value) const {
    if (value.is_string()) return io::readMatrixMarket(beside(value));
    if (!value.is_array() || value.empty())
      fail(path, "must be the name of a Matrix Market file or a list of rows");
    const auto columns = value[0].is_array() ? value[0].size() : 1;
    Triplets entries;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const Json row = value[i].is_array() ? value[i] : Json::array({value[i]});
      if (row.size() != columns)
        fail(path, "has rows of different lengths: " + std::to_string(columns) + " and " +
                       std::to_string(row.size()) + " numbers");
      for (std::size_t j = 0; j < columns; ++j) {
        if (!row[j].is_number())
          fail(path, "has an entry in row " + std::to_string(i + 1) +
                         " that is not a number: " + row[j].dump());
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), row[j].get<double>());
      }
    }
    Sparse out(static_cast<Eigen::Index>(value.size()), static_cast<Eigen::Index>(columns));
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  DofName fromJson(const std::string& path, const Json& one) const {
    DofName dof;
    if (one.is_number_integer()) {
      dof.node = one.get<std::int64_t>();
      return dof;
    }
    const bool pair = one.is_array() && one.size() == 2;
    if (pair && one[0] == "mode" && one[1].is_number_integer()) {
      dof.mode = true;
      dof.number = one[1].get<int>();
    } else if (pair && one[0].is_number_integer() &&
               (one[1].is_string() || one[1].is_number_integer())) {
      dof.node = one[0].get<std::int64_t>();
      if (one[1].is_string())
        dof.component = one[1].get<std::string>();
      else
        dof.number = one[1].get<int>();
    } else {
      fail(path,
           "has the entry " + one.dump() +
               ". A dof is [node, \"component\"] or [\"mode\", number]; a node is its number");
    }
    return dof;
  }

  DofName fromRow(const std::string& path, const Vector& row) const {
    if (row.size() > 2 || (row.array() != row.array().round()).any())
      fail(path, "must have rows \"node\" or \"node component\" of whole numbers");
    DofName dof;
    dof.node = static_cast<std::int64_t>(row[0]);
    if (row.size() == 2) dof.number = static_cast<int>(row[1]);
    dof.mode = dof.node == 0;
    return dof;
  }

  std::string file_;
  bool inDeck_ = false;
  Json root_;
};

/// Adds `path` and the files that its format reads with it.
void addWithCompanions(const std::string& path, std::set<std::string>& files) {
  files.insert(path);
  if (const auto format = partFormatByExtension(path))
    for (const auto& companion : format->companions(path)) files.insert(companion);
}

}  // namespace

std::set<std::string> filesOfPart(const std::string& path) {
  std::set<std::string> files;
  addWithCompanions(path, files);
  if (std::filesystem::path(path).extension() != ".json") return files;
  const Json root = Json::parse(readInput(path, largestJson), nullptr, false);
  if (root.is_discarded()) return files;  // not JSON; its reader reports that
  const Json leaves = root.flatten();
  for (const auto& [key, value] : leaves.items()) {
    if (!value.is_string()) continue;
    const auto named = std::filesystem::path(path).parent_path() / value.get<std::string>();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(named, ignored)) addWithCompanions(named.string(), files);
  }
  return files;
}

bool isPartText(const std::string& file) { return !file.empty() && file.front() == '{'; }

std::unique_ptr<PartSource> openJsonPart(const std::string& path) {
  return std::make_unique<JsonSource>(path);
}

std::unique_ptr<PartSource> openPart(const std::string& path) {
  std::error_code ignored;
  const bool json = isPartText(path) || std::filesystem::is_directory(path, ignored) ||
                    std::filesystem::path(path).extension() == ".json";
  if (json) return withForeignMatrices(openJsonPart(path));
  const auto format = partFormatOf(path);
  return format != nullptr ? openForeignPart(*format, {path, {}}) : openHdf5Part(path);
}

}  // namespace tooljoint::parts
