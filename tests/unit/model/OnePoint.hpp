// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Forces and tangents of a law of one point, for its tests.
#pragma once

#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::model::testing {

inline const std::vector<int> thePoint{0};

/// Forces of one point with its states.
inline std::vector<double> forces(const PointLaw& law, double t, const std::vector<double>& d,
                                  const std::vector<double>& v, const std::vector<double>& x) {
  std::vector<double> f(d.size()), g(d.size() + 1);
  stateful(law)->forces(t, thePoint, d.data(), v.data(), x.data(), f.data(), g.data());
  return f;
}

/// df/dd and df/dv against central differences of this step, within a relative error.
inline void expectTangents(const PointLaw& law, const std::vector<double>& d,
                           const std::vector<double>& v, const std::vector<double>& x, double step,
                           double accuracy) {
  const auto w = d.size();
  const auto& with = *stateful(law);
  std::vector<double> f(w), g(w), fd(w * w), fv(w * w), fx(w), gd(w), gv(w), gx(1);
  with.forcesWithTangents(0.3, thePoint, d.data(), v.data(), x.data(), f.data(), g.data(),
                          {fd.data(), fv.data(), fx.data(), gd.data(), gv.data(), gx.data()});
  for (std::size_t j = 0; j < w; ++j) {
    auto dp = d, dm = d, vp = v, vm = v;
    dp[j] += step, dm[j] -= step, vp[j] += step, vm[j] -= step;
    const auto byD = std::make_pair(forces(law, 0.3, dp, v, x), forces(law, 0.3, dm, v, x)),
               byV = std::make_pair(forces(law, 0.3, d, vp, x), forces(law, 0.3, d, vm, x));
    for (std::size_t i = 0; i < w; ++i) {
      const double dd = (byD.first[i] - byD.second[i]) / (2 * step),
                   dv = (byV.first[i] - byV.second[i]) / (2 * step);
      EXPECT_NEAR(fd[i * w + j], dd, accuracy * (1 + std::abs(dd))) << i << j;
      EXPECT_NEAR(fv[i * w + j], dv, accuracy * (1 + std::abs(dv))) << i << j;
    }
  }
}

}  // namespace tooljoint::model::testing
