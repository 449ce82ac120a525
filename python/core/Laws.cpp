// SPDX-License-Identifier: BSD-3-Clause
// Point laws: those of the registry, and laws written in Python.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.hpp"
#include "Bind.hpp"
#include "Calls.hpp"
#include "Lists.hpp"
#include "common/Index.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::python {

namespace {

using model::PointLaw;

/// The functions of a law: force(t, d, v, **parameters), the others likewise or None.
struct Functions {
  Kept force, tangent, power, parameters;
};

/// f(t, d, v) as a function of Python, one call for a batch of points. With width 1 its arrays have
/// one dimension, else points x width.
class PythonLaw final : public PointLaw {
 public:
  PythonLaw(std::string name, int points, int width, Functions functions)
      : name_(std::move(name)), points_(points), width_(width), functions_(std::move(functions)) {}

  int size() const override { return points_; }
  int width() const override { return width_; }

  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    scatter(active, width_, force(t, gather(active, d), gather(active, v), sizeOf(active)), f);
  }

  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    evaluate(t, active, d, v, f);
    const auto at = gather(active, d), velocity = gather(active, v);
    const int n = sizeOf(active), square = width_ * width_;
    std::vector<double> slopes[2];
    if (!(*functions_.tangent).is_none())
      given(t, at, velocity, n, slopes);
    else
      differences(t, at, velocity, n, slopes);
    scatter(active, square, slopes[0], dfdd);
    scatter(active, square, slopes[1], dfdv);
  }

  void clearanceLeft(const std::vector<int>& points, const double*, double* gap) const override {
    for (int p : points) gap[p] = 0.0;
  }

  /// Without a function of its own the force at rest has a potential, V(t, d) = -int_0^1 f(t, s d,
  /// 0) d ds, of which dV/dt at fixed d is fed in; what else velocities add to the force is
  /// damping.
  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const override {
    constexpr double instant = 1e-6;  // [s]: for dV/dt, below what a motion resolves
    const auto at = gather(points, d), velocity = gather(points, v);
    const int n = sizeOf(points);
    Power sum;
    if (!(*functions_.power).is_none()) return given(t, at, velocity, n);
    sum.stored = potential(t, at, n);
    sum.drive = (potential(t + instant, at, n) - potential(t - instant, at, n)) / (2 * instant);
    const auto moving = force(t, at, velocity, n);
    const auto still = force(t, at, Values(at.size(), 0.0), n);
    for (std::size_t i = 0; i < moving.size(); ++i)
      sum.damping -= (moving[i] - still[i]) * velocity[i];
    return sum;
  }

  std::vector<model::Channel> channels() const override {
    return {{"force", "N", "Force along the first coordinate"}};
  }
  void record(double t, const double* d, const double* v, double* out) const override {
    const auto count = static_cast<std::size_t>(points_) * static_cast<std::size_t>(width_);
    const auto f = force(t, {d, d + count}, {v, v + count}, points_);
    for (int p = 0; p < points_; ++p) out[p] = f[at(p * width_)];
  }

  std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const override {
    return std::make_shared<PythonLaw>(name_, sizeOf(points), width_, functions_);
  }

 private:
  using Values = std::vector<double>;
  std::string who() const { return "The point law \"" + name_ + "\""; }

  Values gather(const std::vector<int>& points, const double* all) const {
    Values some;
    some.reserve(points.size() * at(width_));
    for (int p : points) some.insert(some.end(), all + p * width_, all + (p + 1) * width_);
    return some;
  }
  static void scatter(const std::vector<int>& points, int each, const Values& some, double* all) {
    for (std::size_t i = 0; i < points.size(); ++i)
      std::copy_n(some.data() + i * at(each), each, all + points[i] * each);
  }

  std::vector<py::ssize_t> shape(int n) const {
    return width_ == 1 ? std::vector<py::ssize_t>{n} : std::vector<py::ssize_t>{n, width_};
  }
  py::object call(const Kept& function, double t, const Values& d, const Values& v, int n) const {
    const auto parameters = py::reinterpret_borrow<py::dict>(*functions_.parameters);
    // Arrays of their own: the function may keep them.
    return (*function)(t, toNumpy(d, shape(n)), toNumpy(v, shape(n)), **parameters);
  }

  Values force(double t, const Values& d, const Values& v, int n) const {
    Values f(d.size());
    fromPython(who(),
               [&] { copyInto(call(functions_.force, t, d, v, n), n, width_, f.data(), who()); });
    return f;
  }

  /// By the function of the powers.
  Power given(double t, const Values& d, const Values& v, int n) const {
    Power sum;
    fromPython(who(), [&] {
      const auto values = call(functions_.power, t, d, v, n).cast<Values>();
      double* const parts[] = {&sum.stored, &sum.damping, &sum.friction, &sum.drive};
      for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 4); ++i)
        *parts[i] = values[i];
    });
    return sum;
  }

  /// V of all points by Gauss's rule with 16 points: to 0.5 % where a wall is on the way.
  double potential(double t, const Values& d, int n) const {
    static const auto* rule = new std::array<Values, 2>(gaussRule());
    const auto& [places, weights] = *rule;
    Values along;
    for (const double s : places)
      for (const double x : d) along.push_back(s * x);
    const int all = n * sizeOf(places);
    const auto f = force(t, along, Values(along.size(), 0.0), all);
    double work = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k)
      for (std::size_t i = 0; i < d.size(); ++i) work += weights[k] * f[k * d.size() + i] * d[i];
    return -work;
  }
  /// Places and weights on [0, 1].
  static std::array<Values, 2> gaussRule() {
    std::array<Values, 2> rule;
    const py::gil_scoped_acquire gil;
    const auto numpy = py::module_::import("numpy.polynomial.legendre");
    const auto both = numpy.attr("leggauss")(16).cast<std::pair<Values, Values>>();
    for (const double x : both.first) rule[0].push_back((1 + x) / 2);
    for (const double w : both.second) rule[1].push_back(w / 2);
    return rule;
  }

  /// By the function of the tangents: (df/dd, df/dv), each points x width x width.
  void given(double t, const Values& d, const Values& v, int n, Values* slopes) const {
    fromPython(who(), [&] {
      const auto both =
          call(functions_.tangent, t, d, v, n).cast<std::pair<py::object, py::object>>();
      const py::object arrays[] = {both.first, both.second};
      for (int k = 0; k < 2; ++k) {
        slopes[k].resize(at(n * width_ * width_));
        copyInto(py::module_::import("numpy").attr("reshape")(arrays[k],
                                                              py::make_tuple(n, width_ * width_)),
                 n, width_ * width_, slopes[k].data(), who());
      }
    });
  }

  /// Central differences of second order, all of them in one call.
  void differences(double t, const Values& d, const Values& v, int n, Values* slopes) const {
    static const double relative = std::cbrt(std::numeric_limits<double>::epsilon());
    constexpr double least = 1e-9;  // [m, m/s]: below what a law resolves
    Values manyD, manyV, steps;
    for (int k = 0; k < 2 * width_; ++k)
      for (const double sign : {1.0, -1.0}) {
        Values moved[] = {d, v};
        for (int p = 0; p < n; ++p) {
          double& x = moved[k / width_][at(p * width_ + k % width_)];
          const double h = std::max(relative * std::abs(x), least);
          if (sign > 0) steps.push_back(h);
          x += sign * h;
        }
        manyD.insert(manyD.end(), moved[0].begin(), moved[0].end());
        manyV.insert(manyV.end(), moved[1].begin(), moved[1].end());
      }
    const Values f = force(t, manyD, manyV, 4 * width_ * n);
    for (int k = 0; k < 2 * width_; ++k) {
      Values& slope = slopes[k / width_];
      slope.resize(at(n * width_ * width_));
      for (int p = 0; p < n; ++p)
        for (int row = 0; row < width_; ++row) {
          const auto value = [&](int side) {
            return f[at(((2 * k + side) * n + p) * width_ + row)];
          };
          slope[at((p * width_ + row) * width_ + k % width_)] =
              (value(0) - value(1)) / (2 * steps[at(k * n + p)]);
        }
    }
  }

  std::string name_;
  int points_, width_;
  Functions functions_;
};

/// A law that decks can name.
struct Registered {
  int width;
  Kept force, tangent, power;
  py::dict names;
};

/// By name; changed and read with the GIL only, never destroyed.
std::map<std::string, Registered>& registered() {
  static auto* laws = new std::map<std::string, Registered>;
  return *laws;
}

std::unique_ptr<PointLaw> makeRegistered(const std::string& name, const Teuchos::ParameterList& own,
                                         const model::PointLawPlace& place) {
  std::unique_ptr<PointLaw> law;
  fromPython("The point law \"" + name + "\"", [&] {
    const auto& one = registered().at(name);
    if (one.width > place.coordinates)
      throw DeckError("The point law \"" + name + "\" takes " + std::to_string(one.width) +
                      " coordinates, but its place has " + std::to_string(place.coordinates) + ".");
    law = std::make_unique<PythonLaw>(
        name, place.points, one.width,
        Functions{one.force, one.tangent, one.power, Kept(keywords(own, one.names))});
  });
  return law;
}

void registerLaw(const std::string& name, const std::string& doc, const py::list& parameters,
                 const py::dict& names, int width, const py::object& force,
                 const py::object& tangent, const py::object& power) {
  auto& laws = registered();
  const bool own = laws.count(name) != 0;
  auto& registry = model::PointLawRegistry::instance();
  if (!own && registry.entries().count(name) != 0)
    throw UsageError("There is a point law \"" + name + "\" already. Choose another name.");
  if (own && !laws.at(name).names.equal(names))
    throw UsageError("The point law \"" + name +
                     "\" was registered with other parameters. Choose another name, or start "
                     "Python anew.");
  laws.insert_or_assign(name, Registered{width, Kept(force), Kept(tangent), Kept(power), names});
  if (own) return;
  registry.add(name,
               {doc, specFrom(name, doc, parameters),
                [name](const Teuchos::ParameterList& list, const model::PointLawPlace& place) {
                  return makeRegistered(name, list, place);
                }});
}

Vector evaluate(const PointLaw& law, double t, const Vector& d, const Vector& v) {
  const Eigen::Index wanted = law.size() * law.width();
  if (d.size() != wanted || v.size() != wanted)
    throw UsageError("The law has " + std::to_string(law.size()) + " points with " +
                     std::to_string(law.width()) + " coordinates: give " + std::to_string(wanted) +
                     " positions and velocities.");
  if (dynamic_cast<const model::StatefulPointLaw*>(&law) != nullptr)
    throw UsageError("The force of a law with states depends on its motion: integrate it.");
  std::vector<int> all(at(law.size()));
  for (int p = 0; p < law.size(); ++p) all[at(p)] = p;
  Vector f(wanted);
  law.evaluate(t, all, d.data(), v.data(), f.data());
  return f;
}

}  // namespace

void bindLaws(py::module_& module) {
  py::class_<PointLaw, std::shared_ptr<PointLaw>>(module, "PointLaw",
                                                  "Forces of points f(t, d, v), all of one law.")
      .def_property_readonly("size", &PointLaw::size, "Number of points.")
      .def_property_readonly("width", &PointLaw::width, "Coordinates of a point.")
      .def("force", &evaluate, py::arg("t"), py::arg("d"), py::arg("v"),
           "Forces [N] at positions d [m] and velocities v [m/s], points x width in one row.");
  module.def(
      "point_law",
      [](const std::string& name, const List& list, int points, int coordinates) {
        return std::shared_ptr<PointLaw>(model::PointLawRegistry::instance().make(
            name, *list, model::PointLawPlace{points, coordinates}));
      },
      py::arg("name"), py::arg("parameters"), py::arg("points"), py::arg("coordinates"),
      "A law of the registry.");
  module.def("register_point_law", &registerLaw, py::arg("name"), py::arg("doc"),
             py::arg("parameters"), py::arg("keywords"), py::arg("width"), py::arg("force"),
             py::arg("tangent"), py::arg("power"), "Register a law written in Python.");
  module.def(
      "point_law_names", [] { return model::PointLawRegistry::instance().names(); },
      "Names of the laws there are.");
}

}  // namespace tooljoint::python
