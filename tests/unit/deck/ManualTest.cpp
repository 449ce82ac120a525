// SPDX-License-Identifier: BSD-3-Clause
// The manual and the templates, and the variants of a registry in both.
#include "deck/Manual.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "SmallScene.hpp"
#include "deck/Template.hpp"
#include "deck/Variants.hpp"
#include "deck/reading/Units.hpp"

namespace ManualTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + part.size()))
    ++n;
  return n;
}

/// A spring with two registered laws, one of them without parameters.
struct Spring {
  virtual ~Spring() = default;
};
struct Plain : Spring {};
struct Cubic : Spring {
  explicit Cubic(double c) : coefficient(c) {}
  double coefficient;
};
using Springs = Registry<Spring, const Teuchos::ParameterList&>;

const bool plainRegistered = Springs::instance().add(
    "Plain", {"Force proportional to the stretch.", ListSpec(),
              [](const Teuchos::ParameterList&) { return std::make_unique<Plain>(); }});
const bool cubicRegistered = Springs::instance().add(
    "Cubic", {"Force with a cubic part.",
              ListSpec("Cubic", "")
                  .real("Coefficient", "N/m", 2.0, Range::positive(), "The cubic coefficient."),
              [](const Teuchos::ParameterList& list) {
                return std::make_unique<Cubic>(
                    variantList(list, "Cubic", Springs::instance().find("Cubic").parameters)
                        .get<double>("Coefficient"));
              }});

ListSpec springList() {
  ListSpec list("Springs", "The springs.");
  declareVariants<Spring, const Teuchos::ParameterList&>(list, "Law", "Plain",
                                                         "The law of the springs.");
  return list;
}

TEST(Manual, ShowsEachListAndParameterInTheOrderOfDeclaration) {
  const std::string text = manualMarkdown(smallScene());
  std::size_t at = 0;
  for (const char* part :
       {"## scene\n\nA small scene.\n", "| `Title` | string |  |  | `none` | The title. |",
        "### scene/Contact\n\nThe contact with the borehole wall.\n",
        "| Name | Type | Unit | Range | Default | Meaning |\n|---|---|---|---|---|---|\n",
        "| `Stiffness` | double | N/m | > 0 | required | The nominal contact stiffness. |\n",
        "| `Friction` | double |  | in [0, 1] | `0.2` | The friction coefficient. |\n",
        "| `Law` | string |  | Linear, Hertz, Winkler | `Linear` | The contact law. |\n",
        "#### scene/Contact/Intervals\n",
        "Holds lists with names of your own, each described under \\<interval>.\n",
        "##### scene/Contact/Intervals/\\<interval>\n",
        "| `Depths` | Array(double) | m | >= 0 | required |",
        "| `Friction` | double |  | in [0, 1] | none |",
        "### scene/Transient\n\nThe time integration. Required.\n",
        "| `Fields` | Array(string) |  | u, v, w | `{u, v}` |",
        "| `Note` | string |  |  | \"\" | A remark. |\n", "#### scene/Transient/NOX\n",
        "Handed on to Trilinos as it is.", "### scene/Mud\n"}) {
    const std::size_t found = text.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << "\nnot in\n" << text.substr(at);
    at = found;
  }
  EXPECT_EQ(text.back(), '\n');
  EXPECT_NE(text[text.size() - 2], '\n');
}

/// A list that declares an expert parameter between two basic ones.
ListSpec listWithExpert() {
  return ListSpec("steps", "The steps.")
      .real("Step", "s", Optional{}, Range::positive(), "The time step.")
      .integer("Max Halvings", 10, Range::atLeast(0), "How often a step is halved.")
      .expert()
      .formerly("Halvings")
      .real("End Time", "s", Optional{}, Range::positive(), "The end.");
}

TEST(Manual, ShowsBasicParametersBeforeThoseForExperts) {
  const std::string text = manualMarkdown(listWithExpert());
  const auto end = text.find("| `End Time` |");
  const auto heading = text.find("For experts:\n\n| Name |");
  const auto halvings = text.find("| `Max Halvings` |");
  EXPECT_LT(text.find("| `Step` |"), end);
  EXPECT_LT(end, heading);
  EXPECT_LT(heading, halvings);
  ASSERT_NE(halvings, std::string::npos);
  EXPECT_EQ(manualMarkdown(smallScene()).find("For experts"), std::string::npos);
}

TEST(Manual, JsonHasTheLevelOfEachParameter) {
  const auto list = nlohmann::json::parse(manualJson(listWithExpert()))[0];
  EXPECT_EQ(list["parameters"][0]["level"], "basic");
  EXPECT_EQ(list["parameters"][1]["level"], "expert");
}

TEST(Template, ShowsBasicParametersBeforeThoseForExperts) {
  const std::string text = templateXml(listWithExpert(), "steps");
  const auto end = text.find("name=\"End Time\"");
  const auto halvings = text.find("name=\"Max Halvings\"");
  EXPECT_LT(end, halvings);
  ASSERT_NE(halvings, std::string::npos);
  EXPECT_NE(text.find("; for experts -->"), std::string::npos);
}

TEST(Manual, IsTheSameEachTime) {
  EXPECT_EQ(manualMarkdown(smallScene()), manualMarkdown(smallScene()));
}

TEST(Manual, ATopicIsAListWithAllBelow) {
  for (const char* topic : {"Contact", "contact", "scene/Contact", "/Contact", "/scene/Contact"}) {
    const std::string text = manualMarkdown(smallScene(), topic);
    EXPECT_EQ(occurrences(text, "\n#") + 1, 3U) << topic;
    EXPECT_EQ(text.find("### scene/Contact\n"), 0U) << topic;
  }
  EXPECT_EQ(
      manualMarkdown(smallScene(), "interval").find("##### scene/Contact/Intervals/\\<interval>\n"),
      0U);
}

TEST(Manual, ATopicMayBeAParameter) {
  const std::string text = manualMarkdown(smallScene(), "friction");
  EXPECT_NE(text.find("### scene/Contact\n"), std::string::npos);
  EXPECT_NE(text.find("\\<interval>"), std::string::npos);
  EXPECT_EQ(text.find("scene/Transient"), std::string::npos);
}

TEST(Manual, AnUnknownTopicIsWrongUsage) {
  const std::string fault = messageOf([] { manualMarkdown(smallScene(), "Contct"); });
  EXPECT_EQ(fault.find("UsageError: The manual has no topic \"Contct\". Did you mean \"Contact\"? "
                       "Topics are the lists "
                       "\"scene\", \"Contact\","),
            0U)
      << fault;
  EXPECT_NE(messageOf([] { manualJson(smallScene(), "Contct"); }), "");
}

TEST(Manual, SeveralRootsFollowEachOther) {
  const std::vector<ListSpec> roots = {
      smallScene(),
      ListSpec("library", "Components.").namedLists(ListSpec("component", "One component."))};
  EXPECT_NE(manualMarkdown(roots).find("\n## library\n"), std::string::npos);
  EXPECT_EQ(manualMarkdown(roots, "component").find("### library/\\<component>"), 0U);
}

TEST(Manual, JsonHoldsWhatTheDescriptionHolds) {
  const auto all = nlohmann::json::parse(manualJson(smallScene()));
  ASSERT_EQ(all.size(), 1U);
  const auto& scene = all[0];
  EXPECT_EQ(scene["path"], "scene");
  const auto& contact = scene["lists"][0];
  EXPECT_EQ(contact["name"], "Contact");
  EXPECT_EQ(contact["required"], false);
  const auto& stiff = contact["parameters"][0];
  EXPECT_EQ(stiff["name"], "Stiffness");
  EXPECT_EQ(stiff["type"], "double");
  EXPECT_EQ(stiff["unit"], "N/m");
  EXPECT_EQ(stiff["min"], 0.0);
  EXPECT_EQ(stiff["open_min"], true);
  EXPECT_TRUE(stiff["max"].is_null());
  EXPECT_EQ(stiff["required"], true);
  EXPECT_TRUE(stiff["default"].is_null());
  EXPECT_EQ(contact["parameters"][2]["choices"].size(), 3U);
  EXPECT_EQ(contact["parameters"][2]["default"], "Linear");
  EXPECT_EQ(contact["lists"][0]["named_lists"]["name"], "interval");
  EXPECT_EQ(scene["lists"][1]["lists"][0]["pass_through"], true);
  EXPECT_EQ(nlohmann::json::parse(manualJson(smallScene(), "Mud"))[0]["path"], "scene/Mud");
}

TEST(Manual, UnitsAreListedByQuantity) {
  const std::string text = unitsMarkdown();
  EXPECT_EQ(text.find("## Units\n\n"), 0U);
  EXPECT_NE(text.find("| length | `in` | `inch`, `inches` | 0.0254 m |\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| rotary speed | `rpm` | `RPM` | 0.10471975511965977 rad/s |\n"),
            std::string::npos);
  EXPECT_NE(text.find("9.80665 m/s2"), std::string::npos);
}

TEST(Manual, UnitsInJsonAreGroupedByQuantityWithTheirFactors) {
  const auto json = nlohmann::json::parse(unitsJson());
  std::size_t count = 0;
  for (const auto& quantity : json) count += quantity["units"].size();
  EXPECT_EQ(count, unitSymbols().size());
  EXPECT_EQ(json[0]["quantity"], "length");
  EXPECT_EQ(json[0]["si"], "m");
  EXPECT_EQ(json[0]["units"][5]["unit"], "in");
  EXPECT_EQ(json[0]["units"][5]["factor"], 0.0254);
  EXPECT_EQ(json[0]["units"][5]["also"][0], "inch");
}

TEST(Manual, UnitsAreATopicInAnyCase) {
  EXPECT_TRUE(isUnitsTopic("units"));
  EXPECT_TRUE(isUnitsTopic(" Units"));
  EXPECT_FALSE(isUnitsTopic("Contact"));
}

TEST(Template, ReadsAsItIs) {
  const Deck deck = Deck::parse(templateXml(smallScene(), "my_well"), "template.xml", smallScene());
  EXPECT_EQ(deck.name(), "my_well");
  EXPECT_EQ(deck.list().sublist("Transient").get<double>("End Time"), 1.0);
  EXPECT_FALSE(deck.list().isSublist("Contact"));
}

TEST(Template, LeavesOutWhatIsForExpertsWhereItShould) {
  const std::string whole = templateXml(listWithExpert(), "steps"),
                    basic = templateXml(listWithExpert(), "steps", {}, Level::Basic);
  EXPECT_NE(whole.find("for experts"), std::string::npos);
  EXPECT_EQ(basic.find("for experts"), std::string::npos);
  EXPECT_LT(basic.size(), whole.size());
}

TEST(Template, ReadsWithEveryCommentedLineTakenIn) {
  const std::string text = uncommented(templateXml(smallScene(), "my_well"));
  const Deck deck = Deck::parse(text, "template.xml", smallScene());
  EXPECT_EQ(deck.list()
                .sublist("Contact")
                .sublist("Intervals")
                .sublist("my interval")
                .get<double>("Friction"),
            1.0);
  EXPECT_TRUE(deck.gives("Transient/Angle"));
  EXPECT_TRUE(deck.gives("Mud/Density"));
  EXPECT_TRUE(deck.list().sublist("Transient").isSublist("NOX"));
}

TEST(Template, HasTheSentenceOfEachParameter) {
  const std::string text = templateXml(smallScene(), "my_well");
  EXPECT_NE(text.find("<!-- the nominal contact stiffness, N/m, > 0; required -->\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("    <!-- <Parameter name=\"Step\" type=\"double\" value=\"0.001\"/> -->\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("    <Parameter name=\"End Time\" type=\"double\" value=\"1\"/>\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  <!-- Contact (optional): The contact with the borehole wall. -->\n"),
            std::string::npos)
      << text;
}

/// A chosen variant that needs values has its list in the template; others, and a chosen one that
/// needs none, are commented out.
TEST(Template, HoldsTheListOfAChosenVariantThatNeedsValues) {
  const auto needs = [](const std::string& name) {
    return ListSpec(name, "N.").real("x", "m", Required{}, Range::any(), "X.");
  };
  const ListSpec scene = ListSpec("s", "S.")
                             .choice("Required Law", Required{}, {"A", "B"}, "L.")
                             .choice("Default Law", "C", {"C", "D", "E"}, "L.")
                             .choice("Other Law", "E", {"E"}, "L.")
                             .list(needs("A"))
                             .list(needs("B"))
                             .list(needs("C"))
                             .list(ListSpec("E", "E.").real("x", "m", 1.0, Range::any(), "X."));
  const auto list = Deck::parse(templateXml(scene, "t"), "t.xml", scene).list();
  EXPECT_TRUE(list.isSublist("A"));
  EXPECT_FALSE(list.isSublist("B"));
  EXPECT_TRUE(list.isSublist("C"));
  EXPECT_FALSE(list.isSublist("E"));
}

/// Parameters of examples appear with the values of the examples, also in lists with free names.
TEST(Template, TakesExamples) {
  const ListSpec piece = ListSpec("Piece", "P.")
                             .real("Length", "m", Optional{}, Range::positive(), "L.")
                             .real("Width", "m", Optional{}, Range::positive(), "W.");
  const ListSpec scene =
      ListSpec("s", "S.")
          .choice("Shape", Required{}, {"A", "B"}, "S.")
          .list(ListSpec("A", "A.").real("x", "m", Required{}, Range::any(), "X."))
          .list(ListSpec("B", "B.").real("x", "m", Required{}, Range::any(), "X."))
          .list(ListSpec("Pieces", "P.").namedLists(piece))
          .list(ListSpec("Loads", "L.").real("Gravity", "m/s2", 0.0, Range::any(), "G."));
  const std::string text =
      templateXml(scene, "t", {{"Shape", "B"}, {"B/x", "2"}, {"Pieces/bar/Length", "3"}});
  const auto list = Deck::parse(text, "t.xml", scene).list();
  EXPECT_EQ(list.get<std::string>("Shape"), "B");
  EXPECT_FALSE(list.isSublist("A"));
  EXPECT_EQ(list.sublist("B").get<double>("x"), 2.0);
  EXPECT_EQ(list.sublist("Pieces").sublist("bar").get<double>("Length"), 3.0);
  EXPECT_FALSE(list.sublist("Pieces").sublist("bar").isParameter("Width"));
  EXPECT_NE(text.find("<!-- <Parameter name=\"Width\" type=\"double\" value=\"1\"/> -->"),
            std::string::npos)
      << text;
  EXPECT_FALSE(list.isSublist("Loads"));
}

TEST(Template, EscapesWhatXmlWouldMisread) {
  const ListSpec odd = ListSpec("odd", "Odd -- indeed <!-- and -")
                           .text("A & B", "a<b>\"c\"--d-", "A sentence with -- and ---- and -");
  const std::string text = templateXml(odd, "odd & \"old\"");
  EXPECT_EQ(Deck::parse(text, "t.xml", odd).name(), "odd & \"old\"");
  const Deck deck = Deck::parse(uncommented(text), "t.xml", odd);
  EXPECT_TRUE(deck.gives("A & B"));
  EXPECT_EQ(deck.list().get<std::string>("A & B"), "a<b>\"c\"--d-");
}

TEST(Variants, AreAChoiceAndAListEach) {
  ASSERT_TRUE(plainRegistered && cubicRegistered);
  const ListSpec list = springList();
  EXPECT_TRUE(list.inconsistencies().empty());
  EXPECT_EQ(list.findParameter("Law")->choices, (std::vector<std::string>{"Cubic", "Plain"}));
  EXPECT_EQ(list.findParameter("Law")->doc,
            "The law of the springs. Cubic: Force with a cubic part. Plain: Force proportional to "
            "the stretch.");
  ASSERT_EQ(list.lists().size(), 1U);
  EXPECT_EQ(list.lists()[0].name(), "Cubic");
  EXPECT_EQ(list.lists()[0].doc(), "Force with a cubic part.");
  EXPECT_NE(manualMarkdown(list).find("### Springs/Cubic\n"), std::string::npos);
}

TEST(Variants, AreMadeWithTheirParametersOrTheirDefaults) {
  const auto made = [](const std::string& text) {
    const Deck deck = Deck::parse("<ParameterList name=\"x\">" + text + "</ParameterList>", "x.xml",
                                  springList());
    return Springs::instance().make(deck.list().get<std::string>("Law"), deck.list());
  };
  const std::string cubic = parameter("Law", "string", "Cubic");
  EXPECT_NE(dynamic_cast<Plain*>(made("").get()), nullptr);
  EXPECT_EQ(dynamic_cast<Cubic&>(*made(cubic)).coefficient, 2.0);
  EXPECT_EQ(
      dynamic_cast<Cubic&>(*made(cubic + "<ParameterList name=\"Cubic\">" +
                                 parameter("Coefficient", "string", "5 kN/m") + "</ParameterList>"))
          .coefficient,
      5000.0);
}

TEST(Variants, AnUnknownOneNamesTheKnown) {
  EXPECT_EQ(messageOf([] {
              Deck::parse("<ParameterList name=\"x\">" + parameter("Law", "string", "Cubical") +
                              "</ParameterList>",
                          "x.xml", springList());
            }),
            "x.xml:1: /x/Law: value=\"Cubical\" is not one of \"Cubic\", \"Plain\". Did you mean "
            "\"Cubic\"?");
  EXPECT_EQ(messageOf([] { Springs::instance().find("Cubical"); }),
            "Unknown name \"Cubical\". Available: \"Cubic\", \"Plain\".");
}

TEST(Variants, AVariantWithRequiredParametersNeedsItsList) {
  const ListSpec own = ListSpec("Own", "O.").real("x", "m", Required{}, Range::any(), "X.");
  Teuchos::ParameterList list("/well/Springs");
  EXPECT_EQ(messageOf([&] { variantList(list, "Own", own); }),
            "/well/Springs needs the list \"Own\", since some of its parameters are required.");
}

}  // namespace ManualTest
