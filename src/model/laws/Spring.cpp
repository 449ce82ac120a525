// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "model/laws/Connectors.hpp"
#include "model/laws/PerPoint.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

/// f = -k d - k3 d^3 - c v
class Springs final : public PerPoint<SpringParameters, Springs> {
 public:
  explicit Springs(const std::vector<SpringParameters>& points) : PerPoint(points) {
    for (const auto& s : points) {
      require(s.stiffness >= 0, "stiffness of a spring", s.stiffness, "zero or positive");
      require(s.cubicStiffness >= 0, "cubic stiffness of a spring", s.cubicStiffness,
              "zero or positive");
      require(s.damping >= 0, "damping of a dashpot", s.damping, "zero or positive");
    }
  }
  void evaluate(double, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    for (int p : active) f[p] = force(p, d[p], v[p]);
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    for (int p : active) {
      const auto& s = at(p);
      f[p] = force(p, d[p], v[p]);
      dfdd[p] = -s.stiffness - 3 * s.cubicStiffness * d[p] * d[p];
      dfdv[p] = -s.damping;
    }
  }
  Power power(double, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    for (int p : points) {
      const auto& s = at(p);
      sum.stored += 0.5 * s.stiffness * d[p] * d[p] + 0.25 * s.cubicStiffness * std::pow(d[p], 4);
      sum.damping += s.damping * v[p] * v[p];
    }
    return sum;
  }
  /// A hardening spring acts as a bumper.
  bool hasWalls() const override {
    return std::any_of(points_.begin(), points_.end(),
                       [](const auto& s) { return s.cubicStiffness > 0.0; });
  }
  std::vector<Channel> channels() const override {
    return {{"spring_force", "N", "Force of the spring and dashpot along their coordinate"}};
  }
  void record(double, const double* d, const double* v, double* out) const override {
    for (int p = 0; p < size(); ++p) out[p] = force(p, d[p], v[p]);
  }

 private:
  double force(int p, double d, double v) const {
    const auto& s = at(p);
    return -s.stiffness * d - s.cubicStiffness * d * d * d - s.damping * v;
  }
};

std::unique_ptr<PointLaw> makeSpring(const Teuchos::ParameterList& own,
                                     const PointLawPlace& place) {
  SpringParameters spring;
  spring.stiffness = own.get<double>("Stiffness");
  spring.cubicStiffness = own.get<double>("Cubic Stiffness");
  spring.damping = own.get<double>("Damping");
  if (spring.stiffness == 0.0 && spring.cubicStiffness == 0.0 && spring.damping == 0.0)
    throw DeckError(own.name() +
                    " does nothing: give it a Stiffness, a Cubic Stiffness or a Damping.");
  return springs(std::vector<SpringParameters>(static_cast<std::size_t>(place.points), spring));
}

const bool springRegistered = PointLawRegistry::instance().add(
    "Spring", {"A spring with a dashpot beside it.",
               deck::ListSpec("Spring", "A spring with a dashpot beside it.")
                   .real("Stiffness", "N/m", 0.0, deck::Range::nonNegative(),
                         "Stiffness, along a translation or about a rotation.")
                   .real("Cubic Stiffness", "N/m3", 0.0, deck::Range::nonNegative(),
                         "Factor of the cube of the separation.")
                   .expert()
                   .real("Damping", "N s/m", 0.0, deck::Range::nonNegative(),
                         "Damping, along a translation or about a rotation."),
               makeSpring});

}  // namespace

std::unique_ptr<PointLaw> springs(const std::vector<SpringParameters>& points) {
  return std::make_unique<Springs>(points);
}

}  // namespace tooljoint::model
