// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "app/commands/Command.hpp"
#include "deck/Manual.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "texts/ManualPages.hpp"

namespace tooljoint::app {

namespace {

/// The parameter manual (format "md" or "json"), or one topic of it.
std::string manual(const std::string& topic, const std::string& format) {
  const std::vector<deck::ListSpec> roots{drillstring::sceneSpec(),
                                          drillstring::libraryParameters()};
  if (deck::isUnitsTopic(topic))
    return format == "json" ? deck::unitsJson() : deck::unitsMarkdown();
  if (format == "json") return deck::manualJson(roots, topic) + "\n";
  if (!topic.empty()) return deck::manualMarkdown(roots, topic);
  return "# Parameters of a deck\n\nWritten by `tooljoint doc`; every parameter a deck may hold, "
         "and the component libraries it may name.\n\n" +
         deck::manualMarkdown(roots) + "\n" + deck::unitsMarkdown();
}

Action prepareDoc(CLI::App& line) {
  struct Options {
    std::string topic;
    std::string format = "md";
  };
  auto options = std::make_shared<Options>();
  line.add_option("TOPIC", options->topic,
                  "a list of the deck, e.g. Contact, or units; of man a command");
  line.add_option("--format", options->format,
                  "md or json: parameters; man: manual page; bash or zsh: completion function")
      ->check(CLI::IsMember({"md", "json", "man", "bash", "zsh"}));
  return [options, program = line.get_parent()] {
    print(std::cout, texts::isPageFormat(options->format)
                         ? texts::page(*program, options->topic, options->format)
                         : manual(options->topic, options->format));
  };
}

const bool docRegistered =
    addCommand({Group::Begin, "doc",
                "print the parameter manual, or what describes the command line", prepareDoc});

}  // namespace

}  // namespace tooljoint::app
