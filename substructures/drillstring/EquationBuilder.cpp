// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/EquationBuilder.hpp"

#include <algorithm>

#include "common/report/EvaluationCounters.hpp"

namespace tooljoint::drillstring {

namespace {

using beam::Matrix12;
using beam::Vector12;

constexpr const char* kRayleigh = "Rayleigh damping";

/// What one element contributes is formed in its own frame and turned to the nodal frames by R' X
/// R.
class Builder {
 public:
  explicit Builder(const EquationInput& input) : in_(input) {
    model_.nodes = input.string.nodeCount();
    model_.held = input.held;
    model_.state = Vector::Zero(kNodeDofs * model_.nodes);
    model_.mass.reserve(input.string.elements.size());
  }

  StringModel build() {
    for (int e = 0; e < in_.string.elementCount(); ++e) addElement(e);
    addNodalLoads();
    const auto zero = [](const ElementTerm& term) {
      return std::all_of(term.matrices.begin(), term.matrices.end(),
                         [](const Matrix12& m) { return m.isZero(0.0); });
    };
    model_.damping.erase(std::remove_if(model_.damping.begin(), model_.damping.end(), zero),
                         model_.damping.end());
    model_.stiffness.erase(std::remove_if(model_.stiffness.begin(), model_.stiffness.end(), zero),
                           model_.stiffness.end());
    return std::move(model_);
  }

 private:
  void addElement(int e) {
    const auto i = static_cast<std::size_t>(e);
    const auto& section = in_.string.elements[i].section;
    const double length = in_.path.initialLength[i];
    const Matrix3& triad = in_.path.elementFrame[i];
    const Matrix12 turn = beam::rotation12(triad, in_.path.frame[i], in_.path.frame[i + 1]);
    const auto nodal = [&turn](const Matrix12& matrix) -> Matrix12 {
      return turn.transpose() * matrix * turn;
    };

    const Matrix12 structuralMass = nodal(beam::mass(section, length));
    const Matrix12 stiffness = prestressedStiffness(e, turn);
    model_.mass.push_back(structuralMass);
    add(model_.stiffness, "structure", "1", e, stiffness);
    if (in_.damping.present())
      add(model_.damping, kRayleigh, "1", e,
          in_.damping.massCoefficient * structuralMass +
              in_.damping.stiffnessCoefficient * stiffness);

    // weight rho S g along global Z (down); the mud adds its buoyancy
    const Vector3 gravity = triad.transpose() * Vector3(0.0, 0.0, in_.loads.gravity);
    if (in_.loads.gravity != 0.0)
      addLoad("weight", "1", e,
              turn.transpose() * beam::distributedLoad(section.massPerLength() * gravity, length));
    if (in_.rotary.present()) addRotation(e, section, length, nodal, turn);
    if (in_.mud != nullptr) addMud(e, section, length, gravity, nodal, turn);
  }

  /// K_a + F K_gF + T K_gT, or the corotational tangent of the path state, in nodal frames.
  Matrix12 prestressedStiffness(int e, const Matrix12& turn) const {
    const auto i = static_cast<std::size_t>(e);
    if (!in_.path.tangent.empty()) {
      count("geometric stiffness");
      return in_.path.tangent[i];
    }
    const double length = in_.path.initialLength[i];
    Matrix12 stiffness = beam::stiffness(in_.string.elements[i].section, length);
    const double force = in_.path.axialForce(e);
    const double torque = in_.path.torque(e);
    if (force != 0.0 || torque != 0.0) {
      count("geometric stiffness");
      stiffness += force * beam::geometricAxial(length) + torque * beam::geometricTorque(length);
    }
    return turn.transpose() * stiffness * turn;
  }

  /// Omega (C_ac' - C_ac) D', dOmega/dt C_ac' D on the left, -dOmega/dt F_thetaz on the right.
  template <class Nodal>
  void addRotation(int e, const beam::Section& section, double length, const Nodal& nodal,
                   const Matrix12& turn) {
    const Matrix12 coupling = nodal(beam::gyroscopic(section, length));
    add(model_.damping, "gyroscopic", "Omega", e, coupling.transpose() - coupling);
    add(model_.stiffness, "spin-up", "dOmega/dt", e, coupling.transpose());
    addLoad("spin-up", "dOmega/dt", e, -(turn.transpose() * beam::spinLoad(section, length)));
    count("gyroscopic matrices");
  }

  template <class Nodal>
  void addMud(int e, const beam::Section& section, double length, const Vector3& gravity,
              const Nodal& nodal, const Matrix12& turn) {
    const auto i = static_cast<std::size_t>(e);
    const double bore =
        in_.well.boreRadius(0.5 * (in_.string.nodes[i].s + in_.string.nodes[i + 1].s));
    const auto mud = in_.mud->element(section, bore, length, gravity);
    model_.mass.back() += nodal(mud.mass);
    for (const auto& term : mud.damping)
      if (term.law == "1" || in_.rotary.present())
        add(model_.damping, term.name, term.law, e, nodal(term.matrix));
    for (const auto& term : mud.stiffness)
      if (term.law == "1" || in_.rotary.present())
        add(model_.stiffness, term.name, term.law, e, nodal(term.matrix));
    addLoad("mud", "1", e, turn.transpose() * mud.load);
  }

  /// R_ipa, weight and torque on bit, unbalances and nodal forces.
  void addNodalLoads() {
    Vector reaction = Eigen::Map<const Vector>(in_.path.reaction.data(), in_.path.reaction.size());
    if (reaction.any()) model_.loads.push_back({"path reaction", 0, reaction});
    for (const auto& load : loads::pointLoads(in_.loads, in_.rotary, in_.string.depths())) {
      Vector vector = Vector::Zero(kNodeDofs * model_.nodes);
      vector(kNodeDofs * (load.node - 1) + load.component) = load.value;
      model_.loads.push_back({load.name, model_.lawIndex(load.law), vector});
    }
  }

  void add(std::vector<ElementTerm>& terms, const std::string& name, const std::string& law, int e,
           const Matrix12& matrix) {
    auto term = std::find_if(terms.begin(), terms.end(),
                             [&](const ElementTerm& t) { return t.name == name; });
    if (term == terms.end()) {
      terms.push_back({name, model_.lawIndex(in_.rotary.scalar(law)), {}});
      terms.back().matrices.assign(in_.string.elements.size(), Matrix12::Zero());
      term = std::prev(terms.end());
    }
    term->matrices[static_cast<std::size_t>(e)] += matrix;
  }

  void addLoad(const std::string& name, const std::string& law, int e, const Vector12& vector) {
    if (!vector.any()) return;
    auto load = std::find_if(model_.loads.begin(), model_.loads.end(),
                             [&](const NodalLoad& l) { return l.name == name; });
    if (load == model_.loads.end()) {
      model_.loads.push_back(
          {name, model_.lawIndex(in_.rotary.scalar(law)), Vector::Zero(kNodeDofs * model_.nodes)});
      load = std::prev(model_.loads.end());
    }
    load->vector.segment<12>(kNodeDofs * e) += vector;
  }

  const EquationInput& in_;
  StringModel model_;
};

}  // namespace

StringModel buildEquations(const EquationInput& input) { return Builder(input).build(); }

void linearise(StringModel& model, const std::vector<beam::Matrix12>& staticGeometricStiffness,
               const Vector& state, const loads::RayleighDamping& damping) {
  model.state = state;
  const bool any = std::any_of(staticGeometricStiffness.begin(), staticGeometricStiffness.end(),
                               [](const beam::Matrix12& m) { return !m.isZero(0.0); });
  if (!any) return;
  model.stiffness.push_back({"static geometric", 0, staticGeometricStiffness});
  if (damping.stiffnessCoefficient == 0.0) return;
  for (auto& term : model.damping)
    if (term.name == kRayleigh)
      for (std::size_t e = 0; e < term.matrices.size(); ++e)
        term.matrices[e] += damping.stiffnessCoefficient * staticGeometricStiffness[e];
}

}  // namespace tooljoint::drillstring
