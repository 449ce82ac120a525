// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/Timoshenko.hpp"

namespace tooljoint::beam {

Matrix12 Timoshenko::stiffness() const { return beam::stiffness(section(), length()); }
Matrix12 Timoshenko::mass() const { return beam::mass(section(), length()); }
Matrix12 Timoshenko::gyroscopic() const { return beam::gyroscopic(section(), length()); }
Vector12 Timoshenko::spinLoad() const { return beam::spinLoad(section(), length()); }
Matrix12 Timoshenko::geometricAxial() const { return beam::geometricAxial(length()); }
Matrix12 Timoshenko::geometricTorque() const { return beam::geometricTorque(length()); }
Vector12 Timoshenko::distributedLoad(const Vector3& q) const {
  return beam::distributedLoad(q, length());
}

namespace {

const bool timoshenkoRegistered = addElement<Timoshenko>(
    "Timoshenko",
    "two-node beam with cubic shape functions and shear deformation; without it for sections "
    "that do not deform in shear (Nguyen et al. 2020, section 2.1).");

}  // namespace
}  // namespace tooljoint::beam
