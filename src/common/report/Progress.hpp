// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Progress of long computations on standard error, on rank 0: a bar on a terminal, otherwise a
/// line every few seconds.
#pragma once

#include <chrono>
#include <string>

namespace tooljoint {

class Progress {
 public:
  /// Shortest time between two lines of a log.
  static constexpr std::chrono::milliseconds logInterval{5000};

  /// `title` is printed before the bar; update() counts from `begin` to `end` (simulated time,
  /// number of parts, ...). A log gets at most one line per `interval`.
  Progress(std::string title, double end, double begin = 0.0,
           std::chrono::milliseconds interval = logInterval);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every step of a time loop: prints at most ten times a second on a terminal.
  void update(double now, const std::string& suffix = "");

  /// True when update() would print something; otherwise a caller need not compose a suffix.
  bool due() const;

  /// Rate of the quantity counted by update(), per second of wall time since the construction.
  double rate(double now) const;

  /// Ends the bar at 100 %. If it is destroyed before (by an error or an interrupt), the bar is not
  /// changed.
  void finish();

 private:
  double fraction(double now) const;
  void drawBar(double fraction, const std::string& suffix);
  double elapsed() const;
  /// ", 37 s left" at the rate so far; empty at the beginning and at the end.
  std::string left(double done) const;

  std::string title_;
  double begin_ = 0.0;
  double end_ = 1.0;
  bool speaks_ = false;    ///< rank 0 and not quiet
  bool terminal_ = false;  ///< standard error is a terminal
  bool finished_ = false;
  bool drawn_ = false;                  ///< an unfinished bar is on the terminal
  std::chrono::milliseconds interval_;  ///< between two prints
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point lastPrint_;
};

}  // namespace tooljoint
