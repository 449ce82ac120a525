// SPDX-License-Identifier: BSD-3-Clause
// Phase 1: the allowed text of a deck.
#include <gtest/gtest.h>

#include "SmallScene.hpp"

namespace LexicalTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

/// The first line of the message for `contact` in line 3 of an otherwise valid deck.
std::string faultIn(const std::string& contact) { return faultOf(deckWith(contact, endTime)); }

const std::string p = "deck.xml:3: /well/Contact";

struct Lexical {
  std::string contact, message;
  friend std::ostream& operator<<(std::ostream& out, const Lexical& t) { return out << t.contact; }
};
class LexicalFault : public ::testing::TestWithParam<Lexical> {};

TEST_P(LexicalFault, IsReportedWithLineAndPath) {
  EXPECT_EQ(faultIn(GetParam().contact), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Table, LexicalFault,
    ::testing::Values(
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="0.2" units="m"/>)x",
            p + R"x(/Friction has the unknown attribute units="m". Write the unit into the value: type="string" value="... m".)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="0.2" Value="3"/>)x",
            p + R"x(/Friction has the unknown attribute Value="3". Available: "name", "type", "value". Did you mean "value"?)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="0.2" docString="mu"/>)x",
            p + R"x(/Friction has the unknown attribute docString="mu". Available: "name", "type", "value".)x"},
        Lexical{R"x(<ParameterList name="Intervals" type="double"/>)x",
                p + R"x(/Intervals has the unknown attribute type="double". Available: "name".)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="0.2" xml:lang="en"/>)x",
            p + R"x(/Friction has the unknown attribute xml:lang="en". Available: "name", "type", "value".)x"},
        Lexical{R"x(<ParameterList name="Intervals" xmlns="http://x"/>)x",
                p + "/Intervals declares an XML namespace; a deck has none."},
        Lexical{R"x(<Parameter type="double" value="0.2"/>)x",
                p + R"x(: a <Parameter> has no name: write name="...".)x"},
        Lexical{R"x(<Parameter name="" type="double" value="0.2"/>)x",
                p + ": a <Parameter> has an empty name."},
        Lexical{R"x(<ParameterList/>)x",
                p + R"x(: a <ParameterList> has no name: write name="...".)x"},
        Lexical{R"x(<Parameter name=" Friction" type="double" value="0.2"/>)x",
                p + R"x(/ Friction has blanks around its name: write name="Friction".)x"},
        Lexical{R"x(<Parameter name="a/b" type="double" value="0.2"/>)x",
                p + R"x(/a/b has a "/" in its name, which separates lists in a path.)x"},
        Lexical{
            R"x(<Parameter name="Friction" value="0.2"/>)x",
            p + R"x(/Friction has no type: write <Parameter name="..." type="..." value="..."/>.)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double"/>)x",
            p + R"x(/Friction has no value: write <Parameter name="..." type="..." value="..."/>.)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double">0.2</Parameter>)x",
            p +
                "/Friction has no value: write <Parameter name=\"...\" type=\"...\" "
                "value=\"...\"/>.\n" +
                p +
                R"x(/Friction has content; a parameter is one empty element: <Parameter name="..." type="..." value="..."/>.)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="0.2"><Parameter name="x" type="int" value="1"/></Parameter>)x",
            p + R"x(/Friction has content; a parameter is one empty element: <Parameter name="..." type="..." value="..."/>.)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="Double" value="0.2"/>)x",
            p + R"x(/Friction has the unknown type "Double". Available: "double", "int", "bool", "string", "Array(double)", )x" +
                R"x("Array(int)", "Array(string)". Did you mean type="double"?)x"},
        Lexical{R"x(<Parameter name="Friction" type="double" value=""/>)x",
                p + R"x(/Friction: type="double" value="" is empty; a number is expected.)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="12abc"/>)x",
            p + R"x(/Friction: type="double" value="12abc" is not a number: "abc" is left over.)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="double" value="120 rpm"/>)x",
            p + R"x(/Friction: type="double" value="120 rpm" is not a number. A quantity with a unit is written type="string" value="120 rpm".)x"},
        Lexical{R"x(<Parameter name="Friction" type="int" value="3.7"/>)x",
                p + R"x(/Friction: type="int" value="3.7" is not a whole number.)x"},
        Lexical{R"x(<Parameter name="Friction" type="bool" value="TRUE"/>)x",
                p + R"x(/Friction: type="bool" value="TRUE" is not a bool: write "true".)x"},
        Lexical{
            R"x(<Parameter name="Friction" type="Array(double)" value="{1, x}"/>)x",
            p + R"x(/Friction: type="Array(double)" value="{1, x}" has the entry "x" (number 2), which is not a number.)x"},
        Lexical{R"x(<Paramter name="Friction" type="double" value="0.2"/>)x",
                p + " holds a <Paramter>. Available: <Parameter .../> and <ParameterList ...>. Did "
                    "you mean <Parameter>?"},
        Lexical{
            R"x(<parameterlist name="Intervals"/>)x",
            p + " holds a <parameterlist>. Available: <Parameter .../> and <ParameterList ...>. "
                "Did you mean <ParameterList>?"},
        Lexical{"<Validators/>",
                p + " holds a <Validators>. Available: <Parameter .../> and <ParameterList ...>."},
        Lexical{R"x(<xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="other.xml"/>)x",
                p + " holds a <xi:include>. Available: <Parameter .../> and <ParameterList ...>."},
        Lexical{"0.2",
                "deck.xml:3: /well/Contact holds the stray text \"0.2\"; a list holds <Parameter/> "
                "and <ParameterList> only."},
        Lexical{"<![CDATA[0.2]]>",
                "deck.xml:3: /well/Contact holds the stray text \"0.2\"; a list holds <Parameter/> "
                "and <ParameterList> only."}));

TEST(Lexical, AParameterGivenTwiceNamesBothLines) {
  EXPECT_EQ(faultIn(parameter("Friction", "double", "0.2") + "\n" +
                    parameter("Friction", "double", "0.3")),
            "deck.xml:4: /well/Contact/Friction is given twice; the first one is in line 3.");
}

TEST(Lexical, AListGivenTwiceNamesBothLines) {
  EXPECT_EQ(faultIn("<ParameterList name=\"Intervals\"/>\n\n<ParameterList name=\"Intervals\"/>"),
            "deck.xml:5: /well/Contact/Intervals is given twice; the first one is in line 3.");
}

TEST(Lexical, AParameterAndAListCannotShareAName) {
  EXPECT_EQ(
      faultIn(parameter("Friction", "double", "0.2") + "\n<ParameterList name=\"Friction\"/>"),
      "deck.xml:4: /well/Contact/Friction is given twice; the first one is in line 3.");
}

TEST(Lexical, AllFaultsComeTogetherSortedByLine) {
  const std::string fault = faultOf(
      deckWith(parameter("Stiffness", "double", "1,5") + "\n" + parameter("Friction", "float", "1"),
               parameter("End Time", "double", "20 s") + "\n<Parameter/>"));
  const std::vector<std::string> starts = {
      "deck.xml:3: /well/Contact/Stiffness: ",
      "deck.xml:4: /well/Contact/Friction has the unknown type",
      "deck.xml:7: /well/Transient/End Time: ",
      "deck.xml:8: /well/Transient: a <Parameter> has no name",
      "deck.xml:8: /well/Transient: a <Parameter> has no type",
      "deck.xml:8: /well/Transient: a <Parameter> has no value"};
  std::size_t at = 0;
  for (const std::string& start : starts) {
    EXPECT_EQ(fault.compare(at, start.size(), start), 0) << fault.substr(at);
    at = fault.find('\n', at) + 1;
  }
  EXPECT_EQ(at, 0U) << "more lines than expected: " << fault.substr(at);
}

TEST(Lexical, NamesAreNotJudgedBeforeTheTextIsInOrder) {
  const std::string fault =
      faultIn(parameter("Friction", "double", "abc") + "\n" + parameter("Nonsense", "double", "1"));
  EXPECT_EQ(fault,
            "deck.xml:3: /well/Contact/Friction: type=\"double\" value=\"abc\" is not a number.");
}

TEST(Lexical, PassThroughListsAreCheckedToo) {
  const std::string list = "<ParameterList name=\"NOX\"><ParameterList name=\"Line Search\">" +
                           parameter("Tolerance", "double", "1e-x") +
                           "</ParameterList></ParameterList>";
  EXPECT_EQ(faultOf(deckWith(stiffness, endTime + list)),
            "deck.xml:6: /well/Transient/NOX/Line Search/Tolerance: type=\"double\" value=\"1e-x\" "
            "is not a number: \"e-x\" is "
            "left over.");
}

TEST(Lexical, CommentsBlanksAndProcessingInstructionsMeanNothing) {
  EXPECT_EQ(faultOf("<?xml version=\"1.0\"?>\n<!-- a -->\n" +
                    deckWith("<!-- b --><?editor x?>\n" + stiffness, "\t" + endTime + " ") +
                    "<!-- c -->"),
            "");
}

TEST(Lexical, AManyFaultedDeckShowsAHundred) {
  std::string many;
  for (int i = 0; i < 150; ++i) many += parameter("N" + std::to_string(i), "double", "x") + "\n";
  const std::string fault = faultIn(many);
  EXPECT_EQ(std::count(fault.begin(), fault.end(), '\n'), 100);
  EXPECT_NE(fault.find("deck.xml: 50 more errors follow."), std::string::npos);
}

struct Whole {
  std::string text, message;
  friend std::ostream& operator<<(std::ostream& out, const Whole& t) { return out << t.text; }
};
class WholeFile : public ::testing::TestWithParam<Whole> {};

TEST_P(WholeFile, ThatIsNoDeckIsRefused) {
  const std::string fault = faultOf(GetParam().text);
  EXPECT_EQ(fault.substr(0, GetParam().message.size()), GetParam().message) << fault;
}

INSTANTIATE_TEST_SUITE_P(
    Table, WholeFile,
    ::testing::Values(
        Whole{"", "deck.xml: the file is empty; a deck is one <ParameterList name=\"...\">."},
        Whole{" \n\t ", "deck.xml: the file is empty; a deck is one <ParameterList name=\"...\">."},
        Whole{std::string("\x7f"
                          "ELF\0\0",
                          6),
              "deck.xml: is a binary file, not an XML text in UTF-8."},
        Whole{"\xff\xfe<", "deck.xml:1: not well-formed XML: "},
        Whole{"key: value", "deck.xml:1: not well-formed XML: Start tag expected, '<' not found."},
        Whole{"<?xml version=\"1.0\"?>", "deck.xml:1: not well-formed XML: "},
        Whole{"<!-- only a comment -->", "deck.xml:1: not well-formed XML: "},
        Whole{"<Deck name=\"x\"/>",
              "deck.xml:1: the outermost element is <Deck>; a deck is one <ParameterList "
              "name=\"...\">."},
        Whole{"<Parameter name=\"x\" type=\"int\" value=\"1\"/>",
              "deck.xml:1: the outermost element is <Parameter>;"},
        Whole{"<ParameterList/>",
              "deck.xml:1: the outermost <ParameterList> has no name: write name=\"...\"."},
        Whole{"<ParameterList name=\"x\">\n<Parameter name=\"a\"\n",
              "deck.xml:3: not well-formed XML: "},
        Whole{"<ParameterList name=\"x\">\n</ParameterLst>",
              "deck.xml:2: not well-formed XML: Opening and ending tag mismatch: ParameterList "
              "line 1 and ParameterLst."},
        Whole{"<ParameterList name=\"x\" name=\"y\"/>",
              "deck.xml:1: not well-formed XML: Attribute name redefined."},
        Whole{"<ParameterList name=x/>",
              "deck.xml:1: not well-formed XML: AttValue: \" or ' expected."},
        Whole{"<ParameterList name=\"x\"/><ParameterList name=\"y\"/>",
              "deck.xml:1: not well-formed XML: Extra content at the end of the document."},
        Whole{"<ParameterList name=\"&unknown;\"/>",
              "deck.xml:1: not well-formed XML: Entity 'unknown' not defined."},
        Whole{"<ParameterList name=\"x\"><a:b/></ParameterList>",
              "deck.xml:1: not well-formed XML: Namespace prefix a on b is not defined."},
        Whole{"<ParameterList name=\"a < b\"/>",
              "deck.xml:1: not well-formed XML: Unescaped '<' not allowed in attributes values."},
        Whole{"<ParameterList name=\"\xe9\"/>",
              "deck.xml:1: not well-formed XML: Input is not proper UTF-8, indicate encoding !"},
        Whole{"<!DOCTYPE ParameterList SYSTEM \"http://example.invalid/deck.dtd\">\n<ParameterList "
              "name=\"x\"/>",
              "deck.xml:1: a deck has no document type definition and no entities: remove "
              "<!DOCTYPE ...>."},
        Whole{"<?xml version=\"1.0\"?>\n<!DOCTYPE x [<!ENTITY file SYSTEM "
              "\"file:///etc/passwd\">]>\n<ParameterList "
              "name=\"&file;\"/>",
              "deck.xml:2: a deck has no document type definition and no entities"}));

TEST(WholeFile, ABillionLaughsAreNotHeard) {
  std::string text = "<?xml version=\"1.0\"?>\n<!DOCTYPE x [\n<!ENTITY a0 \"ha\">\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    text += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) text += before;
    text += "\">\n";
  }
  text += "]>\n<ParameterList name=\"&a29;\"/>\n";
  EXPECT_EQ(
      faultOf(text),
      "deck.xml:2: a deck has no document type definition and no entities: remove <!DOCTYPE ...>.");
}

TEST(WholeFile, DeepNestingIsRefusedNotFollowed) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "<ParameterList name=\"a\">";
  EXPECT_EQ(faultOf(text).substr(0, 33), "deck.xml:1: not well-formed XML: ");
}

TEST(WholeFile, ManyParametersAreReadInLinearTime) {
  std::string text = "<ParameterList name=\"x\">\n<ParameterList name=\"NOX\">\n";
  for (int i = 0; i < 50000; ++i) text += parameter("N" + std::to_string(i), "int", "1") + "\n";
  text += "</ParameterList>\n</ParameterList>\n";
  const Deck deck = Deck::parse(text, "deck.xml", ListSpec("s", "S.").passThrough("NOX", "N."));
  EXPECT_EQ(deck.list().sublist("NOX").numParams(), 50000);
  EXPECT_EQ(deck.where("NOX/N49999"), "deck.xml:50002: /x/NOX/N49999");
}

TEST(WholeFile, LineNumbersGoBeyondSixteenBits) {
  const std::string text = "<ParameterList name=\"x\">" + std::string(70000, '\n') +
                           parameter("A", "double", "x") +
                           "\n<ParameterList name=\"b\"/>\n</ParameterList>";
  EXPECT_EQ(messageOf([&] { Deck::parse(text, "deck.xml", ListSpec("s", "S.")); }),
            "deck.xml:70001: /x/A: type=\"double\" value=\"x\" is not a number.");
}

TEST(WholeFile, ATagOfSeveralLinesIsReportedWhereItBegins) {
  const std::string text =
      "<ParameterList\n  name=\"x\"\n>\n<Parameter\n  name=\"A\"\n  type=\"double\"\n  "
      "value=\"x\"\n/>\n</ParameterList>";
  EXPECT_EQ(messageOf([&] { Deck::parse(text, "deck.xml", ListSpec("s", "S.")); }),
            "deck.xml:4: /x/A: type=\"double\" value=\"x\" is not a number.");
}

TEST(WholeFile, TooLargeATextIsRefused) {
  const std::string text = "<ParameterList name=\"x\"/>" + std::string(64UL * 1024UL * 1024UL, ' ');
  EXPECT_EQ(faultOf(text), "deck.xml: is larger than 64 MB, which cannot be a deck.");
}

TEST(WholeFile, PlainCharacterReferencesAreFine) {
  const Deck deck = parseSmall(
      "<ParameterList name=\"x\">" + parameter("Title", "string", "a &lt; b &amp; &#x63;") +
      "<ParameterList name=\"Transient\">" + endTime + "</ParameterList></ParameterList>");
  EXPECT_EQ(deck.list().get<std::string>("Title"), "a < b & c");
}

}  // namespace LexicalTest
