// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Progress of long work on standard error, on rank 0: a bar on a terminal, a line every few
/// seconds elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace tooljoint {

class Progress {
 public:
  /// Least time between two lines of a log.
  static constexpr std::chrono::milliseconds logInterval{5000};

  /// `title` stands in front of the bar; update() counts from `begin` to `end` (simulated time,
  /// number of parts, ...). A log gets a line at most every `interval`.
  Progress(std::string title, double end, double begin = 0.0,
           std::chrono::milliseconds interval = logInterval);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every step of a time loop: prints at most ten times a second on a terminal.
  void update(double now, const std::string& suffix = "");

  /// True when update() would print something: lets a caller skip the work of composing a suffix.
  bool due() const;

  /// What update() counts, per second of wall time since the construction.
  double rate(double now) const;

  /// Ends the bar at 100 %. Destroyed before that (an error, an interrupt), it leaves the bar as it
  /// is.
  void finish();

 private:
  double fraction(double now) const;
  void drawBar(double fraction, const std::string& suffix);
  double elapsed() const;
  /// ", 37 s left" at the rate so far; empty at the begin and at the end.
  std::string left(double done) const;

  std::string title_;
  double begin_ = 0.0;
  double end_ = 1.0;
  bool speaks_ = false;    ///< rank 0 and not quiet
  bool terminal_ = false;  ///< standard error is a terminal
  bool finished_ = false;
  bool drawn_ = false;                  ///< an unfinished bar stands on the terminal
  std::chrono::milliseconds interval_;  ///< between two prints
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point lastPrint_;
};

}  // namespace tooljoint
