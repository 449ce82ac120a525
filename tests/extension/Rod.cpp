// SPDX-License-Identifier: BSD-3-Clause
// An element outside of the library: one file, compiled by itself, named in decks.
#include <tooljoint/substructures/beam/Element.hpp>

using namespace tooljoint;

/// Stretches and twists, does not bend: dofs w and theta_z alone. Linear shape functions; a factor
/// on E S makes it a spring (a shock absorber) of the same mass.
struct Rod : beam::Element {
  double factor;
  Rod(const Teuchos::ParameterList& list, const beam::Section& section, double length)
      : Element(section, length), factor(list.get<double>("Axial Factor")) {}

  /// `axial` [same, other; other, same] on w and `torsional` on theta_z.
  static beam::Matrix12 onBoth(double axial, double torsional, double same, double other) {
    beam::Matrix12 m = beam::Matrix12::Zero();
    for (const auto& [dof, value] : {std::pair{2, axial}, std::pair{5, torsional}}) {
      m(dof, dof) = m(dof + 6, dof + 6) = same * value;
      m(dof, dof + 6) = m(dof + 6, dof) = other * value;
    }
    return m;
  }
  beam::DofMap dofs() const override { return {false, false, true, false, false, true}; }
  beam::Matrix12 stiffness() const override {
    return onBoth(factor * section().axialRigidity() / length(),
                  section().torsionalRigidity() / length(), 1.0, -1.0);
  }
  beam::Matrix12 mass() const override {
    return onBoth(section().massPerLength() * length(),
                  section().density() * section().polar() * length(), 1.0 / 3.0, 1.0 / 6.0);
  }
  beam::Matrix12 gyroscopic() const override { return beam::Matrix12::Zero(); }
  beam::Vector12 spinLoad() const override {
    return onEnds(5, section().density() * section().polar());
  }
  beam::Matrix12 geometricAxial() const override { return beam::Matrix12::Zero(); }
  beam::Matrix12 geometricTorque() const override { return beam::Matrix12::Zero(); }
  beam::Vector12 distributedLoad(const Vector3& q) const override { return onEnds(2, q.z()); }

 private:
  beam::Vector12 onEnds(int dof, double perLength) const {
    beam::Vector12 f = beam::Vector12::Zero();
    f(dof) = f(dof + 6) = 0.5 * perLength * length();
    return f;
  }
};

const bool registered = beam::addElement<Rod>(
    "Rod", "axial and torsional rod that does not bend.",
    deck::ListSpec("Rod", "A rod.")
        .real("Axial Factor", "", 1.0, deck::Range::positive(), "Factor on E S."));
