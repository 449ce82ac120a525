// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/ModelStates.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// act(batch, states, offset) for every batch with states and with points on this rank.
template <class Batches, class Act>
void forStates(Batches& batches, const Act& act) {
  int offset = 0;
  for (auto& batch : batches)
    if (PointStates* states = batch.states()) {
      if (!batch.everyPoint().empty()) act(batch, *states, offset);
      offset += states->size();
    }
}

}  // namespace

ModelStates::ModelStates(std::vector<PointBatch>& batches, const linalg::RankCut& cut)
    : batches_(&batches), cut_(&cut) {
  for (const auto& batch : batches)
    if (const auto* states = batch.states()) size_ += states->size();
}

void ModelStates::initial(double t, const double* q, const double* v, double* x) {
  forStates(*batches_, [&](auto& batch, PointStates& states, int offset) {
    batch.gatherAll(q, v);
    states.initial(t, batch.d(), batch.v(), x + offset);
  });
  keepOwn(x);
}

void ModelStates::bind(const double* base, double factor, const double* rate) {
  forStates(*batches_, [&](auto&, PointStates& states, int offset) {
    states.bind(base + offset, factor, rate != nullptr ? rate + offset : nullptr);
  });
}

void ModelStates::bindKnown(const double* x, double factor) {
  forStates(*batches_,
            [&](auto&, PointStates& states, int offset) { states.bindKnown(x + offset, factor); });
}

void ModelStates::rates(double* xDot) const {
  forStates(*batches_,
            [&](auto&, PointStates& states, int offset) { states.rates(xDot + offset); });
}

void ModelStates::complete(double t, const double* q, const double* v, double* x, double* xDot) {
  forStates(*batches_, [&](auto& batch, PointStates& states, int offset) {
    batch.gatherAll(q, v);
    states.complete(t, batch.everyPoint(), batch.d(), batch.v(), x + offset, xDot + offset);
  });
  keepOwn(x);
}

void ModelStates::accept(double t, const double* q, const double* v, double* x) {
  forStates(*batches_, [&](auto& batch, PointStates& states, int offset) {
    batch.gatherAll(q, v);
    states.accept(t, batch.d(), batch.v(), x + offset);
  });
  keepOwn(x);
}

void ModelStates::join(Vector& x) const {
  if (cut_->isDivided() && size_ > 0) cut_->sumAll(x.data(), at(size_));
}

void ModelStates::keepOwn(double* x) const {
  if (!cut_->isDivided()) return;
  for (const auto& batch : *batches_) {
    const PointStates* states = batch.states();
    if (states == nullptr) continue;
    auto own = batch.everyPoint().begin();
    for (int p = 0; p < states->points(); ++p, x += states->states()) {
      const bool isOwn = own != batch.everyPoint().end() && *own == p;
      if (isOwn)
        ++own;
      else
        std::fill_n(x, states->states(), 0.0);
    }
  }
}

void ModelStates::blend(const Vector& from, const Vector& to, double s, const Vector& held,
                        Vector& out) const {
  out = held;
  forStates(*batches_, [&](auto&, PointStates& states, int offset) {
    for (int i = 0; i < states.size(); ++i)
      if (states.isRated(i))
        out[offset + i] = from[offset + i] + s * (to[offset + i] - from[offset + i]);
  });
}

double ModelStates::distance(const Vector& a, const Vector& b) const {
  double square = 0;
  forStates(*batches_, [&](auto&, PointStates& states, int offset) {
    for (int i = 0; i < states.size(); ++i)
      if (states.isRated(i)) square += std::pow(a[offset + i] - b[offset + i], 2);
  });
  return std::sqrt(size_ > 0 ? cut_->sum(square) : 0.0);
}

}  // namespace tooljoint::transient
