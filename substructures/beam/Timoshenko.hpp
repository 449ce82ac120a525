// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The beam element of the string: Timoshenko, or Euler-Bernoulli for a section without shear
/// deformation.
#pragma once

#include "substructures/beam/Element.hpp"

namespace tooljoint::beam {

/// The closed forms of BeamMatrices.hpp. An element that differs in a few matrices derives from
/// this one.
class Timoshenko : public Element {
 public:
  using Element::Element;

  Matrix12 stiffness() const override;
  Matrix12 mass() const override;
  Matrix12 gyroscopic() const override;
  Vector12 spinLoad() const override;
  Matrix12 geometricAxial() const override;
  Matrix12 geometricTorque() const override;
  Vector12 distributedLoad(const Vector3& q) const override;
};

}  // namespace tooljoint::beam
