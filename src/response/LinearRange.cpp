// SPDX-License-Identifier: BSD-3-Clause
#include "response/LinearRange.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::response {

namespace {

/// Number of instants in a period at which the laws are evaluated.
constexpr int phases = 16;

/// A point law, and its tangents at rest.
class Linearised {
 public:
  Linearised(const model::PointSet& set, const model::SecondOrderModel& model, double t)
      : law_(*set.law), t_(t), all_(at(law_.size())) {
    std::iota(all_.begin(), all_.end(), 0);
    d_ = set.offset + set.rows * model.initialDisplacement;
    v_ = Vector::Zero(d_.size());
    f_ = now_ = v_;
    dfdd_ = dfdv_ = Vector::Zero(d_.size() * law_.width());
    law_.evaluateWithTangent(t, all_, d_.data(), v_.data(), f_.data(), dfdd_.data(), dfdv_.data());
  }

  /// Force minus that of the tangents, for a change of position and a velocity.
  Vector beside(const Vector& moved, const Vector& velocity) {
    const Vector d = d_ + moved;
    now_.setZero();
    law_.evaluate(t_, all_, d.data(), velocity.data(), now_.data());
    Vector out = now_ - f_;
    const int w = law_.width();
    for (int i = 0; i < out.size(); ++i)
      for (int k = 0; k < w; ++k) {
        const int column = i / w * w + k;
        out[i] -= dfdd_[i * w + k] * moved[column] + dfdv_[i * w + k] * velocity[column];
      }
    return out;
  }

 private:
  const model::PointLaw& law_;
  double t_;
  std::vector<int> all_;
  Vector d_, v_, f_, now_, dfdd_, dfdv_;
};

}  // namespace

Departure departure(const model::SecondOrderModel& model, double t, double omega,
                    const ComplexVector& y, const ComplexVector& load) {
  Departure worst;
  const double size = load.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return worst;
  for (const auto& set : model.points) {
    if (model::stateful(*set.law) != nullptr) continue;
    Linearised law(set, model, t);
    const Sparse transposed = set.rows.transpose();
    const ComplexVector rows = set.rows.cast<Complex>() * y;
    for (int k = 0; k < phases; ++k) {
      const Complex turn = std::polar(1.0, constants::twoPi * k / phases);
      const Vector beside =
          law.beside((turn * rows).real(), (Complex(0.0, omega) * turn * rows).real());
      const double part = (transposed * beside).cwiseAbs().maxCoeff() / size;
      if (part > worst.part) worst = {part, set.name};
    }
  }
  return worst;
}

}  // namespace tooljoint::response
