// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "common/Text.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

constexpr const char* entryName = "matrices";
const std::vector<std::string> keys{"stiffness", "mass", "damping", "loads", "mapping"};

/// Combines sets, states and names of a JSON file with matrices and labels from the files of
/// another code.
class JoinedSource : public PartSource {
 public:
  explicit JoinedSource(std::unique_ptr<PartSource> json) : json_(std::move(json)) {
    const auto files = filesOf();
    const auto format = partFormatOf(files.main());
    if (format == nullptr)
      fail("names " + files.main() + ", which is of no known format: by its extension a file of " +
           join(PartFormats::instance().names(), ", "));
    foreign_ = openForeignPart(*format, files);
    for (const auto& name : foreign_->names(""))
      if (name != "format" && json_->has(name))
        throw DeckError(json_->file() + ": " + inQuotes(name) + " stands beside " +
                        inQuotes(entryName) + ", and " + files.main() +
                        " gives it as well. Keep one of them.");
  }

  std::string file() const override { return json_->file(); }
  bool has(const std::string& path) const override {
    return json_->has(path) || foreign_->has(path);
  }
  std::vector<std::string> names(const std::string& group) const override {
    auto out = json_->names(group);
    if (!group.empty()) return out;
    for (const auto& name : foreign_->names(""))
      if (name != "format") out.push_back(name);
    return out;
  }
  std::string text(const std::string& path) const override { return of(path).text(path); }
  std::vector<std::string> texts(const std::string& path) const override {
    return of(path).texts(path);
  }
  std::vector<DofName> dofs(const std::string& path) const override { return of(path).dofs(path); }
  Sparse matrix(const std::string& path) const override { return of(path).matrix(path); }
  Matrix table(const std::string& path) const override { return of(path).table(path); }
  std::vector<NamedTerm> terms(const std::string& path) const override {
    return of(path).terms(path);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw DeckError(json_->file() + ": " + inQuotes(entryName) + " " + what + ".");
  }

  const PartSource& of(const std::string& path) const {
    return json_->has(path) ? *json_ : *foreign_;
  }

  std::string beside(const std::string& path) const {
    const std::filesystem::path name = json_->text(path);
    return name.is_absolute()
               ? name.string()
               : (std::filesystem::path(json_->file()).parent_path() / name).string();
  }

  PartFiles filesOf() const {
    PartFiles files;
    std::vector<std::string> given;
    try {
      given = json_->names(entryName);
    } catch (const DeckError&) {
      files.whole = beside(entryName);  // not an object: the name of one file
      return files;
    }
    for (const auto& key : given) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail("has the entry " + inQuotes(key) + ". Available: " + quotedList(keys));
      files.named[key] = beside(std::string(entryName) + "/" + key);
    }
    for (const char* needed : {"stiffness", "mass"})
      if (files.named.count(needed) == 0)
        fail(std::string("names no \"") + needed + "\". A part has stiffness and mass");
    return files;
  }

  std::unique_ptr<PartSource> json_, foreign_;
};

}  // namespace

std::unique_ptr<PartSource> withForeignMatrices(std::unique_ptr<PartSource> json) {
  if (!json->has(entryName)) return json;
  return std::make_unique<JoinedSource>(std::move(json));
}

}  // namespace tooljoint::parts
