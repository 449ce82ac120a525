// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ModelIdentity.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "common/Index.hpp"
#include "common/Sha256.hpp"
#include "model/laws/StatefulPointLaw.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {
namespace {

/// Intervals of the window; laws of time are evaluated at their ends.
constexpr int lawIntervals = 32;
/// Distance beyond its clearance to which a point is moved to evaluate its force [m], and its speed
/// there [m/s].
constexpr double probeDepth = 1e-3, probeSpeed = 0.1;

/// Digest and figures of the added data. The length precedes each array, so that different data
/// never give the same bytes.
class Summary {
 public:
  void add(double x) {
    append(&x, 1);
    note(&x, 1);
  }
  void add(std::int64_t x) { append(&x, 1); }
  void add(const std::string& text) {
    add(static_cast<std::int64_t>(text.size()));
    append(text.data(), text.size());
  }
  void add(const Vector& x) {
    add(static_cast<std::int64_t>(x.size()));
    append(x.data(), at(x.size()));
    note(x.data(), at(x.size()));
  }
  void add(const Sparse& matrix) {
    if (!matrix.isCompressed()) {
      Sparse compressed = matrix;
      compressed.makeCompressed();
      return add(compressed);
    }
    const auto entries = at(matrix.nonZeros());
    add(static_cast<std::int64_t>(matrix.cols()));
    add(static_cast<std::int64_t>(matrix.rows()));
    append(matrix.outerIndexPtr(), at(matrix.outerSize()) + 1);
    append(matrix.innerIndexPtr(), entries);
    append(matrix.valuePtr(), entries);
    note(matrix.valuePtr(), entries);
  }
  ModelIdentity identity() { return {sha256_.digest(), figures_}; }

 private:
  /// sum |x_i| and sum w_i x_i, with different weights between -1/2 and 1/2; infinite entries are
  /// left out.
  void note(const double* x, std::size_t count) {
    constexpr double golden = 0.6180339887498949;
    double size = 0, weighted = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(x[i])) continue;
      const double turns = golden * static_cast<double>(i + 1);
      size += std::abs(x[i]);
      weighted += (turns - std::floor(turns) - 0.5) * x[i];
    }
    figures_.insert(figures_.end(), {size, weighted});
  }

  template <class Value>
  void append(const Value* values, std::size_t count) {
    sha256_.add(values, count * sizeof(Value));
  }
  Sha256 sha256_;
  std::vector<double> figures_;
};

void addDofs(const model::SecondOrderModel& model, Summary& summary) {
  for (const auto& name : model.componentNames) summary.add(name);
  for (const auto& dof : model.dofs) summary.add(model::describe(dof, model.componentNames));
}

void addLaws(const model::SecondOrderModel& model, const TransientOptions& options,
             Summary& summary) {
  for (const auto& law : model.laws) {
    summary.add(law.name);
    for (int i = 0; i <= lawIntervals; ++i)
      summary.add(law.value(options.start + (options.end - options.start) * i / lawIntervals));
  }
}

/// Forces of a law, at its initial states if it has any.
class ForcesAtStart {
 public:
  ForcesAtStart(const model::PointLaw& law, double t, const Vector& d, const Vector& v)
      : law_(law), stateful_(model::stateful(law)), t_(t) {
    for (int p = 0; p < law.size(); ++p) all_.push_back(p);
    if (stateful_ == nullptr) return;
    x_.setZero(law.size() * stateful_->states());
    g_.setZero(law.size() * stateful_->rated());
    stateful_->initialState(t, d.data(), v.data(), x_.data());
  }
  const std::vector<int>& points() const { return all_; }

  void add(const Vector& d, const Vector& v, Summary& summary) {
    Vector force = Vector::Zero(d.size());
    if (stateful_ == nullptr) {
      law_.evaluate(t_, all_, d.data(), v.data(), force.data());
    } else {
      stateful_->forces(t_, all_, d.data(), v.data(), x_.data(), force.data(), g_.data());
      summary.add(x_);
      summary.add(g_);
    }
    summary.add(force);
  }

 private:
  const model::PointLaw& law_;
  const model::StatefulPointLaw* stateful_;
  double t_;
  std::vector<int> all_;
  Vector x_, g_;
};

/// Forces at the start, and with every point moved just beyond its clearance in both directions
/// along each of its coordinates.
void addPoints(const model::PointSet& set, const model::SecondOrderModel& model, double t,
               Summary& summary) {
  const auto& law = *set.law;
  const int width = law.width();
  summary.add(set.name);
  for (auto entity : set.entities) summary.add(entity);
  summary.add(set.rows);
  summary.add(set.offset);
  const Vector start = set.offset + set.rows * model.initialDisplacement;
  const Vector velocity = set.rows * model.initialVelocity;
  Vector clearance = Vector::Zero(law.size());
  ForcesAtStart forces(law, t, start, velocity);
  forces.add(start, velocity, summary);
  law.clearanceLeft(forces.points(), start.data(), clearance.data());
  summary.add(clearance);
  for (int c = 0; c < width; ++c)
    for (const double way : {1.0, -1.0}) {
      Vector d = start, v = Vector::Zero(start.size());
      for (int p = 0; p < law.size(); ++p) {
        const double gap = std::isfinite(clearance[p]) ? std::max(0.0, clearance[p]) : 0.0;
        d[p * width + c] += way * (gap + probeDepth);
        for (int k = 0; k < width; ++k) v[p * width + k] = way * probeSpeed * (k + 1);
      }
      forces.add(d, v, summary);
    }
}

/// In alphabetical order.
void addList(const Teuchos::ParameterList& list, Summary& summary) {
  std::map<std::string, std::string> values;
  for (auto it = list.begin(); it != list.end(); ++it) {
    std::ostringstream text;
    text.precision(17);
    text << list.entry(it).getAny(false);
    values[list.name(it)] = text.str();
  }
  for (const auto& [name, value] : values) {
    summary.add(name);
    summary.add(value);
  }
}

void addOptions(const TransientOptions& options, Summary& summary) {
  summary.add(options.integrator);
  for (double x : {options.start, options.end, options.step, options.sampling}) summary.add(x);
  summary.add(static_cast<std::int64_t>(options.ledger));
  const auto& registry = IntegratorRegistry::instance();
  const bool anywhere = registry.make(options.integrator, options.own)->goesOnFromAnywhere();
  summary.add(anywhere ? 0.0 : options.checkpointInterval);
  addList(withDefaults(options.own, registry.find(options.integrator).parameters), summary);
}

/// Relative change of an array that counts as rounding.
constexpr double rounding = 1e-7;

}  // namespace

ModelIdentity identityOf(const model::SecondOrderModel& model, const TransientOptions& options) {
  Summary summary;
  addDofs(model, summary);
  addLaws(model, options, summary);
  summary.add(model.mass.sparse());
  for (const auto* terms : {&model.damping, &model.stiffness}) {
    summary.add(static_cast<std::int64_t>(terms->size()));
    for (const auto& term : *terms) {
      summary.add(static_cast<std::int64_t>(term.law));
      summary.add(term.matrix.sparse());
    }
  }
  for (const auto& term : model.loads) {
    summary.add(static_cast<std::int64_t>(term.law));
    summary.add(term.vector);
  }
  for (const auto& set : model.points) addPoints(set, model, options.start, summary);
  summary.add(model.initialDisplacement);
  summary.add(model.initialVelocity);
  addOptions(options, summary);
  return summary.identity();
}

bool agree(const std::vector<double>& figures, const std::vector<double>& others) {
  if (figures.size() != others.size()) return false;
  for (std::size_t i = 0; i < figures.size(); i += 2) {
    const double allowed = rounding * std::max(figures[i], others[i]);
    if (std::abs(figures[i] - others[i]) > allowed) return false;
    if (std::abs(figures[i + 1] - others[i + 1]) > allowed) return false;
  }
  return true;
}

}  // namespace tooljoint::transient
