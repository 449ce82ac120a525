// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Deck.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "deck/reading/FileName.hpp"
#include "deck/reading/Overrides.hpp"
#include "deck/reading/Units.hpp"
#include "deck/reading/Validator.hpp"
#include "deck/reading/XmlReader.hpp"

namespace tooljoint::deck {

struct Deck::Source {
  std::string text;
  RawList tree;
  ListSpec scene;
};

struct Deck::Map {
  Places places;

  /// Position of a path, or of the nearest list that contains it.
  const Place& nearest(std::string path) const {
    while (true) {
      const auto it = places.find(path);
      if (it != places.end()) return it->second;
      const auto slash = path.rfind('/');
      path = slash == std::string::npos ? "" : path.substr(0, slash);
    }
  }
};

namespace {

void requireConsistent(const ListSpec& spec) {
  const std::vector<std::string> faults = spec.inconsistencies();
  if (!faults.empty())
    throw std::logic_error("The description of a deck contradicts itself: " + join(faults, "; ") +
                           ".");
}

/// "is required" continues a path, "The bit ..." does not.
bool continues(const std::string& sentence) {
  return !sentence.empty() && std::islower(static_cast<unsigned char>(sentence[0])) != 0;
}

}  // namespace

Deck Deck::parse(const std::string& text, const std::string& file, const ListSpec& scene,
                 const std::vector<std::string>& overrides) {
  return parse(
      text, file, [&](const std::vector<std::string>&) { return scene; }, overrides);
}

Deck Deck::parse(const std::string& text, const std::string& file, const ChooseSpec& choose,
                 const std::vector<std::string>& overrides) {
  RawList tree = readXml(text, file);
  std::vector<std::string> names;
  for (const RawList& list : tree.lists())
    if (std::find(overrides.begin(), overrides.end(), "!" + list.name) == overrides.end())
      names.push_back(list.name);
  ListSpec scene = choose(names);
  requireConsistent(scene);
  return make(std::make_shared<const Source>(Source{text, std::move(tree), std::move(scene)}), file,
              overrides);
}

Deck Deck::with(const std::vector<std::string>& overrides) const {
  return make(source_, file_, overrides);
}

Deck Deck::make(std::shared_ptr<const Source> source, const std::string& file,
                const std::vector<std::string>& overrides) {
  std::vector<Finding> findings;
  RawList tree = source->tree;
  applyOverrides(tree, source->scene, overrides, findings);
  auto map = std::make_shared<Map>();
  auto list = std::make_shared<Teuchos::ParameterList>(
      validate(tree, source->scene, findings, map->places));
  raise(std::move(findings), file);

  Deck deck;
  deck.file_ = file;
  deck.name_ = tree.name;
  deck.source_ = std::move(source);
  deck.overrides_ = overrides;
  markOrigin(*list, file);
  deck.list_ = std::move(list);
  deck.places_ = std::move(map);
  return deck;
}

Deck Deck::read(const std::string& file, const ListSpec& scene,
                const std::vector<std::string>& overrides) {
  return read(
      file, [&](const std::vector<std::string>&) { return scene; }, overrides);
}

Deck Deck::read(const std::string& file, const ChooseSpec& choose,
                const std::vector<std::string>& overrides) {
  std::string text;
  parallel::agree([&] {
    if (parallel::rank() == 0) text = readTextFile(file);
  });
  parallel::broadcast(text, 0);
  return parse(text, file, choose, overrides);
}

Deck Deck::readNamed(const std::string& path, const std::string& name,
                     const ListSpec& library) const {
  try {
    return read(resolve(name), library);
  } catch (const FileError& fault) {
    throw DeckError(error(path, std::string("names a file, but ") + fault.what()));
  }
}

std::string Deck::text() const { return source_->text; }

std::string Deck::sha256() const { return tooljoint::sha256(text()); }

std::string Deck::folder() const {
  const auto slash = file_.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : file_.substr(0, slash);
}

std::string Deck::resolve(const std::string& name) const {
  if (!name.empty() && name[0] == '/') return name;
  const std::string base = folder();
  return base == "." ? name : (base == "/" ? "/" : base + "/") + name;
}

std::string Deck::relative(const std::string& path) const {
  const bool absolute = !path.empty() && path[0] == '/';
  std::string bare = absolute ? path.substr(1) : path;
  const std::string prefix = name_ + "/";
  const bool named = bare == name_ || bare.compare(0, prefix.size(), prefix) == 0;
  if (!named || (!absolute && places_->places.count(bare) != 0)) return bare;
  return bare == name_ ? "" : bare.substr(prefix.size());
}

bool Deck::gives(const std::string& path) const {
  return places_->places.count(relative(path)) != 0;
}

Given Deck::given(const std::string& path, const std::string& si) const {
  const std::string below = relative(path);
  Given found{below.substr(below.rfind('/') + 1), si, 1.0};
  const auto place = places_->places.find(below);
  if (place == places_->places.end()) return found;
  std::string ignored;
  const auto& [unit, diameter] = std::tie(place->second.unit, place->second.diameter);
  if (!unit.empty()) found = {found.name, unit, toSi("1 " + unit, si, ignored).value_or(1.0)};
  return diameter.empty() ? found : Given{diameter, found.unit, found.factor / 2.0};
}

std::string Deck::where(const std::string& path) const {
  std::string below = relative(path);
  const auto place = places_->places.find(below);
  if (place != places_->places.end() && !place->second.diameter.empty())
    below = below.substr(0, below.rfind('/') + 1) + place->second.diameter;
  return places_->nearest(below).text(file_) + ": /" + name_ + (below.empty() ? "" : "/" + below);
}

std::string Deck::error(const std::string& path, const std::string& sentence) const {
  return where(path) + (continues(sentence) ? " " : ": ") + sentence;
}

std::string Deck::located(const std::string& message) const {
  const std::string root = "/" + name_;
  if (message.compare(0, root.size(), root) != 0) return message;
  // Names may contain blanks and colons, so the longest known path at the beginning of the message
  // is used.
  std::string best;
  for (const auto& [path, place] : places_->places) {
    const std::string full = root + (path.empty() ? "" : "/" + path);
    if (full.size() >= best.size() && message.compare(0, full.size(), full) == 0) best = full;
  }
  if (best.empty() ||
      (best == root && message.size() > root.size() && message[root.size()] != '/' &&
       message[root.size()] != ' ' && message[root.size()] != ':')) {
    return message;
  }
  return places_->nearest(relative(best)).text(file_) + ": " + message;
}

void Problems::add(const std::string& path, const std::string& sentence) {
  add(deck_, path, sentence);
}

void Problems::add(const Deck& library, const std::string& path, const std::string& sentence) {
  const Place& place = library.places_->nearest(library.relative(path));
  // The deck comes first (""), then its libraries by name.
  const std::string file = library.file() == deck_.file() ? "" : library.file();
  items_.push_back({file, place.overrideNumber, place.line, library.error(path, sentence)});
}

void Problems::raise() const {
  if (items_.empty()) return;
  std::vector<Item> sorted = items_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Item& a, const Item& b) {
    return std::tie(a.file, a.overrideNumber, a.line) < std::tie(b.file, b.overrideNumber, b.line);
  });
  std::vector<std::string> lines;
  for (const Item& item : sorted) lines.push_back(item.text);
  throw DeckError(join(lines, "\n"));
}

Teuchos::ParameterList defaults(const ListSpec& spec) {
  Teuchos::ParameterList result(spec.name());
  for (const ParameterSpec& parameter : spec.parameters()) {
    if (std::holds_alternative<Required>(parameter.value)) {
      throw DeckError("\"" + spec.name() + "/" + parameter.name + "\" is required but missing.");
    }
    setDefault(result, parameter);
  }
  for (const ListSpec& sublist : spec.lists()) {
    if (sublist.required()) result.set(sublist.name(), defaults(sublist));
  }
  return result;
}

Teuchos::ParameterList variantList(const Teuchos::ParameterList& list, const std::string& variant,
                                   const ListSpec& parameters) {
  if (list.isSublist(variant)) return list.sublist(variant);
  try {
    return defaults(parameters.named(variant)).setName(list.name() + "/" + variant);
  } catch (const DeckError&) {
    throw DeckError(list.name() + " needs the list \"" + variant +
                    "\", since some of its parameters are required.");
  }
}

}  // namespace tooljoint::deck
