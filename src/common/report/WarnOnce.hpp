// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tooljoint::log {

/// During its lifetime, a warning that differs from an earlier one only in numbers is counted, not
/// printed. At its end each such kind is printed again with its count, also in warnings(). For many
/// runs of one deck.
class WarnOnce {
 public:
  WarnOnce();
  ~WarnOnce();
  WarnOnce(const WarnOnce&) = delete;
  WarnOnce& operator=(const WarnOnce&) = delete;
};

}  // namespace tooljoint::log
