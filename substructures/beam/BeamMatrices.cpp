// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/BeamMatrices.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace tooljoint::beam {
namespace {

using Block4 = Eigen::Matrix4d;
using Row4 = Eigen::RowVector4d;

/// Bending dofs of a plane in the order (displacement, slope) of node 1, then node 2; slope = sign
/// * rotation.
struct Plane {
  std::array<int, 4> dof;
  std::array<double, 4> sign;
};
constexpr Plane kU{{0, 4, 6, 10}, {1.0, 1.0, 1.0, 1.0}};   // u' = +theta_y
constexpr Plane kV{{1, 3, 7, 9}, {1.0, -1.0, 1.0, -1.0}};  // v' = -theta_x

/// Adds a 4x4 block that acts between the (displacement, slope) dofs of two planes.
void addBlock(const Plane& row, const Plane& column, const Block4& block, Matrix12& out) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      out(row.dof[i], column.dof[j]) += row.sign[i] * column.sign[j] * block(i, j);
}

/// Adds factor * length/6 [2 1; 1 2] on one dof of both ends.
void addLinear(int dof, double factor, Matrix12& out) {
  out(dof, dof) += 2.0 * factor / 6.0;
  out(dof + 6, dof + 6) += 2.0 * factor / 6.0;
  out(dof, dof + 6) += factor / 6.0;
  out(dof + 6, dof) += factor / 6.0;
}

/// Hermite cubics of (displacement, slope) at z = x l, differentiated `order` times with respect to
/// z.
Row4 hermite(double x, double l, int order) {
  switch (order) {
    case 0:
      return {1 - 3 * x * x + 2 * x * x * x, l * (x - 2 * x * x + x * x * x),
              3 * x * x - 2 * x * x * x, l * (x * x * x - x * x)};
    case 1:
      return {(6 * x * x - 6 * x) / l, 1 - 4 * x + 3 * x * x, (6 * x - 6 * x * x) / l,
              3 * x * x - 2 * x};
    default:
      return {(12 * x - 6) / (l * l), (6 * x - 4) / l, (6 - 12 * x) / (l * l), (6 * x - 2) / l};
  }
}

/// int_0^l h^(a)' h^(b) dz by four Gauss points: exact for the products of cubics.
Block4 hermiteIntegral(int a, int b, double l) {
  const double inner = std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(6.0 / 5.0));
  const double outer = std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(6.0 / 5.0));
  const double innerWeight = (18.0 + std::sqrt(30.0)) / 36.0;
  const double outerWeight = (18.0 - std::sqrt(30.0)) / 36.0;
  const std::array<double, 4> point{-outer, -inner, inner, outer};
  const std::array<double, 4> weight{outerWeight, innerWeight, innerWeight, outerWeight};
  Block4 sum = Block4::Zero();
  for (int g = 0; g < 4; ++g) {
    const double x = 0.5 * (1.0 + point[g]);
    sum += 0.5 * l * weight[g] * hermite(x, l, a).transpose() * hermite(x, l, b);
  }
  return sum;
}

/// The same integral in both planes.
Matrix12 lateralIntegral(int a, int b, double l) {
  const Block4 block = hermiteIntegral(a, b, l);
  Matrix12 out = Matrix12::Zero();
  addBlock(kU, kU, block, out);
  addBlock(kV, kV, block, out);
  return out;
}

/// E I/(l^3 (1+phi)) [12 6l -12 6l; (4+phi) l^2 -6l (2-phi) l^2; 12 -6l; (4+phi) l^2].
Block4 bending(double rigidity, double phi, double l) {
  Block4 k;
  k << 12, 6 * l, -12, 6 * l,                               //
      6 * l, (4 + phi) * l * l, -6 * l, (2 - phi) * l * l,  //
      -12, -6 * l, 12, -6 * l,                              //
      6 * l, (2 - phi) * l * l, -6 * l, (4 + phi) * l * l;
  return rigidity / (l * l * l * (1.0 + phi)) * k;
}

}  // namespace

Matrix12 stiffness(const Section& section, double length) {
  const double e = section.youngModulus();
  Matrix12 k = Matrix12::Zero();
  addBlock(kU, kU,
           bending(e * section.inertiaY(), section.shearFactor(section.inertiaY(), length), length),
           k);
  addBlock(kV, kV,
           bending(e * section.inertiaX(), section.shearFactor(section.inertiaX(), length), length),
           k);
  const std::array<int, 2> dofs{2, 5};
  const std::array<double, 2> springs{section.axialRigidity() / length,
                                      section.torsionalRigidity() / length};
  for (int i = 0; i < 2; ++i) {
    k(dofs[i], dofs[i]) = k(dofs[i] + 6, dofs[i] + 6) = springs[i];
    k(dofs[i], dofs[i] + 6) = k(dofs[i] + 6, dofs[i]) = -springs[i];
  }
  return k;
}

Matrix12 mass(const Section& section, double length) {
  const double rho = section.density();
  // rho S int N'N + rho I int N_z'N_z in each plane
  const Block4 translation = rho * section.area() * hermiteIntegral(0, 0, length);
  const Block4 rotation = rho * hermiteIntegral(1, 1, length);
  Matrix12 m = Matrix12::Zero();
  addBlock(kU, kU, translation + section.inertiaY() * rotation, m);
  addBlock(kV, kV, translation + section.inertiaX() * rotation, m);
  addLinear(2, rho * section.area() * length, m);
  addLinear(5, rho * section.polar() * length, m);
  return m;
}

Matrix12 gyroscopic(const Section& section, double length) {
  // rho I_p int theta_y dtheta_x/dt with theta_y = u', theta_x = -v'
  Matrix12 c = Matrix12::Zero();
  addBlock(kU, kV, -section.density() * section.polar() * hermiteIntegral(1, 1, length), c);
  return c;
}

Vector12 spinLoad(const Section& section, double length) {
  Vector12 f = Vector12::Zero();
  f(5) = f(11) = section.density() * section.polar() * length / 2.0;
  return f;
}

Matrix12 geometricAxial(double length) { return lateralIntegral(1, 1, length); }

Matrix12 geometricTorque(double length) {
  // int (du'' v' - dv'' u') dz
  const Block4 block = hermiteIntegral(2, 1, length);
  Matrix12 k = Matrix12::Zero();
  addBlock(kU, kV, block, k);
  addBlock(kV, kU, -block, k);
  return k;
}

Matrix12 lateralMass(double length) { return lateralIntegral(0, 0, length); }
Matrix12 lateralSlope(double length) { return lateralIntegral(0, 1, length); }
Matrix12 lateralSlopeSlope(double length) { return lateralIntegral(1, 1, length); }

Matrix12 axialMass(double length) {
  Matrix12 m = Matrix12::Zero();
  addLinear(2, length, m);
  return m;
}

Vector12 distributedLoad(const Vector3& q, double length) {
  const double half = length / 2.0;
  const double moment = length * length / 12.0;
  Vector12 f = Vector12::Zero();
  f.segment<3>(0) = half * q;
  f.segment<3>(6) = half * q;
  f(4) = moment * q.x();  // theta_y = u'
  f(10) = -moment * q.x();
  f(3) = -moment * q.y();  // theta_x = -v'
  f(9) = moment * q.y();
  return f;
}

Matrix12 rotation12(const Matrix3& element, const Matrix3& node1, const Matrix3& node2) {
  const Matrix3 r1 = element.transpose() * node1;
  const Matrix3 r2 = element.transpose() * node2;
  Matrix12 r = Matrix12::Zero();
  r.block<3, 3>(0, 0) = r.block<3, 3>(3, 3) = r1;
  r.block<3, 3>(6, 6) = r.block<3, 3>(9, 9) = r2;
  return r;
}

Matrix12 slopeRotation(const Matrix12& rotation, const Vector3& axis1, const Vector3& axis2) {
  Matrix12 r = rotation;
  r.middleCols<3>(3) -= rotation.middleCols<3>(3) * axis1 * axis1.transpose();
  r.middleCols<3>(9) -= rotation.middleCols<3>(9) * axis2 * axis2.transpose();
  return r;
}

Matrix3 elementTriad(const Vector3& x1, const Vector3& x2, const Matrix3& node1,
                     const Matrix3& node2) {
  const Vector3 chord = x2 - x1;
  const double length = chord.norm();
  if (!(length > 0.0)) throw ModelError("A beam element has no length: its two nodes coincide.");
  Matrix3 e;
  e.col(2) = chord / length;
  const Vector3 x = (0.5 * (node1.col(1) + node2.col(1))).cross(e.col(2));
  if (!(x.norm() > 1e-8))
    throw ModelError(
        "A beam element lies along the mean y axis of its nodes: its frame is undefined.");
  e.col(0) = x.normalized();
  e.col(1) = e.col(2).cross(e.col(0));
  return e;
}

}  // namespace tooljoint::beam
