// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Distances between two histories of the same nodes: eps_t and eps_n, (45) and (46) of Nguyen et
/// al. 2020, and the error of the vibration alone, which does not divide by the static offset.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace tooljoint::study {

/// Displacements over time, samples x nodes x components, row-major, seen but not owned. The
/// components in front are those that errors count: of a string the three translations, the
/// lateral ones first.
struct HistoryView {
  const double* time = nullptr;          ///< samples [s]
  const double* displacement = nullptr;  ///< samples x nodes x components [m, rad]
  std::size_t samples = 0;
  std::size_t nodes = 0;
  std::size_t components = 6;
  std::size_t judged = 3;     ///< components that eps_t and eps_n count
  std::size_t vibrating = 2;  ///< components whose motion is the vibration

  double at(std::size_t sample, std::size_t node, std::size_t component) const {
    return displacement[(sample * nodes + node) * components + component];
  }
  /// Length of the vibrating components of a node.
  double radius(std::size_t sample, std::size_t node) const;
};

/// Times compared, both ends included (to 1e-9 s).
struct Window {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

/// An error at each time, or at each node.
struct ErrorProfile {
  std::vector<double>
      at;  ///< time [s], or node (0-based); those where no component could be judged are left out
  std::vector<double> value;  ///< relative error there
  double max() const;         ///< 0 when nothing could be judged
  double mean() const;
};

/// A component whose reference norm is below this is not judged [m].
constexpr double negligibleNorm = 1e-12;

/// eps_t(t_i) = mean over the judged components c of sqrt(sum_n (c - c_ref)^2) / sqrt(sum_n
/// c_ref^2), (45). All functions throw Error(Internal) when the histories have other nodes or other
/// times inside the window, or the window holds no sample.
ErrorProfile errorOverTime(const HistoryView& history, const HistoryView& reference,
                           const Window& window = {});

/// eps_n(s_n) = mean over the components of sqrt(sum_i (c - c_ref)^2) / sqrt(sum_i c_ref^2), (46).
ErrorProfile errorOverNodes(const HistoryView& history, const HistoryView& reference,
                            const Window& window = {});

/// vibration error = sqrt(sum |x - x_ref|^2) / sqrt(sum |x_ref - x_static|^2) over all nodes and
/// samples of the window, x the vibrating components (u and v of a string), with the static
/// displacements of the reference, nodes x components. Error(Internal) when the reference does not
/// move in them.
double vibrationError(const HistoryView& history, const HistoryView& reference,
                      const std::vector<double>& staticReference, const Window& window = {});

}  // namespace tooljoint::study
