// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/well/Well.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "deck/Deck.hpp"

namespace tooljoint::well {

Well::Well(std::shared_ptr<const Trajectory> trajectory, double boreRadius,
           std::vector<BoreInterval> intervals)
    : trajectory_(std::move(trajectory)),
      boreRadius_(boreRadius),
      intervals_(std::move(intervals)) {
  std::sort(intervals_.begin(), intervals_.end(),
            [](const auto& a, const auto& b) { return a.from < b.from; });
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const BoreInterval& now = intervals_[i];
    std::ostringstream text;
    if (!(now.to > now.from))
      text << "The bore interval \"" << now.name << "\" ends at " << now.to
           << " m, above its start at " << now.from << " m.";
    else if (!(now.radius > 0.0))
      text << "The bore interval \"" << now.name << "\" has the radius " << now.radius
           << " m; it must be above 0.";
    else if (i > 0 && now.from < intervals_[i - 1].to - 1e-9)
      text << "The bore intervals \"" << intervals_[i - 1].name << "\" and \"" << now.name
           << "\" overlap between " << now.from << " m and "
           << std::min(now.to, intervals_[i - 1].to) << " m.";
    if (!text.str().empty()) throw DeckError(text.str());
  }
}

double Well::boreRadius(double s) const {
  // an interval is closed and extended by 1e-9 m, so that a node on its end has both neighbours
  const double slack = 1e-9;
  double inside = std::numeric_limits<double>::infinity();
  bool covered = false;  // an interval extends beyond s on both sides
  double reach = -std::numeric_limits<double>::infinity();
  for (const BoreInterval& interval : intervals_) {
    if (interval.from - slack > s) break;
    if (interval.to + slack < s) continue;
    inside = std::min(inside, interval.radius);
    if (interval.from < s - slack && interval.to > s + slack) covered = true;
    if (std::abs(interval.from - s) <= slack && std::abs(reach - s) <= slack) covered = true;
    reach = interval.to;
  }
  return covered ? inside : std::min(inside, boreRadius_);
}

namespace {

/// The part of a centre line below a depth.
class Below final : public Trajectory {
 public:
  Below(std::shared_ptr<const Trajectory> whole, double top)
      : whole_(std::move(whole)), top_(top), origin_(whole_->at(top).position) {}

  double length() const override { return whole_->length() - top_; }
  WellPoint at(double s) const override {
    WellPoint point = whole_->at(top_ + s);
    point.position -= origin_;
    return point;
  }
  std::vector<double> breaks() const override {
    std::vector<double> depths;
    for (const double depth : whole_->breaks())
      if (depth > top_) depths.push_back(depth - top_);
    return depths;
  }

 private:
  std::shared_ptr<const Trajectory> whole_;
  double top_;
  Vector3 origin_;
};

}  // namespace

Well Well::below(double top, std::shared_ptr<const Trajectory> centreLine) const {
  std::vector<BoreInterval> lower;
  for (auto interval : intervals_) {
    if (!(interval.to > top)) continue;
    interval.from -= top;
    interval.to -= top;
    lower.push_back(interval);
  }
  return Well(std::move(centreLine), boreRadius_, std::move(lower));
}

Well Well::below(double top) const { return below(top, std::make_shared<Below>(trajectory_, top)); }

double Well::inclination(double s) const {
  const Vector3 tangent = trajectory_->at(s).tangent;
  return std::atan2(std::hypot(tangent.x(), tangent.y()), tangent.z());
}

deck::ListSpec parameters() {
  deck::ListSpec spec("Well", "The hole: centre line and bore radius.");
  const auto& registry = TrajectoryRegistry::instance();
  spec.choice("Trajectory", deck::Required{}, registry.names(),
              "Shape of the centre line; its parameters stand in the sublist of that name.");
  spec.radius("Bore Radius", deck::Required{}, deck::Range::positive(),
              "Radius of the hole outside the intervals of the list Bore.");
  for (const auto& [name, entry] : registry.entries()) spec.list(entry.parameters);
  spec.list(
      deck::ListSpec(
          "Bore",
          "Stretches of the hole with their own radius; where two meet the smaller radius counts.")
          .namedLists(deck::ListSpec("Interval", "A stretch of the hole.")
                          .real("From", "m", deck::Required{}, deck::Range::nonNegative(),
                                "Measured depth of its upper end.")
                          .real("To", "m", deck::Required{}, deck::Range::positive(),
                                "Measured depth of its lower end.")
                          .radius("Radius", deck::Required{}, deck::Range::positive(),
                                  "Radius of the hole.")));
  return spec;
}

Well readWell(const Teuchos::ParameterList& list, const std::string& folder) {
  const auto& name = list.get<std::string>("Trajectory");
  const auto& entry = TrajectoryRegistry::instance().find(name);
  std::shared_ptr<const Trajectory> trajectory =
      entry.make(deck::variantList(list, name, entry.parameters), folder);
  std::vector<BoreInterval> intervals;
  if (list.isSublist("Bore")) {
    const Teuchos::ParameterList& bore = list.sublist("Bore");
    for (auto it = bore.begin(); it != bore.end(); ++it) {
      const std::string& key = bore.name(it);
      const Teuchos::ParameterList& interval = bore.sublist(key);
      intervals.push_back({key, interval.get<double>("From"), interval.get<double>("To"),
                           interval.get<double>("Radius")});
    }
  }
  try {
    return Well(std::move(trajectory), list.get<double>("Bore Radius"), std::move(intervals));
  } catch (const DeckError& error) {
    throw DeckError(list.name() + "/Bore: " + error.what());
  }
}

}  // namespace tooljoint::well
