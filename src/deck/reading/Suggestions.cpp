// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for unknown names: the sentences after "is not a parameter" and "is not a list".
#include "common/Text.hpp"
#include "deck/Describe.hpp"
#include "deck/reading/Validator.hpp"

namespace tooljoint::deck {
namespace {

std::vector<std::string> parameterNames(const ListSpec& list) {
  std::vector<std::string> names;
  for (const ParameterSpec& parameter : list.parameters()) names.push_back(parameter.name);
  return names;
}

std::vector<std::string> listNames(const ListSpec& list) {
  std::vector<std::string> names;
  for (const ListSpec& sublist : list.lists()) names.push_back(sublist.name());
  return names;
}

bool declares(const ListSpec& list, const std::string& name) {
  for (const ListSpec& sublist : list.lists()) {
    if (sublist.name() == name) return true;
  }
  return false;
}

/// Adds the paths of the lists below `list` with a parameter (or a list) of this name.
void collectHomes(const ListSpec& list, const std::string& path, const std::string& name,
                  bool ofList, std::vector<std::string>& homes) {
  if (ofList ? declares(list, name) : list.findParameter(name) != nullptr)
    homes.push_back(path.empty() ? "/" : path);
  for (const ListSpec& sublist : list.lists())
    collectHomes(sublist, path + "/" + sublist.name(), name, ofList, homes);
  if (list.pattern() != nullptr)
    collectHomes(*list.pattern(), path + "/<" + list.pattern()->name() + ">", name, ofList, homes);
}

std::string elsewhere(const ListSpec& root, const std::string& sceneName, const std::string& name,
                      bool ofList) {
  std::vector<std::string> homes;
  collectHomes(root, "", name, ofList, homes);
  if (homes.empty() || homes.size() > 3) return "";
  for (std::string& home : homes) home = "/" + sceneName + (home == "/" ? "" : home);
  return std::string(" A ") + (ofList ? "list" : "parameter") + " of that name stands in " +
         join(homes, " and in ") + ".";
}

std::string sceneNameOf(const std::string& path) { return path.substr(1, path.find('/', 1) - 1); }

/// `Available: the parameters "A", "B" and the lists "C".`
std::string known(const ListSpec& list) {
  const std::string parameters = quotedList(parameterNames(list));
  const std::string lists = quotedList(listNames(list));
  std::string result;
  if (!parameters.empty()) result = "the parameters " + parameters;
  if (!lists.empty()) result += (result.empty() ? "" : " and ") + ("the lists " + lists);
  if (list.pattern() != nullptr)
    result += (result.empty() ? "" : " and ") + std::string("lists named by you");
  return result.empty() ? " This list has no parameters." : " Available: " + result + ".";
}

/// `Did you mean "Stiffness"? It is ...`, over parameters and lists; "" if nothing is similar.
std::string didYouMean(const ListSpec& list, const std::string& name, bool listsFirst) {
  const std::string parameter = closest(name, parameterNames(list));
  const std::string sublist = closest(name, listNames(list));
  if (!sublist.empty() && (listsFirst || parameter.empty())) {
    return std::string(" Did you mean ") + (listsFirst ? "" : "the list ") + "\"" + sublist +
           "\"? " + introduce(*list.findList(sublist));
  }
  if (parameter.empty()) return "";
  return std::string(" Did you mean ") + (listsFirst ? "the parameter " : "") + "\"" + parameter +
         "\"? " + introduce(*list.findParameter(parameter));
}

std::string nowCalled(const std::string& path, const std::string& name, const std::string& now,
                      const ParameterSpec& parameter) {
  return path + "/" + name + " is now called \"" + now + "\". " + introduce(parameter);
}

/// The list that contains the list of this path; null if the path has an undeclared name.
const ListSpec* parentOf(const ListSpec& root, const std::string& path) {
  const auto names = split(path.substr(1), '/');
  const ListSpec* list = &root;
  for (std::size_t i = 1; i + 1 < names.size() && list != nullptr; ++i) {
    const ListSpec* next = nullptr;
    for (const ListSpec& sublist : list->lists())
      if (sublist.name() == names[i]) next = &sublist;
    list = next;
  }
  return names.size() > 1 ? list : nullptr;
}

}  // namespace

std::string unknownParameter(const ListSpec& root, const ListSpec& list, const std::string& path,
                             const std::string& name) {
  if (const ParameterSpec* renamed = list.findFormer(name))
    return nowCalled(path, name, renamed->name, *renamed);
  for (const ListSpec& sublist : list.lists())
    if (const ParameterSpec* moved = sublist.findFormer("../" + name))
      return nowCalled(path, name, sublist.name() + "/" + moved->name, *moved);
  if (const ListSpec* parent = parentOf(root, path))
    if (const ParameterSpec* moved = parent->findFormer(list.name() + "/" + name))
      return nowCalled(path, name, parent->name() + "/" + moved->name, *moved);
  if (const std::string* instead = list.findRemoved(name))
    return path + "/" + name + " was removed: " + *instead;
  std::string text = path + "/" + name + " is not a parameter.";
  if (declares(list, name))
    return text + " It is a list: write <ParameterList name=\"" + name + "\">.";
  const std::string guess = didYouMean(list, name, false);
  const std::string home = elsewhere(root, sceneNameOf(path), name, false);
  return text + guess + home + (guess.empty() && home.empty() ? known(list) : "");
}

std::string unknownList(const ListSpec& root, const ListSpec& list, const std::string& path,
                        const std::string& name, const RawList& present) {
  std::string text = path + "/" + name + " is not a list.";
  if (list.findParameter(name) != nullptr) {
    return text + " It is a parameter: write <Parameter name=\"" + name + "\" type=\"" +
           typeName(list.findParameter(name)->kind) + "\" value=\"...\"/>.";
  }
  std::vector<std::string> own;
  for (const RawList& sublist : present.lists()) own.push_back(sublist.name);
  if (list.pattern() != nullptr) {
    const std::string near = closest(name, own);
    return text +
           (own.empty() ? " The deck has no lists there."
                        : " The deck has " + quotedList(own) + " there.") +
           (near.empty() ? "" : " Did you mean \"" + near + "\"?");
  }
  const std::string guess = didYouMean(list, name, true);
  const std::string home = elsewhere(root, sceneNameOf(path), name, true);
  return text + guess + home + (guess.empty() && home.empty() ? known(list) : "");
}

}  // namespace tooljoint::deck
