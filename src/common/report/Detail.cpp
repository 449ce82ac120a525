// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Detail.hpp"

#include "common/report/Log.hpp"

namespace tooljoint::log {

namespace {

bool verbose_ = false;

}  // namespace

void setVerbose(bool verbose) { verbose_ = verbose; }
bool verbose() { return verbose_; }

void detail(const std::string& line) {
  if (verbose_) info(line);
}

}  // namespace tooljoint::log
