// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Progress of long work on standard error: a bar on a terminal, one line per 10 % elsewhere; rank
/// 0 only.
#pragma once

#include <chrono>
#include <string>

namespace tooljoint {

class Progress {
 public:
  /// `title` stands in front of the bar; update() counts from `begin` to `end` (simulated time,
  /// number of parts, ...).
  Progress(std::string title, double end, double begin = 0.0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every step of a time loop: prints at most ten times a second on a terminal,
  /// and once per 10 % elsewhere.
  void update(double now, const std::string& suffix = "");

  /// True when update() would print something: lets a caller skip the work of composing a suffix.
  bool due(double now) const;

  /// Ends the bar at 100 %. A Progress destroyed before that (an error, an interrupt) just ends its
  /// line where it stands.
  void finish();

 private:
  double fraction(double now) const;
  void drawBar(double fraction, const std::string& suffix);
  double elapsed() const;

  std::string title_;
  double begin_ = 0.0;
  double end_ = 1.0;
  bool speaks_ = false;    ///< rank 0 and not quiet
  bool terminal_ = false;  ///< standard error is a terminal
  bool finished_ = false;
  bool drawn_ = false;  ///< an unfinished bar stands on the terminal
  int lastTenth_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point lastDraw_;
};

}  // namespace tooljoint
