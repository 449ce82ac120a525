// SPDX-License-Identifier: BSD-3-Clause
// A mud model outside of the library: one file, compiled by itself, named in decks as Mud/Model.
#include <tooljoint/substructures/mud/MudModel.hpp>

using namespace tooljoint;

/// Mud at rest that carries cuttings outside the string: buoyancy alone, of a denser mud outside.
struct Cuttings : mud::MudModel {
  double inside, outside;  // densities [kg/m3]
  Cuttings(const Teuchos::ParameterList& list, const mud::MudProperties& fluid)
      : inside(fluid.density), outside(fluid.density + list.get<double>("Cuttings Density")) {}

  mud::ElementContribution element(const beam::Section& section, double, double length,
                                   const Vector3& gravity) const override {
    const double inner = constants::pi * section.innerRadius() * section.innerRadius();
    const double outer = constants::pi * section.outerRadius() * section.outerRadius();
    mud::ElementContribution out;
    out.load = beam::distributedLoad((inside * inner - outside * outer) * gravity, length);
    return out;
  }
};

const bool registered = mud::addMudModel<Cuttings>(
    "Cuttings", "buoyancy alone, with cuttings in the annulus.",
    deck::ListSpec("Cuttings", "Mud at rest with cuttings outside the string.")
        .real("Cuttings Density", "kg/m3", 0.0, deck::Range::nonNegative(),
              "Added to the density of the mud outside the string."));
