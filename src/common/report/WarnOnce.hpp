// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tooljoint::log {

/// While it lives, a warning that differs from an earlier one in its numbers alone is counted, not
/// printed; at its end each such kind is printed again with its count, also in warnings(). Of many
/// runs of one deck.
class WarnOnce {
 public:
  WarnOnce();
  ~WarnOnce();
  WarnOnce(const WarnOnce&) = delete;
  WarnOnce& operator=(const WarnOnce&) = delete;
};

}  // namespace tooljoint::log
