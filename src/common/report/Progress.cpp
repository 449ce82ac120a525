// SPDX-License-Identifier: BSD-3-Clause
#include "common/report/Progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"

namespace tooljoint {
namespace {

constexpr int barWidth = 30;
constexpr std::chrono::milliseconds redraw(100);

}  // namespace

Progress::Progress(std::string title, double end, double begin)
    : title_(std::move(title)),
      begin_(begin),
      end_(end),
      speaks_(parallel::rank() == 0 && !log::quiet()),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

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

bool Progress::due(double now) const {
  if (!speaks_ || finished_) return false;
  if (terminal_) return !drawn_ || std::chrono::steady_clock::now() - lastDraw_ >= redraw;
  return static_cast<int>(10.0 * fraction(now) + 1e-9) > lastTenth_;
}

void Progress::update(double now, const std::string& suffix) {
  if (!due(now)) return;
  const double done = fraction(now);
  if (terminal_) {
    drawBar(done, suffix);
    return;
  }
  lastTenth_ = static_cast<int>(10.0 * done + 1e-9);
  std::fprintf(stderr, "%s: %3d %% (%.1f s)%s%s\n", title_.c_str(), 10 * lastTenth_, elapsed(),
               suffix.empty() ? "" : " ", suffix.c_str());
  std::fflush(stderr);
}

void Progress::drawBar(double done, const std::string& suffix) {
  const int filled = static_cast<int>(std::lround(done * barWidth));
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(barWidth - filled), '.');
  const double soFar = elapsed();
  std::string left;
  if (done > 0.01 && done < 1.0)
    left = ", " + std::to_string(std::lround(soFar * (1.0 - done) / done)) + " s left";
  std::fprintf(stderr, "\r\033[K%s [%s] %3d %% (%.1f s%s)%s%s", title_.c_str(), bar.c_str(),
               static_cast<int>(100.0 * done), soFar, left.c_str(), suffix.empty() ? "" : " ",
               suffix.c_str());
  std::fflush(stderr);
  drawn_ = true;
  lastDraw_ = std::chrono::steady_clock::now();
}

void Progress::finish() {
  if (finished_) return;
  if (speaks_) {
    if (terminal_) {
      drawBar(1.0, "");
      std::fputc('\n', stderr);
    } else {
      update(end_);
    }
  }
  finished_ = true;
}

}  // namespace tooljoint
