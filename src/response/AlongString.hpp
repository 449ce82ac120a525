// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Harmonic response along a string: distances to the wall and bending moments.
#pragma once

#include <array>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "common/Message.hpp"
#include "response/RotatingCase.hpp"

namespace tooljoint::response {

/// An extreme value of a response, at a node or an element.
struct Extreme {
  std::size_t place = 0;  ///< index among the nodes or elements of AlongString
  double value = 0.0;     ///< remaining distance [m], or amplitude of the bending moment [N m]
  std::array<std::complex<double>, 2> axes;  ///< Re(axes exp(i omega t)) [m] or [N m]
  double estimate = 0.0;                     ///< of the error of `value`

  template <class Archive>
  void serialize(Archive& archive) {
    archive(place, value, axes, estimate);
  }
};

/// Distances and moments of one response.
struct StringResponse {
  Vector margins;  ///< remaining distance to the wall of nodes that are open at rest [m]
  Vector moments;  ///< amplitudes of the bending moments of the elements, relative to rest [N m]
  std::optional<Extreme> margin, moment;  ///< the smallest and the largest value; none without
                                          ///< nodes or elements

  template <class Archive>
  void serialize(Archive& archive) {
    archive(margins, moments, margin, moment);
  }
};

/// The ellipses Re((x, y) exp(i omega t)) of pairs of sums in one model.
class Ellipses {
 public:
  /// Terms of nodes that are not in the model are zero.
  Ellipses(const model::SecondOrderModel& model, const std::vector<cases::NodeSums>& sums);

  /// x and y, places x 2.
  Eigen::MatrixXcd axes(const Eigen::VectorXcd& q) const;
  /// The coefficients of x and y of one place, dofs x 2.
  Eigen::MatrixXcd coefficients(std::size_t place) const;
  /// The larger semi-axes, a^2 = (|x|^2 + |y|^2 + |x^2 + y^2|)/2.
  static Vector reach(const Eigen::MatrixXcd& axes);

 private:
  std::array<Sparse, 2> rows_;  ///< places x dofs
};

/// The nodes and elements of a case, and their evaluation in its models.
class AlongString {
 public:
  struct Node {
    std::int64_t number = 0;
    double depth = 0.0;  ///< [m]; 0 if the nodes have none
    double gap = 0.0;    ///< at rest [m]
  };

  AlongString(const RotatingCase& rotating, const std::string& axis);

  bool empty() const { return nodes_.empty() && elements_.empty(); }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<cases::BendingPlace>& elements() const { return elements_; }

  /// Evaluates a response of the solved model.
  StringResponse of(const Eigen::VectorXcd& q) const;
  /// Evaluates a response of the full model: both extremes at the positions of `reduced`, and the
  /// profiles.
  StringResponse ofFull(const Eigen::VectorXcd& q, const StringResponse& reduced) const;

  /// Coefficients of the two axes of the extremes in any model of the case, dofs x 2 for each
  /// existing margin and moment.
  Eigen::MatrixXcd outputs(const model::SecondOrderModel& model,
                           const StringResponse& response) const;
  /// Writes the errors of these outputs into the estimates of the extremes.
  static void takeEstimates(const Eigen::VectorXd& errors, StringResponse& response);

 private:
  StringResponse evaluate(const Ellipses& gaps, const Ellipses& moments,
                          const Eigen::VectorXcd& q) const;

  const RotatingCase& rotating_;
  std::vector<Node> nodes_;
  std::vector<cases::BendingPlace> elements_;
  std::vector<cases::NodeSums> gapSums_, momentSums_;
  Ellipses gaps_, moments_;
};

}  // namespace tooljoint::response
