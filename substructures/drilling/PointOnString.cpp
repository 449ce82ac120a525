// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drilling/PointOnString.hpp"

#include <numeric>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::drilling {
namespace {

class LawInFrame final : public model::StatefulPointLaw {
 public:
  LawInFrame(std::vector<StringCoordinate> coordinates, std::shared_ptr<const model::PointLaw> law,
             std::vector<RateChannel> recorded)
      : coordinates_(std::move(coordinates)),
        law_(std::move(law)),
        with_(model::stateful(*law_)),
        recorded_(std::move(recorded)) {
    if (with_ == nullptr || law_->size() != 1 ||
        law_->width() != static_cast<int>(coordinates_.size()))
      throw Error(ExitCode::Internal,
                  "A law on the string needs states and one point with a coordinate for each dof.");
    for (auto* array : {&y_, &yDot_, &force_}) array->assign(coordinates_.size(), 0.0);
    rates_.assign(at(with_->rated()), 0.0);
  }
  int size() const override { return 1; }
  int width() const override { return law_->width(); }
  int states() const override { return with_->states(); }
  int rated() const override { return with_->rated(); }
  bool hasWalls() const override { return law_->hasWalls(); }

  void initialState(double t, const double* d, const double* v, double* x) const override {
    place(t, d, v);
    with_->initialState(t, y_.data(), yDot_.data(), x);
  }
  void accept(double t, const double* d, const double* v, double* x) const override {
    place(t, d, v);
    with_->accept(t, y_.data(), yDot_.data(), x);
  }
  void forces(double t, const std::vector<int>& points, const double* d, const double* v,
              const double* x, double* f, double* g) const override {
    place(t, d, v);
    with_->forces(t, points, y_.data(), yDot_.data(), x, f, g);
  }
  void forcesWithTangents(double t, const std::vector<int>& points, const double* d,
                          const double* v, const double* x, double* f, double* g,
                          const model::StateTangents& tangents) const override {
    place(t, d, v);
    with_->forcesWithTangents(t, points, y_.data(), yDot_.data(), x, f, g, tangents);
  }

  std::optional<std::complex<double>> heldFactor(double t, std::complex<double> s, int point,
                                                 const double* d, const double* v) const override {
    place(t, d, v);
    return with_->heldFactor(t, s, point, y_.data(), yDot_.data());
  }

  Power powers(double t, const std::vector<int>& points, const double* d, const double* v,
               const double* x, const double* xDot) const override {
    if (points.empty()) return {};
    place(t, d, v);
    Power sum = with_->powers(t, points, y_.data(), yDot_.data(), x, xDot);
    with_->forces(t, points, y_.data(), yDot_.data(), x, force_.data(), rates_.data());
    // f v = f y' - f s'
    for (std::size_t i = 0; i < coordinates_.size(); ++i)
      sum.drive -= force_[i] * (yDot_[i] - v[i]);
    return sum;
  }

  std::vector<model::Channel> channels() const override {
    std::vector<model::Channel> all;
    for (const auto& one : coordinates_) all.push_back(one.channel);
    for (const auto& one : recorded_) all.push_back(one.channel);
    return all;
  }
  void recordState(double t, const double* d, const double* v, const double* x,
                   double* out) const override {
    static const std::vector<int> theOne{0};
    forces(t, theOne, d, v, x, force_.data(), rates_.data());
    for (std::size_t i = 0; i < coordinates_.size(); ++i)
      *out++ = coordinates_[i].sign * force_[i] + coordinates_[i].offset;
    for (const auto& one : recorded_) *out++ = rates_[at(one.state)] + one.offset;
  }
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override {
    return std::make_shared<LawInFrame>(coordinates_, law_->subset(points), recorded_);
  }

 private:
  void place(double t, const double* d, const double* v) const {
    for (std::size_t i = 0; i < coordinates_.size(); ++i) {
      const auto frame = coordinates_[i].frame ? coordinates_[i].frame(t) : FramePosition{};
      y_[i] = d[i] + frame.position;
      yDot_[i] = v[i] + frame.velocity;
    }
  }

  std::vector<StringCoordinate> coordinates_;
  std::shared_ptr<const model::PointLaw> law_;
  const model::StatefulPointLaw* with_;
  std::vector<RateChannel> recorded_;
  // values of one evaluation
  mutable std::vector<double> y_, yDot_, force_, rates_;
};

}  // namespace

PointOnString onString(const std::string& name, int node,
                       const std::vector<StringCoordinate>& coordinates,
                       std::shared_ptr<const model::PointLaw> law,
                       const std::vector<RateChannel>& rates) {
  PointOnString point{name, node, {}, nullptr};
  for (const auto& one : coordinates) point.components.push_back(one.component);
  point.law = std::make_shared<LawInFrame>(coordinates, std::move(law), rates);
  return point;
}

}  // namespace tooljoint::drilling
