// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "deck/Deck.hpp"
#include "substructures/contact/ContactParameters.hpp"

namespace ParametersTest {

using namespace tooljoint;
using namespace tooljoint::contact;

ContactSettings fromDeck(const std::string& inside) {
  deck::ListSpec scene("scene", "A scene.");
  scene.list(parameters());
  const deck::Deck deck =
      deck::Deck::parse("<ParameterList name=\"scene\"><ParameterList name=\"Contact\">" + inside +
                            "</ParameterList></ParameterList>",
                        "deck.xml", scene);
  return readContact(deck.list().sublist("Contact"));
}

std::string errorOf(const std::string& inside) {
  try {
    fromDeck(inside);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

std::string real(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>";
}
std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
}
std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
}

TEST(ContactParameters, DefaultsAreClampedAndFrictionless) {
  const ContactSettings settings = fromDeck(real("Stiffness", "1e7"));
  EXPECT_EQ(settings.lawName, "Clamped");
  EXPECT_FALSE(settings.friction);
  const ContactPoint p = settings.pointAt(10.0, 3, 0.02, 0.08);
  EXPECT_EQ(p.node, 3);
  EXPECT_EQ(p.clearance, 0.02);
  EXPECT_EQ(p.contactRadius, 0.08);
  EXPECT_EQ(p.stiffness, 1e7);
  EXPECT_EQ(p.damping, 0.0);
  EXPECT_EQ(p.lambdaK, 1e6);
  EXPECT_EQ(p.muStatic, 0.0);
}

TEST(ContactParameters, EveryParameterArrives) {
  const ContactSettings settings =
      fromDeck(text("Law", "Nguyen") + text("Stiffness", "10 kN/mm") + real("Damping", "1e4") +
               real("Stiffness Regularisation", "7e11") + real("Damping Regularisation", "6e11") +
               list("Friction", real("Static", "0.2") + real("Dynamic", "0.1") +
                                    text("Regularisation Velocity", "5 cm/s")));
  EXPECT_EQ(settings.lawName, "Nguyen");
  EXPECT_TRUE(settings.friction);
  const ContactPoint& p = settings.values;
  EXPECT_NEAR(p.stiffness, 1e7, 1e-6);
  EXPECT_EQ(p.damping, 1e4);
  EXPECT_EQ(p.lambdaK, 7e11);
  EXPECT_EQ(p.lambdaC, 6e11);
  EXPECT_EQ(p.muStatic, 0.2);
  EXPECT_EQ(p.muDynamic, 0.1);
  EXPECT_NEAR(p.regularisationVelocity, 0.05, 1e-15);
}

TEST(ContactParameters, IntervalsOverrideWhatTheyGive) {
  const ContactSettings settings = fromDeck(
      real("Stiffness", "1e7") + real("Damping", "100") +
      list("Friction", real("Static", "0.3") + real("Dynamic", "0.2")) +
      list("Intervals",
           list("open hole", real("From", "50") + real("To", "100") + real("Stiffness", "1e6") +
                                 list("Friction", real("Static", "0.5"))) +
               list("casing", real("From", "0") + real("To", "50") +
                                  list("Friction", real("Static", "0") + real("Dynamic", "0")))));
  EXPECT_EQ(settings.pointAt(20.0, 1, 0.0, 0.0).muStatic, 0.0);
  EXPECT_EQ(settings.pointAt(20.0, 1, 0.0, 0.0).stiffness, 1e7);
  EXPECT_EQ(settings.pointAt(50.0, 1, 0.0, 0.0).stiffness, 1e6);
  EXPECT_EQ(settings.pointAt(50.0, 1, 0.0, 0.0).muStatic, 0.5);
  EXPECT_EQ(settings.pointAt(50.0, 1, 0.0, 0.0).muDynamic, 0.2);
  EXPECT_EQ(settings.pointAt(50.0, 1, 0.0, 0.0).damping, 100.0);
  EXPECT_EQ(settings.pointAt(100.0, 1, 0.0, 0.0).muStatic, 0.3);
}

TEST(ContactParameters, FaultsNameTheirPlace) {
  const std::string k = real("Stiffness", "1e7");
  EXPECT_NE(errorOf(k + list("Friction", real("Static", "0.1") + real("Dynamic", "0.2")))
                .find("/scene/Contact/Friction: the dynamic friction coefficient 0.2 is above the "
                      "static one, 0.1"),
            std::string::npos);
  EXPECT_NE(errorOf(k + list("Friction", real("Static", "0.1"))).find("Dynamic"),
            std::string::npos);
  EXPECT_NE(errorOf(k + list("Intervals", list("a", real("From", "5") + real("To", "5"))))
                .find("/scene/Contact/Intervals/a: To = 5 m"),
            std::string::npos);
  EXPECT_NE(errorOf(k + list("Intervals", list("a", real("From", "5") + real("To", "9")) +
                                              list("b", real("From", "8") + real("To", "12"))))
                .find("overlap"),
            std::string::npos);
  EXPECT_NE(errorOf(k + text("Law", "Hunt-Crossley") + real("Damping", "5"))
                .find("/scene/Contact/Damping is not used by the law Hunt-Crossley"),
            std::string::npos);
  EXPECT_NE(errorOf(k + text("Law", "Nguyn")).find("Did you mean \"Nguyen\"?"), std::string::npos);
  EXPECT_NE(errorOf(real("Stiffness", "0")).find("> 0"), std::string::npos);
}

TEST(ContactParameters, HuntCrossleyTakesItsOwnList) {
  const ContactSettings settings =
      fromDeck(real("Stiffness", "1e6") + text("Law", "Hunt-Crossley") +
               list("Hunt-Crossley", real("Exponent", "2") + real("Dissipation", "3")));
  ContactPoints points;
  points.add(settings.pointAt(0.0, 1, 0.01, 0.08));
  const auto contact = settings.law->inMotion(points, [](double) { return 0.0; });
  const std::vector<double> d = {0.011, 0.0, 0.0}, v = {0.2, 0.0, 0.0};
  std::vector<double> f(3);
  contact->evaluate(0.0, {0}, d.data(), v.data(), f.data());
  EXPECT_NEAR(f[0], -1e6 * 1e-6 * 1.6, 1e-6);
}

}  // namespace ParametersTest
