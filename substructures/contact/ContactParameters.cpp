// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/ContactParameters.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <utility>

#include "common/Text.hpp"
#include "deck/Deck.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "substructures/contact/PointLawContact.hpp"

namespace tooljoint::contact {
namespace {

using deck::Optional;
using deck::Range;
using deck::Required;

void take(const Teuchos::ParameterList& list, const char* name, double& value) {
  if (list.isParameter(name)) value = list.get<double>(name);
}

/// Overrides `values` by the values of the list (the base list or an interval).
void takeValues(const Teuchos::ParameterList& list, ContactPoint& values) {
  take(list, "Stiffness", values.stiffness);
  take(list, "Damping", values.damping);
  take(list, "Stiffness Regularisation", values.lambdaK);
  take(list, "Damping Regularisation", values.lambdaC);
  if (!list.isSublist("Friction")) return;
  const Teuchos::ParameterList& friction = list.sublist("Friction");
  take(friction, "Static", values.muStatic);
  take(friction, "Dynamic", values.muDynamic);
  take(friction, "Regularisation Velocity", values.regularisationVelocity);
  if (values.muDynamic > values.muStatic)
    throw DeckError(friction.name() + ": the dynamic friction coefficient " +
                    formatNumber(values.muDynamic) + " is above the static one, " +
                    formatNumber(values.muStatic) + "; the friction law needs Dynamic <= Static.");
}

std::vector<ContactInterval> readIntervals(const Teuchos::ParameterList& list,
                                           const ContactPoint& base) {
  std::vector<ContactInterval> intervals;
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    const Teuchos::ParameterList& sub = list.sublist(name);
    ContactInterval interval{name, sub.get<double>("From"), sub.get<double>("To"), base};
    takeValues(sub, interval.values);
    if (!(interval.to > interval.from))
      throw DeckError(sub.name() + ": To = " + formatNumber(interval.to) +
                      " m must be deeper than From = " + formatNumber(interval.from) + " m.");
    intervals.push_back(interval);
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const auto& a, const auto& b) { return a.from < b.from; });
  for (std::size_t i = 1; i < intervals.size(); ++i)
    if (intervals[i].from < intervals[i - 1].to)
      throw DeckError(list.name() + ": \"" + intervals[i - 1].name + "\" and \"" +
                      intervals[i].name +
                      "\" overlap; end the upper one where the lower one starts.");
  return intervals;
}

deck::ListSpec frictionSpec(bool base) {
  deck::ListSpec spec(
      "Friction",
      base ? "Smoothed Coulomb friction (Nguyen et al. 2020, eq. 9); without this list the wall is "
             "frictionless."
           : "Friction in this stretch, where it differs; 0 and 0 make it frictionless.");
  const auto value = [base](deck::Default standard) {
    return base ? std::move(standard) : deck::Default(Optional{});
  };
  spec.real("Static", "", value(Required{}), Range::nonNegative(),
            "Peak of the friction coefficient, mu_s; also that of the static state.");
  spec.real(
      "Dynamic", "", value(Required{}), Range::nonNegative(),
      "Friction coefficient of sliding much faster than Regularisation Velocity, mu_d; at most "
      "Static.");
  spec.real("Regularisation Velocity", "m/s", value(0.1), Range::positive(),
            "v_r: the coefficient starts with the slope 1/v_r; smaller is sharper.");
  if (base)
    spec.boolean(
            "Axial", false,
            "Friction acts against the whole sliding velocity: around the wall and along the "
            "hole, where w and Top Drive/Block Speed move the string. Without it, against that "
            "around the wall alone. Required (true or false) where a block moves a string with "
            "friction in a hole that is not vertical. torque-drag always has it.")
        .expert();
  return spec;
}

deck::ListSpec intervalSpec() {
  return deck::ListSpec("Interval",
                        "A stretch of the hole; what it does not give is as outside it.")
      .real("From", "m", Required{}, Range::nonNegative(), "Measured depth of its upper end.")
      .real("To", "m", Required{}, Range::positive(),
            "Measured depth of its lower end; a node exactly there belongs to the next stretch.")
      .real("Stiffness", "N/m", Optional{}, Range::positive(), "Contact stiffness k_c here.")
      .real("Damping", "N s/m", Optional{}, Range::nonNegative(), "Contact damping c_c here.")
      .real("Stiffness Regularisation", "1/m", Optional{}, Range::positive(), "lambda_k here.")
      .real("Damping Regularisation", "1/m", Optional{}, Range::positive(), "lambda_c here.")
      .list(frictionSpec(false));
}

}  // namespace

ContactPoint ContactSettings::pointAt(double s, int node, double clearance,
                                      double contactRadius) const {
  ContactPoint point = values;
  for (const ContactInterval& interval : intervals)
    if (s >= interval.from && s < interval.to) point = interval.values;
  point.node = node;
  point.clearance = clearance;
  point.contactRadius = contactRadius;
  return point;
}

deck::ListSpec parameters() {
  const auto& registry = LawRegistry::instance();
  deck::ListSpec spec("Contact",
                      "Contact of the string with the wall; without this list there is none.");
  const auto& pointLaws = model::PointLawRegistry::instance();
  auto names = registry.names();
  for (const auto& name : pointLaws.names()) names.push_back(name);
  spec.choice("Law", std::string("Clamped"), names,
              "Law of the normal force, or a point law with its own forces (" +
                  quotedList(pointLaws.names()) +
                  "), which takes no other parameter of this list but Stiffness, as that of the "
                  "wall in checks.");
  spec.real("Stiffness", "N/m", Required{}, Range::positive(), "Contact stiffness k_c.");
  spec.real("Damping", "N s/m", 0.0, Range::nonNegative(), "Contact damping c_c.");
  spec.real("Stiffness Regularisation", "1/m", 1e6, Range::positive(),
            "lambda_k: the stiffness rises over about 1/lambda_k of penetration; above 1e6 it is a "
            "step for every purpose.");
  spec.real("Damping Regularisation", "1/m", 1e6, Range::positive(),
            "lambda_c: the same for the damping.");
  spec.list(frictionSpec(true));
  for (const auto& [name, entry] : registry.entries())
    if (!entry.parameters.parameters().empty()) spec.list(entry.parameters);
  for (const auto& [name, entry] : pointLaws.entries())
    if (!entry.parameters.parameters().empty()) spec.list(entry.parameters);
  spec.list(deck::ListSpec("Intervals", "Stretches of the hole with other parameters.")
                .namedLists(intervalSpec()));
  return spec;
}

ContactSettings readContact(const Teuchos::ParameterList& list) {
  ContactSettings settings;
  settings.lawName = list.get<std::string>("Law");
  const auto own = [&](const deck::ListSpec& parameters) {
    return deck::variantList(list, settings.lawName, parameters);
  };
  takeValues(list, settings.values);
  const auto& pointLaws = model::PointLawRegistry::instance().entries();
  if (const auto it = pointLaws.find(settings.lawName); it != pointLaws.end()) {
    for (const char* unused : {"Friction", "Intervals"})
      if (list.isSublist(unused))
        throw DeckError(list.name() + "/" + unused + " is not used by the law " + settings.lawName +
                        ", which has its own forces. Leave it out.");
    settings.law = pointLawContact(settings.lawName, own(it->second.parameters));
    return settings;
  }
  const auto& entry = LawRegistry::instance().find(settings.lawName);
  settings.law = LawRegistry::instance().make(settings.lawName, own(entry.parameters));
  if (settings.lawName == "Hunt-Crossley" && settings.values.damping > 0.0)
    throw DeckError(list.name() +
                    "/Damping is not used by the law Hunt-Crossley; give its Dissipation instead.");
  if (list.isSublist("Intervals"))
    settings.intervals = readIntervals(list.sublist("Intervals"), settings.values);
  settings.friction = settings.values.muStatic > 0.0;
  for (const ContactInterval& interval : settings.intervals)
    settings.friction |= interval.values.muStatic > 0.0;
  settings.axialFriction = settings.friction && list.isSublist("Friction") &&
                           list.sublist("Friction").get<bool>("Axial");
  return settings;
}

}  // namespace tooljoint::contact
