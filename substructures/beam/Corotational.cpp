// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/Corotational.hpp"

#include <Eigen/Geometry>

#include "substructures/beam/Rotation.hpp"

namespace tooljoint::beam {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;
using Row12 = Eigen::Matrix<double, 1, 12>;

/// Kinematics of the chord frame, everything in element axes: q_i is the turned y axis of node i, q
/// their mean.
struct ChordFrame {
  double length;
  Vector3 q1;
  Vector3 q2;
  double qy;        ///< y component of the mean axis (its x component is zero by construction)
  double eta;       ///< q_z / q_y
  Matrix3x12 spin;  ///< G': spin of the frame from the nodal motions
};

/// z' = w x z gives w_x, w_y from the lateral motion of the ends; q' - w x q has no x component
/// gives w_z.
ChordFrame chordFrame(double length, const Vector3& q1, const Vector3& q2) {
  ChordFrame f{length, q1, q2, 0.5 * (q1.y() + q2.y()), 0.0, Matrix3x12::Zero()};
  f.eta = 0.5 * (q1.z() + q2.z()) / f.qy;
  f.spin(0, 1) = 1.0 / length;
  f.spin(0, 7) = -1.0 / length;
  f.spin(1, 0) = -1.0 / length;
  f.spin(1, 6) = 1.0 / length;
  // w_z = eta w_y + sum_i (q_iy omega_iz - q_iz omega_iy) / (2 q_y)
  f.spin.row(2) = f.eta * f.spin.row(1);
  f.spin(2, 4) -= 0.5 * q1.z() / f.qy;
  f.spin(2, 5) += 0.5 * q1.y() / f.qy;
  f.spin(2, 10) -= 0.5 * q2.z() / f.qy;
  f.spin(2, 11) += 0.5 * q2.y() / f.qy;
  return f;
}

/// P: spins of the nodes relative to the frame, 6 x 12.
Matrix6x12 relativeSpin(const ChordFrame& f) {
  Matrix6x12 p;
  p.topRows<3>() = -f.spin;
  p.bottomRows<3>() = -f.spin;
  p.block<3, 3>(0, 3) += Matrix3::Identity();
  p.block<3, 3>(3, 9) += Matrix3::Identity();
  return p;
}

/// d(G m) for a constant moment m in element axes, as a 12 x 12 matrix on the nodal motions in
/// element axes.
Matrix12 spinTransposeDerivative(const ChordFrame& f, const Matrix6x12& relative,
                                 const Vector3& m) {
  const double l = f.length;
  Row12 dl = Row12::Zero();
  dl(2) = -1.0;
  dl(8) = 1.0;
  // dq_i = relative spin_i x q_i
  const Matrix3x12 dq1 = -skew(f.q1) * relative.topRows<3>();
  const Matrix3x12 dq2 = -skew(f.q2) * relative.bottomRows<3>();
  const Row12 dqy = 0.5 * (dq1.row(1) + dq2.row(1));
  const Row12 deta = (0.5 * (dq1.row(2) + dq2.row(2)) - f.eta * dqy) / f.qy;
  Matrix12 d = Matrix12::Zero();
  // rows of G m: -+(m_y + eta m_z)/l and +-m_x/l at the ends
  const Row12 u = -m.z() / l * deta + (m.y() + f.eta * m.z()) / (l * l) * dl;
  const Row12 v = -m.x() / (l * l) * dl;
  d.row(0) = u;
  d.row(6) = -u;
  d.row(1) = v;
  d.row(7) = -v;
  // and (-q_iz, q_iy) m_z/(2 q_y) at the rotations
  const double half = 0.5 * m.z() / f.qy;
  d.row(4) = -half * (dq1.row(2) - f.q1.z() / f.qy * dqy);
  d.row(5) = half * (dq1.row(1) - f.q1.y() / f.qy * dqy);
  d.row(10) = -half * (dq2.row(2) - f.q2.z() / f.qy * dqy);
  d.row(11) = half * (dq2.row(1) - f.q2.y() / f.qy * dqy);
  return d;
}

/// blkdiag(E, E, E, E).
Matrix12 toGlobal(const Matrix3& e) {
  Matrix12 turn = Matrix12::Zero();
  for (int b = 0; b < 4; ++b) turn.block<3, 3>(3 * b, 3 * b) = e;
  return turn;
}

}  // namespace

CorotationalElement::CorotationalElement(const Matrix12& stiffness, double initialLength)
    : initialLength_(initialLength),
      axialStiffness_(stiffness(8, 8)),
      torsionalStiffness_(stiffness(11, 11)) {
  rotational_ << stiffness.block<3, 3>(3, 3), stiffness.block<3, 3>(3, 9),
      stiffness.block<3, 3>(9, 3), stiffness.block<3, 3>(9, 9);
}

CorotationalElement::CorotationalElement(const Matrix12& stiffness, double initialLength,
                                         const Matrix3& element0, const Matrix3& node1,
                                         const Matrix3& node2)
    : CorotationalElement(stiffness, initialLength) {
  attach1_ = node1.transpose() * element0;
  attach2_ = node2.transpose() * element0;
}

CorotationalResponse CorotationalElement::evaluate(const ElementPose& pose,
                                                   bool withTangent) const {
  const Matrix3 t1 = pose.triad1 * attach1_;
  const Matrix3 t2 = pose.triad2 * attach2_;
  CorotationalResponse out;
  out.frame = elementTriad(pose.position1, pose.position2, t1, t2);
  const Matrix3& e = out.frame;
  out.length = (pose.position2 - pose.position1).norm();
  out.rotation1 = rotationLogarithm(e.transpose() * t1);
  out.rotation2 = rotationLogarithm(e.transpose() * t2);

  // local forces: N = k_ww (l - l0), m = K_theta theta
  out.axialForce = axialStiffness_ * (out.length - initialLength_);
  out.torque = torsionalStiffness_ * (out.rotation2.z() - out.rotation1.z());
  Vector6 theta;
  theta << out.rotation1, out.rotation2;
  const Vector6 moment = rotational_ * theta;

  // moments that work on spins: T_s^-T m
  const Matrix3 inverse1 = rotationVectorFromSpin(out.rotation1);
  const Matrix3 inverse2 = rotationVectorFromSpin(out.rotation2);
  Vector6 spinMoment;
  spinMoment << inverse1.transpose() * moment.head<3>(), inverse2.transpose() * moment.tail<3>();

  // f = E (r' N + P' m) with r the elongation
  const ChordFrame frame =
      chordFrame(out.length, e.transpose() * t1.col(1), e.transpose() * t2.col(1));
  const Matrix6x12 relative = relativeSpin(frame);
  Vector12 local = relative.transpose() * spinMoment;
  local(2) -= out.axialForce;
  local(8) += out.axialForce;
  const Matrix12 turn = toGlobal(e);
  out.force = turn * local;
  out.tangent.setZero();
  if (!withTangent) return out;

  // material part: N and m change
  Matrix6 inverse = Matrix6::Zero();
  inverse.topLeftCorner<3, 3>() = inverse1;
  inverse.bottomRightCorner<3, 3>() = inverse2;
  Matrix6 curvature = Matrix6::Zero();
  curvature.topLeftCorner<3, 3>() =
      inverseSpinTransposeDerivative(out.rotation1, moment.head<3>()) * inverse1;
  curvature.bottomRightCorner<3, 3>() =
      inverseSpinTransposeDerivative(out.rotation2, moment.tail<3>()) * inverse2;
  const Matrix6 material = inverse.transpose() * rotational_ * inverse + curvature;
  Matrix12 tangent = relative.transpose() * material * relative;
  tangent(2, 2) += axialStiffness_;
  tangent(8, 8) += axialStiffness_;
  tangent(2, 8) -= axialStiffness_;
  tangent(8, 2) -= axialStiffness_;
  // the frame turns: w x (r' N + P' m), and P' changes
  for (int b = 0; b < 4; ++b)
    tangent.middleRows<3>(3 * b) -= skew(local.segment<3>(3 * b)) * frame.spin;
  const Vector3 total = spinMoment.head<3>() + spinMoment.tail<3>();
  tangent -= spinTransposeDerivative(frame, relative, total);

  out.tangent = turn * tangent * turn.transpose();
  return out;
}

}  // namespace tooljoint::beam
