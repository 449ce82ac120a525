// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Template.hpp"

#include <algorithm>

#include "common/Text.hpp"
#include "common/report/Terminal.hpp"
#include "deck/Describe.hpp"

namespace tooljoint::deck {
namespace {

const std::string openMark = "<!-- <";
const std::string closeMark = "> -->";

/// Text of an attribute that may also stand in a comment.
std::string escaped(const std::string& text) {
  std::string result;
  char before = '\0';
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '-' && before == '-')
      result += "&#45;";  // "--" is not allowed in a comment
    else
      result += c;
    before = c;
  }
  return result;
}

/// A sentence for a comment: "--" would end the comment, and a leading "<" would make it look like
/// a commented-out element.
std::string remark(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '-' && !result.empty() && result.back() == '-') result += ' ';
    result += c == '\n' ? ' ' : c;
  }
  if (!result.empty() && result.back() == '-') result += ' ';
  return "<!-- " + result + " -->";
}

class Writer {
 public:
  Writer(const Examples& examples, Level most) : examples_(examples), most_(most) {}

  std::string write(const ListSpec& root, const std::string& name) {
    note(0, root.doc());
    writeList(root, name, "", 0, true);
    return text_;
  }

 private:
  /// The example of a parameter, or null.
  const std::string* example(const std::string& path) const {
    const auto found = examples_.find(path);
    return found == examples_.end() ? nullptr : &found->second;
  }
  /// First path of an example in the list `path`, which ends in "/"; "" without one.
  std::string exampleIn(const std::string& path) const {
    const auto found = examples_.lower_bound(path);
    return found != examples_.end() && found->first.compare(0, path.size(), path) == 0
               ? found->first
               : "";
  }
  std::string valueOf(const ParameterSpec& parameter, const std::string& path) const {
    const auto* given = example(path + parameter.name);
    return given != nullptr ? *given : exampleValue(parameter);
  }

  /// `hanging`: additional indentation of continuation lines.
  void line(int depth, const std::string& content, std::size_t hanging = 4) {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    text_ += terminal::wrapped(indent + content, hanging) + "\n";
  }

  /// A sentence on the elements below it.
  void note(int depth, const std::string& text) {
    line(depth, remark(text), std::string("<!-- ").size());
  }

  /// `active` elements are written plainly, the others are commented out (an XML comment must not
  /// contain "--").
  void element(int depth, const std::string& content, bool active) {
    line(depth, active ? content : "<!-- " + content + " -->");
  }

  static bool asksForSomething(const ListSpec& list) {
    const auto& parameters = list.parameters();
    return std::any_of(
               parameters.begin(), parameters.end(),
               [](const ParameterSpec& p) { return std::holds_alternative<Required>(p.value); }) ||
           std::any_of(list.lists().begin(), list.lists().end(),
                       [](const ListSpec& l) { return l.required(); });
  }

  /// True if the example of a choice in `list` names the variant `sublist`, and the variant
  /// requires values.
  bool chosen(const ListSpec& list, const ListSpec& sublist, const std::string& path) const {
    const auto& parameters = list.parameters();
    return asksForSomething(sublist) &&
           std::any_of(parameters.begin(), parameters.end(), [&](const ParameterSpec& p) {
             return p.kind == Kind::Choice && !std::holds_alternative<Optional>(p.value) &&
                    valueOf(p, path) == sublist.name();
           });
  }

  /// `path` of the list, with "/" at its end; "" for the root.
  void writeList(const ListSpec& list, const std::string& name, const std::string& path, int depth,
                 bool active) {
    element(depth, "<ParameterList name=\"" + escaped(name) + "\">", active);
    for (const Level level : {Level::Basic, Level::Expert})
      for (const ParameterSpec& parameter : list.parameters())
        if (parameter.level == level && parameter.radius.empty())
          writeParameter(parameter, list.diameterOf(parameter.name), path, depth + 1, active);
    for (const ListSpec& sublist : list.lists()) {
      note(depth + 1, sublist.name() + (sublist.required() ? " (required): " : " (optional): ") +
                          sublist.doc());
      const std::string below = path + sublist.name() + "/";
      writeList(sublist, sublist.name(), below, depth + 1,
                active && (sublist.required() || chosen(list, sublist, path) ||
                           !exampleIn(below).empty()));
    }
    if (list.pattern() != nullptr) {
      note(depth + 1, "any number of lists with names of your own: " + list.pattern()->doc());
      const std::string given = exampleIn(path);
      const bool stands = active && !path.empty() && !given.empty();
      const std::string own =
          stands ? given.substr(path.size(), given.find('/', path.size()) - path.size())
                 : "my " + list.pattern()->name();
      writeList(*list.pattern(), own, path + own + "/", depth + 1, stands);
    }
    element(depth, "</ParameterList>", active);
  }

  /// `diameter`: the parameter that may replace a radius, or null.
  void writeParameter(const ParameterSpec& parameter, const ParameterSpec* diameter,
                      const std::string& path, int depth, bool active) {
    const bool required = std::holds_alternative<Required>(parameter.value);
    const bool stands = required || example(path + parameter.name) != nullptr;
    if (!stands && most_ == Level::Basic && parameter.level == Level::Expert) return;
    std::string words = describe(parameter);
    if (parameter.level == Level::Expert) words += "; for experts";
    if (required) words += "; required";
    if (diameter != nullptr) words += "; or give " + diameter->name;
    if (std::holds_alternative<Optional>(parameter.value)) words += "; optional";
    note(depth, words);
    const std::string value = escaped(valueOf(parameter, path));
    element(depth,
            "<Parameter name=\"" + escaped(parameter.name) + "\" type=\"" +
                typeName(parameter.kind) + "\" value=\"" + value + "\"/>",
            active && stands);
  }

  const Examples& examples_;
  Level most_;
  std::string text_;
};

}  // namespace

std::string templateXml(const ListSpec& root, const std::string& name, const Examples& examples,
                        Level most) {
  return Writer(examples, most).write(root, name);
}

std::string uncommented(const std::string& templateText) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t open = templateText.find(openMark); open != std::string::npos;
       open = templateText.find(openMark, done)) {
    const std::size_t close = templateText.find(closeMark, open);
    const std::size_t element = open + openMark.size() - 1;
    result +=
        templateText.substr(done, open - done) + templateText.substr(element, close + 1 - element);
    done = close + closeMark.size();
  }
  return result + templateText.substr(done);
}

}  // namespace tooljoint::deck
