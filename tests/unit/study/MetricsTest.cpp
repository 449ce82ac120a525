// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// eps_t, eps_n and vibration error on histories small enough for hand calculation.
#include "study/Metrics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "common/Error.hpp"

namespace MetricsTest {

using namespace tooljoint;

/// Two nodes with three components at two times; the second node is held in u.
struct TwoNodes {
  std::vector<double> time{0.0, 1.0};
  std::vector<double> reference{3.0, 1.0, 2.0, 0.0, 1.0, 2.0, 4.0, 1.0, 2.0, 0.0, 1.0, 2.0};
  study::HistoryView view(const std::vector<double>& d) const {
    return {time.data(), d.data(), 2, 2, 3};
  }
};

TEST(Metrics, AHistoryHasNoErrorAgainstItself) {
  const TwoNodes h;
  EXPECT_EQ(study::errorOverTime(h.view(h.reference), h.view(h.reference)).max(), 0.0);
  EXPECT_EQ(study::errorOverNodes(h.view(h.reference), h.view(h.reference)).max(), 0.0);
}

TEST(Metrics, ErrorOverTimeIsTheMeanOfTheComponents) {
  const TwoNodes h;
  auto changed = h.reference;
  changed[0] += 0.3;  // u of node 1 at t = 0: |du|/|u| = 0.3/3
  const auto error = study::errorOverTime(h.view(changed), h.view(h.reference));
  ASSERT_EQ(error.value.size(), 2u);
  EXPECT_NEAR(error.value[0], 0.1 / 3.0, 1e-15);
  EXPECT_EQ(error.value[1], 0.0);
}

TEST(Metrics, AComponentThatNeverMovesIsLeftOut) {
  const TwoNodes h;
  auto changed = h.reference;
  changed[4] += 0.1;  // v of node 2 at t = 0; its u is always zero and is ignored: the mean is over
                      // v and w
  const auto error = study::errorOverNodes(h.view(changed), h.view(h.reference));
  ASSERT_EQ(error.value.size(), 2u);
  EXPECT_NEAR(error.value[1], 0.1 / std::sqrt(2.0) / 2.0, 1e-15);
}

TEST(Metrics, VibrationErrorDoesNotDivideByTheStaticOffset) {
  const TwoNodes h;
  const std::vector<double> still{3.0, 1.0, 2.0, 0.0, 1.0, 2.0};
  auto changed = h.reference;
  changed[6] += 0.5;  // the reference moves by 1 in u of node 1, from 3 to 4
  EXPECT_NEAR(study::vibrationError(h.view(changed), h.view(h.reference), still), 0.5, 1e-15);
  EXPECT_NEAR(study::vibrationError(h.view(changed), h.view(h.reference), still, {1.0, 1.0}), 0.5,
              1e-15);
}

TEST(Metrics, AMotionOfOneComponentIsJudgedByThatOne) {
  const std::vector<double> time{0.0, 1.0}, reference{1.0, 2.0}, changed{1.0, 2.5};
  const auto view = [&](const std::vector<double>& d) {
    return study::HistoryView{time.data(), d.data(), 2, 1, 1, 1, 1};
  };
  EXPECT_NEAR(study::errorOverTime(view(changed), view(reference)).max(), 0.25, 1e-15);
  EXPECT_NEAR(study::errorOverNodes(view(changed), view(reference)).max(), 0.5 / std::sqrt(5.0),
              1e-15);
  EXPECT_NEAR(study::vibrationError(view(changed), view(reference), {1.0}), 0.5, 1e-15);
  const study::HistoryView three{time.data(), reference.data(), 2, 1,
                                 1};  // says it has three components to judge
  EXPECT_THROW(study::errorOverTime(three, three), Error);
}

TEST(Metrics, TheVibrationIsWhatTheHistorySays) {
  const TwoNodes h;
  const std::vector<double> still{3.0, 1.0, 2.0, 0.0, 1.0, 2.0};
  auto changed = h.reference;
  changed[8] += 0.5;  // w of node 1
  EXPECT_EQ(study::vibrationError(h.view(changed), h.view(h.reference), still), 0.0);
  const auto all = [&](const std::vector<double>& d) {
    return study::HistoryView{h.time.data(), d.data(), 2, 2, 3, 3, 3};
  };
  EXPECT_NEAR(study::vibrationError(all(changed), all(h.reference), still), 0.5, 1e-15);
  EXPECT_NEAR(all(h.reference).radius(1, 0), std::sqrt(21.0), 1e-15);
  EXPECT_THROW(study::vibrationError(all(changed), h.view(h.reference), still), Error);
}

TEST(Metrics, DifferentHistoriesAreRefused) {
  const TwoNodes h;
  const study::HistoryView shorter{h.time.data(), h.reference.data(), 1, 2, 3};
  EXPECT_THROW(study::errorOverTime(shorter, h.view(h.reference)), Error);
  EXPECT_THROW(study::errorOverTime(h.view(h.reference), h.view(h.reference), {5.0, 6.0}), Error);
}

}  // namespace MetricsTest
