// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/Calibration.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "linalg/DenseDecompositions.hpp"

namespace tooljoint::drillstring {
namespace {

/// Steps of finite differences: of a coefficient [1], of the block weight [N].
constexpr double frictionStep = 1e-4, weightStep = 100.0;
/// Residual of a measurement if the string locks up, in uncertainties [1].
constexpr double lockedUp = 1e4;
/// Start value of the search when the deck's coefficient is at a bound.
constexpr double startingFriction = 0.2;
/// Columns of the scaled Jacobian that are closer to dependent than this cannot be separated.
constexpr double dependent = 1e-4;
/// A coefficient closer than this to 0 or 1 is at its bound.
constexpr double nearBound = 1e-6;
constexpr double confidence = 0.95;

/// The scene with the unknowns p: friction coefficients by stretch, the last entry is the block
/// weight.
class Model {
 public:
  Model(const Scene& scene, const softstring::TorqueDragSettings& settings,
        const std::vector<Measurement>& measured)
      : scene_(scene), settings_(settings), measured_(measured) {
    const auto& contact = *scene.contact;
    unknowns_.push_back({"friction", "Contact/Friction/Dynamic", contact.values.muDynamic});
    for (const auto& interval : contact.intervals)
      unknowns_.push_back({"friction in " + interval.name,
                           "Contact/Intervals/" + interval.name + "/Friction/Dynamic",
                           interval.values.muDynamic});
    unknowns_.push_back({"block weight", "Torque and Drag/Block Weight", settings.blockWeight});
    for (const auto& one : measured) {
      auto named = settings;
      named.operations = {one.operation};
      operations_.push_back(softOperations(scene, named).front());
      values_ += one.hookLoad.has_value() ? 1 : 0;
      values_ += one.surfaceTorque.has_value() ? 1 : 0;
    }
    for (std::size_t i = 0; i < unknowns_.size(); ++i) all_.push_back(unknowns_[i].deck);
  }

  const std::vector<Fitted>& unknowns() const { return unknowns_; }
  const std::vector<double>& deckValues() const { return all_; }
  int values() const { return values_; }
  bool isWeight(std::size_t unknown) const { return unknown + 1 == unknowns_.size(); }

  /// Computed values of the measured quantities.
  std::vector<Measurement> compute(const std::vector<double>& p) const {
    Scene scene = scene_;
    scene.contact->values.muDynamic = p[0];
    for (std::size_t i = 0; i < scene.contact->intervals.size(); ++i)
      scene.contact->intervals[i].values.muDynamic = p[i + 1];
    const SoftModel model = softModel(scene);
    std::vector<Measurement> found = measured_;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto loads = softstring::march(model.string, model.hole, found[i].bit, operations_[i],
                                           settings_.helix);
      const bool locked = loads.lockUpDepth >= 0.0;
      const double none = std::nan("");
      if (found[i].hookLoad) found[i].hookLoad = locked ? none : loads.tension.back() + p.back();
      if (found[i].surfaceTorque) found[i].surfaceTorque = locked ? none : -loads.torque.back();
    }
    return found;
  }

  /// (computed - measured)/uncertainty.
  Vector residual(const std::vector<double>& p) const {
    const auto computed = compute(p);
    Vector r(values_);
    int k = 0;
    const auto add = [&](const std::optional<double>& value, const std::optional<double>& wanted,
                         double uncertainty) {
      if (wanted) r[k++] = std::isfinite(*value) ? (*value - *wanted) / uncertainty : lockedUp;
    };
    for (std::size_t i = 0; i < computed.size(); ++i) {
      add(computed[i].hookLoad, measured_[i].hookLoad, settings_.hookLoadUncertainty);
      add(computed[i].surfaceTorque, measured_[i].surfaceTorque, settings_.torqueUncertainty);
    }
    return r;
  }

  /// dr/dp by central differences, one column for each entry of `which`.
  Matrix jacobian(const std::vector<double>& p, const std::vector<std::size_t>& which) const {
    Matrix J(values_, static_cast<Eigen::Index>(which.size()));
    for (std::size_t j = 0; j < which.size(); ++j) {
      const double h = isWeight(which[j]) ? weightStep : frictionStep;
      auto ahead = p, behind = p;
      ahead[which[j]] += h;
      behind[which[j]] = std::max(0.0, behind[which[j]] - h);
      J.col(static_cast<Eigen::Index>(j)) =
          (residual(ahead) - residual(behind)) / (ahead[which[j]] - behind[which[j]]);
    }
    return J;
  }

 private:
  Scene scene_;
  const softstring::TorqueDragSettings& settings_;
  const std::vector<Measurement>& measured_;
  std::vector<softstring::Operation> operations_;
  std::vector<Fitted> unknowns_;
  std::vector<double> all_;
  int values_ = 0;
};

/// Bounds by a change of variables: mu = sin^2 x, block weight = (x scale)^2.
struct Search : Eigen::DenseFunctor<double> {
  Search(const Model& model, std::vector<std::size_t> which, double scale)
      : DenseFunctor(static_cast<int>(which.size()), model.values()),
        model_(model),
        which_(std::move(which)),
        scale_(scale) {}

  std::vector<double> at(const Vector& x) const {
    auto p = model_.deckValues();
    for (std::size_t j = 0; j < which_.size(); ++j) {
      const double one = x[static_cast<Eigen::Index>(j)];
      p[which_[j]] =
          model_.isWeight(which_[j]) ? std::pow(one, 2) * scale_ : std::pow(std::sin(one), 2);
    }
    return p;
  }
  Vector start() const {
    Vector x(static_cast<Eigen::Index>(which_.size()));
    for (std::size_t j = 0; j < which_.size(); ++j) {
      const double p = model_.deckValues()[which_[j]];
      x[static_cast<Eigen::Index>(j)] =
          model_.isWeight(which_[j])
              ? std::sqrt(std::max(p / scale_, 0.01))
              : std::asin(std::sqrt(p > 0.0 && p < 1.0 ? p : startingFriction));
    }
    return x;
  }
  int operator()(const Vector& x, Vector& r) const {
    r = model_.residual(at(x));
    return 0;
  }
  /// dr/dx = dr/dp dp/dx
  int df(const Vector& x, Matrix& J) const {
    J = model_.jacobian(at(x), which_);
    for (std::size_t j = 0; j < which_.size(); ++j) {
      const auto i = static_cast<Eigen::Index>(j);
      J.col(i) *= model_.isWeight(which_[j]) ? 2.0 * x[i] * scale_ : std::sin(2.0 * x[i]);
    }
    return 0;
  }

  const Model& model_;
  std::vector<std::size_t> which_;
  double scale_;
};

/// Unknowns that affect some measurement.
std::vector<std::size_t> seen(const Model& model) {
  std::vector<std::size_t> all(model.unknowns().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const Matrix J = model.jacobian(model.deckValues(), all);
  std::vector<std::size_t> found;
  for (const auto i : all)
    if (J.col(static_cast<Eigen::Index>(i)).norm() > 0.0) found.push_back(i);
  return found;
}

void requireDetermined(const Model& model, const std::vector<std::size_t>& which, Matrix J,
                       const std::string& file) {
  for (Eigen::Index j = 0; j < J.cols(); ++j) J.col(j).normalize();
  const auto svd =
      linalg::singularValues(J, linalg::SingularVectors::None, linalg::SingularVectors::Thin);
  if (svd.values.minCoeff() > dependent) return;
  const Vector mixed = svd.V.rightCols<1>();
  std::vector<std::string> names;
  for (std::size_t j = 0; j < which.size(); ++j)
    if (std::abs(mixed[static_cast<Eigen::Index>(j)]) > 0.1)
      names.push_back(model.unknowns()[which[j]].name);
  throw DeckError(file + ": the measurements cannot distinguish " + join(names, " from ") +
                  ". Measure at more depths, or with \"Rotate off bottom\" too.");
}

double rms(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::sqrt(Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()))
                       .squaredNorm() /
                   static_cast<double>(values.size()));
}

}  // namespace

Calibration calibrate(const Scene& scene, const softstring::TorqueDragSettings& settings,
                      const std::vector<Measurement>& measured) {
  const Model model(scene, settings, measured);
  const auto which = seen(model);
  const int freedom = model.values() - static_cast<int>(which.size());
  const std::string file = settings.measured.value_or("");
  if (freedom < 1)
    throw DeckError(file + ": " + std::to_string(model.values()) +
                    " measured values do not suffice for " + std::to_string(which.size()) +
                    " unknowns. Give at least one more than unknowns.");

  // the block weight is scaled by the largest hook load
  double scale = 1.0;
  for (const auto& one : measured) scale = std::max(scale, std::abs(one.hookLoad.value_or(0.0)));
  Search search(model, which, scale);
  Vector x = search.start();
  Eigen::LevenbergMarquardt<Search> solver(search);
  const auto status = solver.minimize(x);
  if (status == Eigen::LevenbergMarquardtSpace::ImproperInputParameters ||
      status == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation)
    throw ConvergenceError(file + ": the fit of friction to the measurements did not converge.");

  const auto p = search.at(x);
  requireDetermined(model, which, model.jacobian(p, which), file);
  Calibration done;
  std::vector<std::size_t> inside;
  for (const auto i : which) {
    Fitted one = model.unknowns()[i];
    one.value = p[i];
    one.uncertainty = std::nan("");
    one.atBound = model.isWeight(i) ? one.value < nearBound * scale
                                    : one.value < nearBound || one.value > 1.0 - nearBound;
    if (!one.atBound) inside.push_back(i);
    done.fitted.push_back(one);
  }
  const Vector r = model.residual(p);
  if (!inside.empty()) {
    const Matrix J = model.jacobian(p, inside);
    const int left = model.values() - sizeOf(inside);
    const Vector variances =
        linalg::inverseOf(J.transpose() * J).diagonal() * r.squaredNorm() / left;
    const double t = boost::math::quantile(boost::math::students_t(left), 0.5 + 0.5 * confidence);
    Eigen::Index next = 0;
    for (Fitted& one : done.fitted)
      if (!one.atBound) one.uncertainty = t * std::sqrt(variances[next++]);
  }
  done.scatter = std::sqrt(r.squaredNorm() / freedom);
  done.measured = measured;
  done.computed = model.compute(p);
  std::vector<double> hook, torque;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i].hookLoad) hook.push_back(*done.computed[i].hookLoad - *measured[i].hookLoad);
    if (measured[i].surfaceTorque)
      torque.push_back(*done.computed[i].surfaceTorque - *measured[i].surfaceTorque);
  }
  done.hookLoadMisfit = rms(hook);
  done.torqueMisfit = rms(torque);
  return done;
}

std::vector<BroomRow> broomstick(const Scene& scene,
                                 const softstring::TorqueDragSettings& settings) {
  SoftModel model = softModel(scene);
  const auto operations = softOperations(scene, settings);
  std::vector<BroomRow> rows;
  for (const double friction : settings.broomstick) {
    model.hole.friction = [friction](double /*s*/) { return friction; };
    for (const double bit : settings.depths)
      for (const auto& operation : operations) {
        const auto loads =
            softstring::march(model.string, model.hole, bit, operation, settings.helix);
        const bool locked = loads.lockUpDepth >= 0.0;
        rows.push_back({bit, friction, operation.name,
                        locked ? std::nan("") : loads.tension.back() + settings.blockWeight,
                        locked ? std::nan("") : -loads.torque.back()});
      }
  }
  return rows;
}

}  // namespace tooljoint::drillstring
