// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Material and cross section of a beam element. Header only.
#pragma once

#include <cmath>
#include <optional>

#include "common/Constants.hpp"
#include "common/Error.hpp"

namespace tooljoint::beam {

/// Isotropic elastic material.
struct Material {
  double density = 7850.0;                             ///< rho [kg/m3]
  double youngModulus = 2.1e11;                        ///< E [Pa]
  double poissonRatio = 0.3;                           ///< nu
  std::optional<double> yieldStrength = std::nullopt;  ///< [Pa]

  /// G = E / (2 (1 + nu)) [Pa].
  double shearModulus() const { return youngModulus / (2.0 * (1.0 + poissonRatio)); }
};

/// Shear area over area of the Timoshenko correction (Nguyen et al. 2020, section 2.1).
constexpr double kShearCoefficient = 0.9;

/// Cross section of a beam: hollow circular, or general (principal axes x, y) without shear
/// deformation.
///
/// inertiaX() resists bending in the v-z plane (rotation theta_x), inertiaY() bending in the u-z
/// plane (theta_y).
class Section {
 public:
  Section() = default;

  /// Hollow circle of radii R_e > R_i >= 0 [m]; ModelError otherwise. Shear deformation is on.
  static Section hollow(double outerRadius, double innerRadius, const Material& material) {
    if (!(innerRadius >= 0.0) || !(outerRadius > innerRadius))
      throw ModelError("A hollow circular section needs 0 <= inner radius < outer radius.");
    using constants::pi;
    const double outer2 = outerRadius * outerRadius;
    const double inner2 = innerRadius * innerRadius;
    Section s;
    s.material_ = material;
    s.outerRadius_ = outerRadius;
    s.innerRadius_ = innerRadius;
    s.area_ = pi * (outer2 - inner2);                              // S = pi (R_e^2 - R_i^2)
    s.inertiaX_ = pi * (outer2 * outer2 - inner2 * inner2) / 4.0;  // I = pi (R_e^4 - R_i^4) / 4
    s.inertiaY_ = s.inertiaX_;
    s.torsion_ = 2.0 * s.inertiaX_;
    s.shear_ = true;
    return s;
  }

  /// General section: area [m2], second moments I_x, I_y [m4] and torsion constant J [m4], all
  /// positive; ModelError otherwise. Shear deformation is off; the radii (mud, contact) are zero
  /// unless given.
  static Section general(double area, double inertiaX, double inertiaY, double torsion,
                         const Material& material, double outerRadius = 0.0,
                         double innerRadius = 0.0) {
    if (!(area > 0.0) || !(inertiaX > 0.0) || !(inertiaY > 0.0) || !(torsion > 0.0))
      throw ModelError("A general section needs a positive area, I_x, I_y and J.");
    Section s;
    s.material_ = material;
    s.outerRadius_ = outerRadius;
    s.innerRadius_ = innerRadius;
    s.area_ = area;
    s.inertiaX_ = inertiaX;
    s.inertiaY_ = inertiaY;
    s.torsion_ = torsion;
    s.shear_ = false;
    return s;
  }

  /// The same section with shear deformation switched off (Euler-Bernoulli).
  Section withoutShear() const {
    Section s = *this;
    s.shear_ = false;
    return s;
  }

  const Material& material() const { return material_; }
  double outerRadius() const { return outerRadius_; }     ///< R_e [m]
  double innerRadius() const { return innerRadius_; }     ///< R_i [m]
  double area() const { return area_; }                   ///< S [m2]
  double inertiaX() const { return inertiaX_; }           ///< about x [m4]
  double inertiaY() const { return inertiaY_; }           ///< about y [m4]
  double polar() const { return inertiaX_ + inertiaY_; }  ///< I_p, of the spinning mass [m4]
  double torsion() const { return torsion_; }  ///< J of G J theta_z' [m4]; equals I_p for a circle
  bool shearDeformable() const { return shear_; }
  double youngModulus() const { return material_.youngModulus; }
  double shearModulus() const { return material_.shearModulus(); }
  double density() const { return material_.density; }
  double axialRigidity() const { return material_.youngModulus * area_; }           ///< E S [N]
  double torsionalRigidity() const { return material_.shearModulus() * torsion_; }  ///< G J [N m2]
  double massPerLength() const { return material_.density * area_; }  ///< rho S [kg/m]

  /// phi = 12 E I / (G S beta l^2) for bending with second moment `inertia` in an element of length
  /// l; 0 without shear.
  double shearFactor(double inertia, double length) const {
    if (!shear_) return 0.0;
    return 12.0 * material_.youngModulus * inertia /
           (material_.shearModulus() * area_ * kShearCoefficient * length * length);
  }
  /// phi of a circular section.
  double shearFactor(double length) const { return shearFactor(inertiaX_, length); }

 private:
  Material material_{};
  double outerRadius_ = 0.0;
  double innerRadius_ = 0.0;
  double area_ = 0.0;
  double inertiaX_ = 0.0;
  double inertiaY_ = 0.0;
  double torsion_ = 0.0;
  bool shear_ = true;
};

}  // namespace tooljoint::beam
