// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deviation of point laws from their tangents in a harmonic response.
#pragma once

#include <string>

#include "common/Types.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::response {

/// The point set with the largest deviation of its forces from the tangents.
struct Departure {
  double part = 0.0;  ///< fraction of the largest load
  std::string set;    ///< its name; empty without point sets

  template <class Archive>
  void serialize(Archive& archive) {
    archive(part, set);
  }
};

/// max |R'(f(d, v) - f_0 - df/dd (d - d_0) - df/dv v)| over a period of the motion Re(y e^{i omega
/// t}) about the state at rest, divided by max |load|, dofs of the model. Laws with states are
/// omitted, since their states depend on the motion. \param t  of the laws [s]
Departure departure(const model::SecondOrderModel& model, double t, double omega,
                    const ComplexVector& y, const ComplexVector& load);

}  // namespace tooljoint::response
