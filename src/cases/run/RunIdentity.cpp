// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/RunIdentity.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "cases/CaseLists.hpp"
#include "cases/ListText.hpp"
#include "cases/measured/MeasuredLog.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "io/OutputParameters.hpp"
#include "io/TextFile.hpp"
#include "parts/file/PartFile.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::cases {

namespace {

namespace fs = std::filesystem;

/// Parameters that name a file or folder.
const std::set<std::string> fileParameters{"File", "Library", "Pipe Table"};
/// Parameters of Output that determine what is recorded.
const std::set<std::string> recorded{"Output/Fields", "Output/XDMF", "Output/XDMF Interval"};
constexpr const char* recordedFigures = "Output/Figures/";

using Lines = std::map<std::string, std::string>;

bool isAnalysis(const std::string& name) {
  const auto& lists = AnalysisLists::instance().lists();
  return std::any_of(lists.begin(), lists.end(),
                     [&](const AnalysisList& list) { return list.name == name; });
}

class Describer {
 public:
  explicit Describer(const deck::Deck& deck) : deck_(deck) {
    if (!deck.list().isSublist("Transient")) return;
    const auto& transient = deck.list().sublist("Transient");
    const auto integrator = transient.get<std::string>("Integrator");
    const auto own =
        transient.isSublist(integrator) ? transient.sublist(integrator) : Teuchos::ParameterList();
    anywhere_ =
        transient::IntegratorRegistry::instance().make(integrator, own)->goesOnFromAnywhere();
  }

  Lines lines() {
    add(deck_.list(), "");
    if (!deck_.list().isSublist("Output")) add(deck::defaults(io::parameters()), "Output/");
    return lines_;
  }

 private:
  bool matters(const std::string& path) const {
    if (path == "Transient/Progress" || path == "Transient/Ranks") return false;
    if (path == "Transient/Checkpoint Interval") return !anywhere_;
    if (path.rfind(recordedFigures, 0) == 0) return true;
    return path.rfind("Output/", 0) != 0 || recorded.count(path) > 0;
  }

  void add(const Teuchos::ParameterList& list, const std::string& above) {
    for (auto it = list.begin(); it != list.end(); ++it) {
      const auto& name = list.name(it);
      const std::string path = above + name;
      if (list.isSublist(name)) {
        if (isAnalysis(path) && path != measuredLogName) continue;  // its signals are recorded
        if (path != "Output") lines_[path] = "list";                // an empty list counts too
        add(list.sublist(name), path + "/");
        continue;
      }
      if (!matters(path)) continue;
      lines_[path] = valueText(list.entry(it));
      if (fileParameters.count(name) > 0 && list.isType<std::string>(name) &&
          !parts::isPartText(list.get<std::string>(name)))
        addContent(path, list.get<std::string>(name));
    }
  }

  /// Adds a file and the files read with it, all files of a folder, or all that match a pattern
  /// with "%".
  void addContent(const std::string& path, const std::string& name) {
    const fs::path file(deck_.resolve(name));
    std::error_code ignored;
    const bool folder = fs::is_directory(file, ignored);
    const auto beside = folder ? file : file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::set<std::string> files;
    if (folder || file.filename().string().find('%') != std::string::npos) {
      for (const auto& entry : fs::directory_iterator(beside, ignored)) {
        const auto& found = entry.path();
        if (folder || matches(found.filename().string(), file.filename().string()))
          files.insert(found.string());
      }
    } else if (fs::is_regular_file(file, ignored)) {
      files = parts::filesOfPart(file.string());
    }
    const bool alone = files == std::set<std::string>{file.string()};
    for (const auto& each : files)
      addFile(alone ? path : path + "/" + fs::path(each).lexically_relative(beside).string(), each);
  }

  static bool matches(const std::string& name, const std::string& pattern) {
    const auto head = pattern.substr(0, pattern.find('%')),
               tail = pattern.substr(pattern.rfind('%') + 1);
    return name.size() >= head.size() + tail.size() && name.rfind(head, 0) == 0 &&
           name.compare(name.size() - tail.size(), tail.size(), tail) == 0;
  }

  void addFile(const std::string& path, const fs::path& file) {
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored))
      lines_[path + " (content)"] = sha256(io::readText(file.string()));
  }

  const deck::Deck& deck_;
  bool anywhere_ = true;
  Lines lines_;
};

Lines parse(const std::string& text) {
  Lines lines;
  for (const auto& line : split(text, '\n')) {
    const auto middle = line.find(" = ");
    if (middle != std::string::npos) lines[line.substr(0, middle)] = line.substr(middle + 3);
  }
  return lines;
}

}  // namespace

std::string runIdentity(const deck::Deck& deck) {
  std::string text;
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    for (const auto& [path, value] : Describer(deck).lines()) {
      std::string line = value;
      for (char& c : line)
        if (c == '\n') c = ' ';
      text += path + " = " + line + "\n";
    }
  });
  parallel::broadcast(text);
  return text;
}

std::string identityDifferences(const std::string& then, const std::string& now) {
  constexpr std::size_t most = 3, longest = 200;
  const Lines a = parse(then), b = parse(now);
  std::set<std::string> paths;
  for (const Lines* lines : {&a, &b})
    for (const auto& line : *lines) paths.insert(line.first);
  std::vector<std::string> differences;
  const auto say = [](const Lines& lines, const std::string& path) {
    const auto found = lines.find(path);
    return found == lines.end() ? std::string("not given") : found->second.substr(0, longest);
  };
  for (const auto& path : paths) {
    if (differences.size() == most) break;
    const auto before = say(a, path), after = say(b, path);
    if (before == after && (a.count(path) == b.count(path)) && a.at(path) == b.at(path)) continue;
    const bool content = path.size() > 10 && path.compare(path.size() - 10, 10, " (content)") == 0;
    if (content && a.count(path) > 0 && b.count(path) > 0)
      differences.push_back("the content of the file of " + path.substr(0, path.size() - 10) +
                            " has changed");
    else
      differences.push_back(path + " was " + before + " and is " + after);
  }
  return join(differences, "; ");
}

}  // namespace tooljoint::cases
