// SPDX-License-Identifier: BSD-3-Clause
#include "texts/ManualPages.hpp"

#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"

namespace tooljoint::texts {

namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

bool takesValue(const CLI::Option& option) { return option.get_expected_max() > 0; }

/// "-o", "--output"; none of a positional.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// Values that are all there are, of a type name such as "TEXT:{man,bash}"; empty for free ones.
std::vector<std::string> choicesOf(const CLI::Option& option) {
  const auto type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return split(type.substr(open + 1, close - open - 1), ',');
}

/// What stands for a value in a synopsis: "DIR", "man|bash".
std::string valueOf(const CLI::Option& option) {
  const auto choices = choicesOf(option);
  const auto type = option.get_type_name();  // "INT:POSITIVE" with its check
  return choices.empty() ? type.substr(0, type.find(':')) : join(choices, "|");
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

// ---- manual pages

/// Text of a manual page: a backslash or a hyphen of its own, and no request at a line's begin.
std::string roff(const std::string& text) {
  std::string safe = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  return !safe.empty() && (safe.front() == '.' || safe.front() == '\'') ? "\\&" + safe : safe;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string entry(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : spellings(option)) names.push_back(bold(name));
  std::string head = option.get_positional() ? italic(option.get_name(true)) : join(names, ", ");
  if (!option.get_positional() && takesValue(option)) head += " " + italic(valueOf(option));
  return ".TP\n" + head + "\n" + roff(option.get_description()) + "\n";
}

/// "tooljoint run [OPTION]... DECK"
std::string synopsis(const CLI::App& command) {
  std::string text = bold("tooljoint " + command.get_name()) + " [" + italic("OPTION") + "]...";
  for (const auto* option : command.get_options())
    if (option->get_positional())
      text += option->get_required() ? " " + italic(option->get_name(true))
                                     : " [" + italic(option->get_name(true)) + "]";
  return text + "\n";
}

std::string options(const CLI::App& command) {
  std::string text;
  for (const bool positional : {true, false})
    for (const auto* option : command.get_options())
      if (option->get_positional() == positional) text += entry(*option);
  return text;
}

std::string heading(const std::string& name, const std::string& doc) {
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return ".\\\" Written by tooljoint doc --format man.\n.TH " + upper + " 1 \"\" \"Tooljoint " +
         programVersion() + "\" \"User Commands\"\n.SH NAME\n" + roff(name) + " \\- " + roff(doc) +
         "\n.SH SYNOPSIS\n";
}

constexpr const char* ends =
    ".SH EXIT STATUS\n"
    ".TP\n0\ndone\n"
    ".TP\n1\nwrong usage of the command line\n"
    ".TP\n2\nthe deck is invalid\n"
    ".TP\n3\nthe model cannot be built\n"
    ".TP\n4\nno convergence, or an error above a bound\n"
    ".TP\n5\na file cannot be read or written\n"
    ".TP\n70\ninternal error\n"
    ".TP\n130\ninterrupted; \\fBrun \\-\\-restart\\fR goes on\n";

constexpr const char* surroundings =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBTOOLJOINT_REPORT\\fR\n\\fIoff\\fR: runs and analyses write no report.html.\n"
    ".SH FILES\n"
    ".TP\n\\fIresults/DECK\\fR\nResults of a run, unless another folder is given: results.h5, "
    "summary.json, tables, report.html.\n";

std::string commandPage(const CLI::App& command) {
  return heading("tooljoint-" + command.get_name(), command.get_description()) + synopsis(command) +
         ".SH OPTIONS\n" + options(command) + ends + ".SH SEE ALSO\n.BR tooljoint (1)\n";
}

/// What a program is, of its description "Name: what it is."
std::string whatItIs(const CLI::App& program) {
  const std::string text = program.get_description();
  const auto begin = text.find(": ") + 2;
  return text.substr(begin, text.rfind('.') - begin);
}

std::string programPage(const CLI::App& program) {
  std::string text =
      heading("tooljoint", whatItIs(program)) + bold("tooljoint") + " " + italic("COMMAND") + " [" +
      italic("OPTION") + "]...\n.br\n.B mpirun \\-np\n" + italic("N") + "\n" + bold("tooljoint") +
      " " + italic("COMMAND") + " [" + italic("OPTION") + "]...\n" + ".SH DESCRIPTION\n" +
      roff(program.get_description()) +
      "\nEvery command but doc, new, template, report, paraview and compare reads a deck, a "
      "file of lists and parameters.\n" +
      bold("tooljoint new") + " writes one that runs, " + bold("tooljoint doc") +
      " prints what a deck may hold.\n.SH OPTIONS\n" + options(program) + ".SH COMMANDS\n";
  for (const auto* command : commandsOf(program))
    text +=
        ".SS " + synopsis(*command) + roff(command->get_description()) + "\n" + options(*command);
  text += std::string(ends) + surroundings + ".SH SEE ALSO\n";
  std::vector<std::string> pages;
  for (const auto* command : commandsOf(program))
    pages.push_back(".BR " + roff("tooljoint-" + command->get_name()) + " (1)");
  return text + join(pages, ",\n") + "\n";
}

std::string manPage(const CLI::App& program, const std::string& name) {
  if (name.empty()) return programPage(program);
  std::vector<std::string> names;
  for (const auto* command : commandsOf(program)) {
    if (command->get_name() == name) return commandPage(*command);
    names.push_back(command->get_name());
  }
  throw UsageError("There is no command " + inQuotes(name) + ". Available: " + quotedList(names) +
                   ".");
}

// ---- completions

std::string commandWords(const CLI::App& program) {
  std::vector<std::string> names;
  for (const auto* command : commandsOf(program)) names.push_back(command->get_name());
  return join(names, " ");
}

std::string optionWords(const CLI::App& command) {
  std::vector<std::string> words;
  for (const auto* option : command.get_options())
    for (const auto& name : spellings(*option)) words.push_back(name);
  return join(words, " ");
}

/// The words of compgen for a value; "" for one that nobody can complete.
std::string compgen(const CLI::Option& option) {
  const auto choices = choicesOf(option);
  if (!choices.empty()) return "-W '" + join(choices, " ") + "'";
  if (option.get_type_name() == "FILE") return "-f";
  if (option.get_type_name() == "DIR") return "-d";
  return "";
}

std::string bashCase(const CLI::App& command) {
  const std::string& name = command.get_name();
  std::string values, words;
  for (const auto* option : command.get_options()) {
    const auto offered = compgen(*option);
    if (option->get_positional()) {
      if (!offered.empty()) words = offered;
      continue;
    }
    if (!takesValue(*option)) continue;
    values +=
        "        " + join(spellings(*option), "|") + ") " +
        (offered.empty() ? "COMPREPLY=()" : "COMPREPLY=($(compgen " + offered + " -- \"$cur\"))") +
        "; return ;;\n";
  }
  return "    " + name + ")\n" +
         (values.empty() ? "" : "      case \"$prev\" in\n" + values + "      esac\n") +
         "      options='" + optionWords(command) + "'\n" +
         (words.empty() ? "" : "      words=\"" + words + "\"\n") + "      ;;\n";
}

std::string bashCompletion(const CLI::App& program) {
  std::string text =
      "# bash completion of tooljoint; written by tooljoint doc --format bash\n"
      "_tooljoint() {\n"
      "  local cur=\"${COMP_WORDS[COMP_CWORD]}\" prev=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
      "  local command=\"${COMP_WORDS[1]}\" options words=''\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '" +
      commandWords(program) + " " + optionWords(program) +
      "' -- \"$cur\"))\n    return\n  fi\n  case \"$command\" in\n";
  for (const auto* command : commandsOf(program)) text += bashCase(*command);
  return text +
         "    *) COMPREPLY=(); return ;;\n"
         "  esac\n"
         "  case \"$cur\" in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$cur\")) ;;\n"
         "    *) COMPREPLY=(); [ -n \"$words\" ] && eval \"COMPREPLY=(\\$(compgen $words -- "
         "\\\"\\$cur\\\"))\" ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _tooljoint tooljoint\n";
}

/// Text inside the brackets of a specification of zsh, in single quotes.
std::string zshText(const std::string& text) {
  std::string safe = replaced(text, "'", "'\\''");
  for (const char* mark : {"[", "]", ":"}) safe = replaced(safe, mark, std::string("\\") + mark);
  return safe;
}

std::string zshAction(const CLI::Option& option) {
  const auto choices = choicesOf(option);
  if (!choices.empty()) return "(" + join(choices, " ") + ")";
  if (option.get_type_name() == "FILE") return "_files";
  return option.get_type_name() == "DIR" ? "_files -/" : " ";
}

std::string zshSpecification(const CLI::Option& option, int position) {
  if (option.get_positional())
    return "'" + std::to_string(position) + (option.get_required() ? ":" : "::") +
           zshText(option.get_name(true)) + ":" + zshAction(option) + "'";
  const auto names = spellings(option);
  const std::string value =
      takesValue(option) ? ":" + zshText(valueOf(option)) + ":" + zshAction(option) : "";
  const std::string doc = "[" + zshText(option.get_description()) + "]" + value + "'";
  std::vector<std::string> all;
  for (const auto& name : names) all.push_back("'*" + name + doc);
  return join(all, " ");
}

std::string zshArguments(const CLI::App& command) {
  std::string text = "_arguments";
  int position = 0;
  for (const auto* option : command.get_options()) {
    position += option->get_positional() ? 1 : 0;
    text += " \\\n        " + zshSpecification(*option, position);
  }
  return text + "\n";
}

std::string zshCompletion(const CLI::App& program) {
  std::string text =
      "#compdef tooljoint\n# written by tooljoint doc --format zsh\n_tooljoint() {\n"
      "  local -a commands\n  commands=(\n";
  for (const auto* command : commandsOf(program))
    text += "    '" + command->get_name() + ":" + zshText(command->get_description()) + "'\n";
  text += "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    " +
          zshArguments(program) +
          "    return\n  fi\n  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n"
          "  case $command in\n";
  for (const auto* command : commandsOf(program))
    text += "    " + command->get_name() + ")\n      " + zshArguments(*command) + "      ;;\n";
  return text + "  esac\n}\n_tooljoint \"$@\"\n";
}

}  // namespace

std::string page(const CLI::App& program, const std::string& command, const std::string& format) {
  if (format == "man") return manPage(program, command);
  if (!command.empty())
    throw UsageError("The completion for " + format + " covers all commands. Leave " +
                     inQuotes(command) + " out.");
  return format == "bash" ? bashCompletion(program) : zshCompletion(program);
}

}  // namespace tooljoint::texts
