// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a harmonic response does along a string: distances to the wall and bending moments.
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

/// One place of a response: a node, or an element.
struct Extreme {
  std::size_t place = 0;  ///< position among those of AlongString
  double value = 0.0;     ///< distance left [m], or amplitude of the bending moment [N m]
  std::array<std::complex<double>, 2> axes;  ///< Re(axes exp(i omega t)) [m] or [N m]
  double estimate = 0.0;                     ///< of the error of `value`

  template <class Archive>
  void serialize(Archive& archive) {
    archive(place, value, axes, estimate);
  }
};

/// Distances and moments of one response.
struct StringResponse {
  Vector margins;  ///< left to the wall by the nodes that are open at rest [m]
  Vector moments;  ///< amplitudes of the bending moments of the elements beside those at rest [N m]
  std::optional<Extreme> margin, moment;  ///< the least and the largest; none where there are none

  template <class Archive>
  void serialize(Archive& archive) {
    archive(margins, moments, margin, moment);
  }
};

/// The ellipses Re((x, y) exp(i omega t)) of pairs of sums in one model.
class Ellipses {
 public:
  /// Terms of nodes that the model does not have are zero.
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

/// The places of a case, and what they do in its models.
class AlongString {
 public:
  struct Node {
    std::int64_t number = 0;
    double depth = 0.0;  ///< [m]; 0 where the nodes have none
    double gap = 0.0;    ///< at rest [m]
  };

  AlongString(const RotatingCase& rotating, const std::string& axis);

  bool empty() const { return nodes_.empty() && elements_.empty(); }
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<cases::BendingPlace>& elements() const { return elements_; }

  /// Of a response of the model that is solved.
  StringResponse of(const Eigen::VectorXcd& q) const;
  /// Both extremes of `reduced` at their places in a response of the full model, with the profiles.
  StringResponse ofFull(const Eigen::VectorXcd& q, const StringResponse& reduced) const;

  /// Coefficients of the two axes of the extremes in any model of the case, dofs x 2 for each of
  /// margin and moment that is there.
  Eigen::MatrixXcd outputs(const model::SecondOrderModel& model,
                           const StringResponse& response) const;
  /// Takes the errors of these outputs into the estimates of the extremes.
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
