// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Distances between two histories of the same nodes: eps_t and eps_n, (45) and (46) of Nguyen et
/// al. 2020, and the vibration error, which does not divide by the static offset.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace tooljoint::study {

/// View of displacements over time, samples x nodes x components, row-major, not owned. Errors use
/// the first components: for a string the three translations, the lateral ones first.
struct HistoryView {
  const double* time = nullptr;          ///< samples [s]
  const double* displacement = nullptr;  ///< samples x nodes x components [m, rad]
  std::size_t samples = 0;
  std::size_t nodes = 0;
  std::size_t components = 6;
  std::size_t judged = 3;     ///< number of components in eps_t and eps_n
  std::size_t vibrating = 2;  ///< number of components whose motion is the vibration

  double at(std::size_t sample, std::size_t node, std::size_t component) const {
    return displacement[(sample * nodes + node) * components + component];
  }
  /// Length of the vibrating components of a node.
  double radius(std::size_t sample, std::size_t node) const;
};

/// Compared times, both ends included (to 1e-9 s).
struct Window {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

/// An error at each time, or at each node.
struct ErrorProfile {
  std::vector<double>
      at;  ///< time [s], or node (0-based); omitted if no component could be judged there
  std::vector<double> value;  ///< relative error there
  double max() const;         ///< 0 if nothing could be judged
  double mean() const;
};

/// A component with a smaller reference norm is not judged [m].
constexpr double negligibleNorm = 1e-12;

/// eps_t(t_i) = mean over the judged components c of sqrt(sum_n (c - c_ref)^2) / sqrt(sum_n
/// c_ref^2), (45). All functions throw Error(Internal) if the histories have different nodes or
/// different times inside the window, or the window holds no sample.
ErrorProfile errorOverTime(const HistoryView& history, const HistoryView& reference,
                           const Window& window = {});

/// eps_n(s_n) = mean over the components of sqrt(sum_i (c - c_ref)^2) / sqrt(sum_i c_ref^2), (46).
ErrorProfile errorOverNodes(const HistoryView& history, const HistoryView& reference,
                            const Window& window = {});

/// vibration error = sqrt(sum |x - x_ref|^2) / sqrt(sum |x_ref - x_static|^2) over all nodes and
/// samples of the window, with the vibrating components x (u and v of a string) and the static
/// displacements of the reference, nodes x components. Error(Internal) if the reference does not
/// move in these components.
double vibrationError(const HistoryView& history, const HistoryView& reference,
                      const std::vector<double>& staticReference, const Window& window = {});

}  // namespace tooljoint::study
