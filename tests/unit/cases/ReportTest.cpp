// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Messages of a run on vibration above the cut-off of its parts.
#include "cases/run/Report.hpp"

#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>

namespace ReportTest {

using namespace tooljoint;

TEST(Report, WarnsOfVibrationAboveTheCutOffAlsoBesideAnEstimate) {
  transient::TransientReport report;
  for (const auto& [energy, alone, beside] :
       {std::tuple{0.005, false, false}, {0.02, true, false}, {0.32, true, true}}) {
    report.cutOffEnergy = energy;
    EXPECT_EQ(!cases::remarks(report).empty(), alone) << energy;
    const auto found = cases::remarksBesideEstimate(report);
    EXPECT_EQ(!found.empty(), beside) << energy;
    if (!beside) continue;
    EXPECT_NE(found.front().find("32 %"), std::string::npos) << found.front();
  }
}

TEST(Report, WarnsOfModesThatAPartDoesNotHave) {
  transient::TransientReport report;
  for (const auto& [energy, warned] : {std::pair{0.005, false}, {0.03, true}}) {
    report.missingEnergy = energy;
    const auto found = cases::remarks(report);
    ASSERT_EQ(!found.empty(), warned) << energy;
    if (!warned) continue;
    EXPECT_NE(found.front().find("3 %"), std::string::npos) << found.front();
  }
}

}  // namespace ReportTest
