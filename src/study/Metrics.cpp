// SPDX-License-Identifier: BSD-3-Clause
#include "study/Metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "common/Error.hpp"

namespace tooljoint::study {
namespace {

constexpr double timeTolerance = 1e-9;  // s

[[noreturn]] void refuse(const std::string& sentence) { throw Error(ExitCode::Internal, sentence); }

/// First sample inside the window, and one past the last.
struct Span {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t size() const { return last - first; }
};

Span span(const HistoryView& history, const Window& window) {
  const double* end = history.time + history.samples;
  const double* first = std::lower_bound(history.time, end, window.begin - timeTolerance);
  const double* last = std::upper_bound(first, end, window.end + timeTolerance);
  return {static_cast<std::size_t>(first - history.time),
          static_cast<std::size_t>(last - history.time)};
}

/// The samples of both histories inside the window, checked for equal nodes and times.
struct Pair {
  const HistoryView& history;
  const HistoryView& reference;
  Span mine;
  Span theirs;

  Pair(const HistoryView& a, const HistoryView& b, const Window& window)
      : history(a), reference(b), mine(span(a, window)), theirs(span(b, window)) {
    const bool alike = a.nodes == b.nodes && a.components == b.components && a.judged == b.judged &&
                       a.vibrating == b.vibrating;
    if (!alike || a.components < std::max(a.judged, a.vibrating)) {
      refuse("Two histories of " + std::to_string(a.nodes) + " and " + std::to_string(b.nodes) +
             " nodes cannot be compared.");
    }
    if (mine.size() == 0 || mine.size() != theirs.size()) {
      refuse("Two histories with " + std::to_string(mine.size()) + " and " +
             std::to_string(theirs.size()) + " samples inside the window cannot be compared.");
    }
    for (std::size_t i = 0; i < mine.size(); ++i) {
      if (std::abs(time(i) - b.time[theirs.first + i]) > timeTolerance) {
        refuse("Two histories with different sample times (" + std::to_string(time(i)) + " s and " +
               std::to_string(b.time[theirs.first + i]) + " s) cannot be compared.");
      }
    }
  }

  double time(std::size_t i) const { return history.time[mine.first + i]; }
  double value(std::size_t i, std::size_t n, std::size_t c) const {
    return history.at(mine.first + i, n, c);
  }
  double exact(std::size_t i, std::size_t n, std::size_t c) const {
    return reference.at(theirs.first + i, n, c);
  }
};

/// Sums of squares of one component.
struct Sums {
  double error = 0.0;
  double reference = 0.0;
};

/// Adds the mean of the judged components to a profile; nothing if none can be judged.
void addMean(ErrorProfile& profile, double at, const std::vector<Sums>& sums) {
  double total = 0.0;
  int judged = 0;
  for (const Sums& s : sums) {
    const double norm = std::sqrt(s.reference);
    if (norm < negligibleNorm) continue;
    total += std::sqrt(s.error) / norm;
    ++judged;
  }
  if (judged == 0) return;
  if (!std::isfinite(total)) refuse("A history to be compared holds numbers that are not finite.");
  profile.at.push_back(at);
  profile.value.push_back(total / judged);
}

void add(Sums& s, double value, double exact) {
  s.error += (value - exact) * (value - exact);
  s.reference += exact * exact;
}

}  // namespace

double HistoryView::radius(std::size_t sample, std::size_t node) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < vibrating; ++c) sum += at(sample, node, c) * at(sample, node, c);
  return std::sqrt(sum);
}

double ErrorProfile::max() const {
  return value.empty() ? 0.0 : *std::max_element(value.begin(), value.end());
}

double ErrorProfile::mean() const {
  return value.empty()
             ? 0.0
             : std::accumulate(value.begin(), value.end(), 0.0) / static_cast<double>(value.size());
}

ErrorProfile errorOverTime(const HistoryView& history, const HistoryView& reference,
                           const Window& window) {
  const Pair pair(history, reference, window);
  ErrorProfile profile;
  for (std::size_t i = 0; i < pair.mine.size(); ++i) {
    std::vector<Sums> sums(history.judged);
    for (std::size_t n = 0; n < history.nodes; ++n)
      for (std::size_t c = 0; c < history.judged; ++c)
        add(sums[c], pair.value(i, n, c), pair.exact(i, n, c));
    addMean(profile, pair.time(i), sums);
  }
  return profile;
}

ErrorProfile errorOverNodes(const HistoryView& history, const HistoryView& reference,
                            const Window& window) {
  const Pair pair(history, reference, window);
  ErrorProfile profile;
  for (std::size_t n = 0; n < history.nodes; ++n) {
    std::vector<Sums> sums(history.judged);
    for (std::size_t i = 0; i < pair.mine.size(); ++i)
      for (std::size_t c = 0; c < history.judged; ++c)
        add(sums[c], pair.value(i, n, c), pair.exact(i, n, c));
    addMean(profile, static_cast<double>(n), sums);
  }
  return profile;
}

double vibrationError(const HistoryView& history, const HistoryView& reference,
                      const std::vector<double>& staticReference, const Window& window) {
  const Pair pair(history, reference, window);
  if (staticReference.size() != reference.nodes * reference.components) {
    refuse("The static displacements of " + std::to_string(reference.nodes) +
           " nodes were expected, but " + std::to_string(staticReference.size()) +
           " numbers were given.");
  }
  double error = 0.0;
  double vibration = 0.0;
  for (std::size_t i = 0; i < pair.mine.size(); ++i) {
    for (std::size_t n = 0; n < reference.nodes; ++n) {
      for (std::size_t c = 0; c < history.vibrating; ++c) {
        const double exact = pair.exact(i, n, c);
        const double difference = pair.value(i, n, c) - exact;
        const double motion = exact - staticReference[n * reference.components + c];
        error += difference * difference;
        vibration += motion * motion;
      }
    }
  }
  if (!std::isfinite(error) || !std::isfinite(vibration))
    refuse("A history to be compared holds numbers that are not finite.");
  if (!(std::sqrt(vibration) > negligibleNorm))
    refuse(
        "The reference history does not vibrate in the displacements that are compared, which "
        "are the lateral ones of a string, so no vibration error can be given.");
  return std::sqrt(error / vibration);
}

}  // namespace tooljoint::study
