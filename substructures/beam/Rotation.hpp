// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Finite rotations by rotation vectors: exponential, logarithm and the maps between spins and
/// rotation vectors.
#pragma once

#include "common/Types.hpp"

namespace tooljoint::beam {

/// v^ with v^ w = v x w.
Matrix3 skew(const Vector3& v);

/// exp(theta^): the rotation by |theta| about theta (Rodrigues).
Matrix3 rotationExponential(const Vector3& theta);

/// The rotation vector of R, |theta| <= pi, by way of the unit quaternion.
Vector3 rotationLogarithm(const Matrix3& rotation);

/// T_s(theta): left (spatial) spin d omega = T_s d theta of R = exp(theta^).
Matrix3 spinFromRotationVector(const Vector3& theta);

/// T_s(theta)^-1: d theta = T_s^-1 d omega; |theta| < 2 pi.
Matrix3 rotationVectorFromSpin(const Vector3& theta);

/// d(T_s(theta)^-T v)/d theta for constant v.
Matrix3 inverseSpinTransposeDerivative(const Vector3& theta, const Vector3& v);

}  // namespace tooljoint::beam
