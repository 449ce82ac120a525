// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>
#include <utility>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"

namespace tooljoint {
namespace {

constexpr int barWidth = 30;
constexpr std::chrono::milliseconds redraw(100);
constexpr double leastShare = 0.01;  ///< finished fraction at which the remaining time is first
                                     ///< printed
constexpr double minute = 60.0;
constexpr double hour = 3600.0;

/// "37 s", "12 min", "3.4 h".
std::string duration(double seconds) {
  char text[32];
  if (seconds < 2 * minute)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 2 * hour)
    std::snprintf(text, sizeof text, "%.0f min", seconds / minute);
  else
    std::snprintf(text, sizeof text, "%.1f h", seconds / hour);
  return text;
}

}  // namespace

Progress::Progress(std::string title, double end, double begin, std::chrono::milliseconds interval)
    : title_(std::move(title)),
      begin_(begin),
      end_(end),
      speaks_(parallel::rank() == 0 && !log::quiet()),
      terminal_(isatty(STDERR_FILENO) == 1),
      interval_(terminal_ ? redraw : interval),
      start_(std::chrono::steady_clock::now()),
      lastPrint_(start_) {}

Progress::~Progress() {
  if (drawn_ && !finished_) std::fputc('\n', stderr);
}

double Progress::fraction(double now) const {
  const double span = end_ - begin_;
  if (!(span > 0.0)) return 1.0;
  const double value = (now - begin_) / span;
  return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool Progress::due() const {
  if (!speaks_ || finished_) return false;
  return (terminal_ && !drawn_) || std::chrono::steady_clock::now() - lastPrint_ >= interval_;
}

void Progress::update(double now, const std::string& suffix) {
  if (!due()) return;
  const double done = fraction(now);
  lastPrint_ = std::chrono::steady_clock::now();
  if (terminal_) {
    drawBar(done, suffix);
    return;
  }
  std::fprintf(stderr, "%s: %3d %% (%.1f s%s)%s%s\n", title_.c_str(),
               static_cast<int>(100.0 * done), elapsed(), left(done).c_str(),
               suffix.empty() ? "" : " ", suffix.c_str());
  std::fflush(stderr);
}

std::string Progress::left(double done) const {
  if (done <= leastShare || done >= 1.0) return "";
  return ", " + duration(elapsed() * (1.0 - done) / done) + " left";
}

double Progress::rate(double now) const {
  const double seconds = elapsed();
  return seconds > 0.0 ? (now - begin_) / seconds : 0.0;
}

void Progress::drawBar(double done, const std::string& suffix) {
  const int filled = static_cast<int>(std::lround(done * barWidth));
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(barWidth - filled), '.');
  std::fprintf(stderr, "\r\033[K%s [%s] %3d %% (%.1f s%s)%s%s", title_.c_str(), bar.c_str(),
               static_cast<int>(100.0 * done), elapsed(), left(done).c_str(),
               suffix.empty() ? "" : " ", suffix.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::finish() {
  if (finished_) return;
  if (speaks_ && terminal_) {
    drawBar(1.0, "");
    std::fputc('\n', stderr);
  }
  finished_ = true;
}

}  // namespace tooljoint
