// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/XmlReader.hpp"

#include <algorithm>
#include <cstdint>
#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/tree.h>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

/// Reports of the parser; attached to the parser context.
struct ParserNews {
  bool documentType = false;
  int line = 0;
  std::string fault;
};

void onDocumentType(void* context, const xmlChar* /*name*/, const xmlChar* /*externalId*/,
                    const xmlChar* /*systemId*/) {
  auto* parser = static_cast<xmlParserCtxtPtr>(context);
  auto* news = static_cast<ParserNews*>(parser->_private);
  news->documentType = true;
  news->line = parser->input != nullptr ? parser->input->line : 0;
  xmlStopParser(parser);
}

void onError(void* context, xmlErrorPtr error) {
  auto* parser = static_cast<xmlParserCtxtPtr>(context);
  auto* news = parser == nullptr ? nullptr : static_cast<ParserNews*>(parser->_private);
  if (news == nullptr || error->level < XML_ERR_ERROR || !news->fault.empty()) return;
  news->line = error->line;
  news->fault = trim(error->message != nullptr ? error->message : "unknown fault");
}

/// Builds the element as libxml2 does and stores the line of its "<" (libxml2 itself counts up to
/// 65535, and to the end of a tag).
void onElement(void* context, const xmlChar* name, const xmlChar* prefix, const xmlChar* uri,
               int namespaceCount, const xmlChar** namespaces, int attributeCount,
               int defaultedCount, const xmlChar** attributes) {
  xmlSAX2StartElementNs(context, name, prefix, uri, namespaceCount, namespaces, attributeCount,
                        defaultedCount, attributes);
  auto* parser = static_cast<xmlParserCtxtPtr>(context);
  if (parser->node == nullptr || parser->input == nullptr) return;
  std::intptr_t line = parser->input->line;
  for (const xmlChar* at = parser->input->cur; at > parser->input->base && *at != '<';) {
    --at;
    if (*at == '\n') --line;
  }
  parser->node->_private = reinterpret_cast<void*>(line);
}

struct DocumentDeleter {
  void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};
struct ParserDeleter {
  void operator()(xmlParserCtxt* parser) const { xmlFreeParserCtxt(parser); }
};
using Document = std::unique_ptr<xmlDoc, DocumentDeleter>;

std::string asText(const xmlChar* text) {
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

/// Largest length of a name, so that messages can contain it completely, with the names of its
/// lists.
constexpr std::size_t longestName = longestQuote;
/// Largest number of attributes of an element. libxml2 compares every attribute of an element with
/// every other one.
constexpr int mostAttributes = 100;

/// Readable text for an error message: shortened to the length of a line.
std::string shortened(const std::string& text) { return excerpt(trim(text), 60); }

int lineOf(const xmlNode* node) {
  if (node->type == XML_ELEMENT_NODE)
    return static_cast<int>(reinterpret_cast<std::intptr_t>(node->_private));
  // libxml2 gives the line in which a text ends.
  const std::string text = asText(node->content);
  const auto first = text.find_first_not_of(" \t\r\n");
  const auto after =
      first == std::string::npos
          ? 0
          : std::count(text.begin() + static_cast<std::ptrdiff_t>(first), text.end(), '\n');
  return static_cast<int>(xmlGetLineNo(const_cast<xmlNode*>(node)) - after);
}

Document parseDocument(const std::string& text, const std::string& file) {
  xmlInitParser();
  const std::unique_ptr<xmlParserCtxt, ParserDeleter> parser(xmlNewParserCtxt());
  if (!parser) throw Error(ExitCode::Internal, "The XML parser could not be started.");
  ParserNews news;
  parser->_private = &news;
  parser->sax->internalSubset = onDocumentType;
  parser->sax->serror = onError;
  parser->sax->startElementNs = onElement;
  constexpr int options =
      XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_BIG_LINES;
  Document document(xmlCtxtReadMemory(parser.get(), text.data(), static_cast<int>(text.size()),
                                      nullptr, nullptr, options));
  if (news.documentType) {
    throw DeckError(
        file + ":" + std::to_string(news.line) +
        ": a deck has no document type definition and no entities: remove <!DOCTYPE ...>.");
  }
  if (!document || !news.fault.empty()) {
    const std::string fault = news.fault.empty() ? "the text is no XML" : news.fault;
    throw DeckError(file + ":" + std::to_string(std::max(1, news.line)) +
                    ": not well-formed XML: " + fault + ".");
  }
  return document;
}

/// Line of the first element with more than mostAttributes attributes; 0 if there is none. Uses
/// only the text; faults of its syntax are reported by the parser.
int lineOfCrowdedElement(const std::string& text) {
  int line = 1, attributes = 0;
  char quote = 0;
  bool inTag = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (!inTag) {
      if (c != '<') continue;
      const bool comment = text.compare(i, 4, "<!--") == 0,
                 data = text.compare(i, 9, "<![CDATA[") == 0;
      if (comment || data) {
        const auto end = std::min(text.find(comment ? "-->" : "]]>", i), text.size());
        line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                            text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        i = end;
      } else {
        inTag = true;
        attributes = 0;
      }
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      inTag = false;
    } else if (c == '=' && ++attributes > mostAttributes) {
      return line;
    }
  }
  return 0;
}

/// Visits the elements of a deck and collects their faults.
class TreeReader {
 public:
  explicit TreeReader(std::string file) : file_(std::move(file)) {}

  RawList readRoot(const xmlNode* root) {
    RawList scene;
    if (tagOf(root) != "ParameterList") {
      add(root, "the outermost element is <" + tagOf(root) +
                    ">; a deck is one <ParameterList name=\"...\">.");
    } else {
      scene = readList(root, "");
    }
    raise(std::move(findings_), file_);
    return scene;
  }

 private:
  using Attributes = std::map<std::string, std::string>;

  void add(const xmlNode* node, const std::string& text) {
    findings_.push_back({Place{lineOf(node), 0, ""}, text});
  }

  static std::string tagOf(const xmlNode* node) {
    std::string name = asText(node->name);
    if (node->ns == nullptr || node->ns->prefix == nullptr) return name;
    return asText(node->ns->prefix) + ":" + name;
  }

  /// The attributes of an element; those not in `known` are faults.
  Attributes readAttributes(const xmlNode* node, const std::vector<std::string>& known,
                            const std::string& subject) {
    Attributes result;
    for (const xmlAttr* attribute = node->properties; attribute != nullptr;
         attribute = attribute->next) {
      std::string name = asText(attribute->name);
      if (attribute->ns != nullptr) name = asText(attribute->ns->prefix) + ":" + name;
      xmlChar* content = xmlNodeListGetString(node->doc, attribute->children, 1);
      const std::string value = asText(content);
      xmlFree(content);
      if (std::find(known.begin(), known.end(), name) != known.end()) {
        result.emplace(name, value);
      } else {
        add(node, subject + " has the unknown attribute " + shortened(name) + "=" +
                      inQuotes(shortened(value)) + ". " + attributeAdvice(name, value, known));
      }
    }
    for (const xmlNs* space = node->nsDef; space != nullptr; space = space->next) {
      add(node, subject + " declares an XML namespace; a deck has none.");
    }
    return result;
  }

  static std::string attributeAdvice(const std::string& name, const std::string& value,
                                     const std::vector<std::string>& known) {
    const std::string small = lower(name);
    if (small == "unit" || small == "units") {
      return "Write the unit into the value: type=\"string\" value=\"... " + shortened(value) +
             "\".";
    }
    const std::string near = closest(name, known);
    return "Available: " + quotedList(known) + "." +
           (near.empty() ? "" : " Did you mean " + inQuotes(near) + "?");
  }

  /// Name of an element in messages, before and after its name is known.
  static std::string subjectOf(const xmlNode* node, const std::string& path) {
    xmlChar* content =
        xmlGetNoNsProp(const_cast<xmlNode*>(node), reinterpret_cast<const xmlChar*>("name"));
    const std::string name = asText(content);
    xmlFree(content);
    if (!name.empty()) return path + "/" + excerpt(name);
    return (path.empty() ? std::string("the outermost") : path + ": a") + " <" + tagOf(node) + ">";
  }

  bool hasGoodName(const xmlNode* node, const Attributes& attributes, const std::string& subject) {
    const auto it = attributes.find("name");
    if (it == attributes.end()) {
      add(node, subject + " has no name: write name=\"...\".");
    } else if (it->second.empty()) {
      add(node, subject + " has an empty name.");
    } else if (trim(it->second) != it->second) {
      add(node,
          subject + " has blanks around its name: write name=" + inQuotes(trim(it->second)) + ".");
    } else if (it->second.size() > longestName) {
      add(node, subject + " has a name of " + std::to_string(it->second.size()) +
                    " characters; the longest one has " + std::to_string(longestName) + ".");
    } else if (it->second.find('/') != std::string::npos) {
      add(node, subject + " has a \"/\" in its name, which separates lists in a path.");
    } else {
      return true;
    }
    return false;
  }

  RawList readList(const xmlNode* node, const std::string& parent) {
    const std::string subject = subjectOf(node, parent);
    const Attributes attributes = readAttributes(node, {"name"}, subject);
    RawList list;
    list.place.line = lineOf(node);
    if (hasGoodName(node, attributes, subject)) list.name = attributes.at("name");
    const std::string path = parent + "/" + (list.name.empty() ? "?" : list.name);
    for (const xmlNode* child = node->children; child != nullptr; child = child->next)
      readChild(child, path, list);
    return list;
  }

  void readChild(const xmlNode* child, const std::string& path, RawList& list) {
    if (child->type == XML_TEXT_NODE || child->type == XML_CDATA_SECTION_NODE) {
      const std::string text = shortened(asText(child->content));
      if (!text.empty())
        add(child, path + " holds the stray text " + inQuotes(text) +
                       "; a list holds <Parameter/> and <ParameterList> only.");
    } else if (child->type == XML_ELEMENT_NODE) {
      readElement(child, path, list);
    } else if (child->type != XML_COMMENT_NODE && child->type != XML_PI_NODE) {
      add(child, path + " holds something that is neither an element nor a comment.");
    }
  }

  void readElement(const xmlNode* child, const std::string& path, RawList& list) {
    const std::string tag = tagOf(child);
    if (tag == "ParameterList") {
      RawList sublist = readList(child, path);
      if (!sublist.name.empty() && isFirst(child, path, sublist.name, list))
        list.add(std::move(sublist));
    } else if (tag == "Parameter") {
      readParameter(child, path, list);
    } else {
      const std::string near = closest(tag, {"Parameter", "ParameterList"});
      add(child, path + " holds a <" + tag +
                     ">. Available: <Parameter .../> and <ParameterList ...>." +
                     (near.empty() ? "" : " Did you mean <" + near + ">?"));
    }
  }

  bool isFirst(const xmlNode* node, const std::string& path, const std::string& name,
               RawList& list) {
    const RawParameter* parameter = list.findParameter(name);
    const RawList* sublist = list.findList(name);
    if (parameter == nullptr && sublist == nullptr) return true;
    const int line = parameter != nullptr ? parameter->place.line : sublist->place.line;
    add(node, path + "/" + name + " is given twice; the first one is in line " +
                  std::to_string(line) + ".");
    return false;
  }

  void readParameter(const xmlNode* node, const std::string& path, RawList& list) {
    const std::string subject = subjectOf(node, path);
    const Attributes attributes = readAttributes(node, {"name", "type", "value"}, subject);
    bool complete = hasGoodName(node, attributes, subject);
    for (const char* wanted : {"type", "value"}) {
      if (attributes.count(wanted) == 0) {
        add(node, subject + " has no " + wanted +
                      ": write <Parameter name=\"...\" type=\"...\" value=\"...\"/>.");
        complete = false;
      }
    }
    for (const xmlNode* child = node->children; child != nullptr; child = child->next) {
      const bool comment = child->type == XML_COMMENT_NODE;
      if (comment || (child->type == XML_TEXT_NODE && trim(asText(child->content)).empty()))
        continue;
      add(node, subject +
                    " has content; a parameter is one empty element: <Parameter name=\"...\" "
                    "type=\"...\" value=\"...\"/>.");
      break;
    }
    if (attributes.count("type") == 0 || attributes.count("value") == 0) return;
    RawParameter parameter;
    parameter.type = attributes.at("type");
    parameter.text = attributes.at("value");
    parameter.place.line = lineOf(node);
    std::string fault;
    const std::optional<Value> value = parseValue(parameter.type, parameter.text, fault);
    if (!value) {
      const bool knownType =
          std::find(typeNames().begin(), typeNames().end(), parameter.type) != typeNames().end();
      const std::string what = knownType ? "type=" + inQuotes(parameter.type) +
                                               " value=" + inQuotes(shortened(parameter.text)) + " "
                                         : "";
      add(node,
          subject + (knownType ? ": " : " ") + what + fault + (fault.back() == '?' ? "" : "."));
    }
    if (!complete || !isFirst(node, path, attributes.at("name"), list)) return;
    parameter.name = attributes.at("name");
    if (value) parameter.value = *value;
    list.add(std::move(parameter));
  }

  std::string file_;
  std::vector<Finding> findings_;
};

}  // namespace

void raise(std::vector<Finding> findings, const std::string& file) {
  if (findings.empty()) return;
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.place.before(b.place); });
  constexpr std::size_t most = 100;
  std::vector<std::string> lines;
  for (const Finding& one : findings) lines.push_back(one.place.text(file) + ": " + one.text);
  throw DeckError(firstLines(std::move(lines), most, file));
}

std::string readTextFile(const std::string& file) {
  InputFile input(file);
  if (input.size() > largestDeck)
    throw DeckError(file + ": is larger than 64 MB, which cannot be a deck.");
  return input.all(largestDeck);
}

RawList readXml(const std::string& text, const std::string& file) {
  if (text.size() > largestDeck)
    throw DeckError(file + ": is larger than 64 MB, which cannot be a deck.");
  if (trim(text).empty())
    throw DeckError(file + ": the file is empty; a deck is one <ParameterList name=\"...\">.");
  if (text.find('\0') != std::string::npos)
    throw DeckError(file + ": is a binary file, not an XML text in UTF-8.");
  if (const int line = lineOfCrowdedElement(text); line > 0)
    throw DeckError(file + ":" + std::to_string(line) + ": an element has more than " +
                    std::to_string(mostAttributes) +
                    " attributes; a parameter has three: name, type and value.");
  const Document document = parseDocument(text, file);
  const xmlNode* root = xmlDocGetRootElement(document.get());
  if (root == nullptr)
    throw DeckError(file +
                    ": the file holds no element; a deck is one <ParameterList name=\"...\">.");
  return TreeReader(file).readRoot(root);
}

}  // namespace tooljoint::deck
