// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/EquationBuilder.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "common/report/EvaluationCounters.hpp"

namespace tooljoint::drillstring {

using beam::Matrix12;
using beam::Vector12;

namespace {

constexpr const char* kConstant = model::ScalarLaw::kOne;

bool isZero(const ElementTerm& term) {
  return std::all_of(term.matrices.begin(), term.matrices.end(),
                     [](const Matrix12& m) { return m.isZero(0.0); });
}

void removeZeroTerms(std::vector<ElementTerm>& terms) {
  terms.erase(std::remove_if(terms.begin(), terms.end(), isZero), terms.end());
}

/// Element contributions are formed in the frame of the element and turned to the nodal frames by
/// R' X R.
class Builder {
 public:
  explicit Builder(const EquationInput& input)
      : in_(input), gravity_(loads::acceleration(input.loads)) {
    model_.nodes = input.string.nodeCount();
    model_.held = input.held;
    model_.state = Vector::Zero(kNodeDofs * model_.nodes);
    model_.mass.reserve(input.string.elements.size());
    out_.stiffness.assign(input.string.elements.size(), Matrix12::Zero());
    out_.load = Vector::Zero(kNodeDofs * model_.nodes);
  }

  PathEquations build() {
    for (int e = 0; e < in_.string.elementCount(); ++e) addElement(e);
    for (const auto i : distributed_) out_.load += model_.loads[i].vector;
    addNodalLoads();
    // the first damping term, formed element by element
    if (in_.damping.present() && !isZero(model_.damping.front())) out_.rayleigh = 0;
    removeZeroTerms(model_.damping);
    removeZeroTerms(model_.stiffness);
    return std::move(out_);
  }

 private:
  void addElement(int e) {
    const auto i = static_cast<std::size_t>(e);
    const beam::Element& element = *in_.string.elements[i].formulation;
    const Matrix3& triad = in_.path.elementFrame[i];
    const Matrix12 turn = beam::rotation12(triad, in_.path.frame[i], in_.path.frame[i + 1]);
    const auto nodal = [&turn](const Matrix12& matrix) -> Matrix12 {
      return turn.transpose() * matrix * turn;
    };

    const Matrix12 structuralMass = nodal(element.mass());
    const Matrix12 stiffness = prestressedStiffness(e, turn);
    model_.mass.push_back(structuralMass);
    addStiffness("structure", kConstant, e, stiffness);
    if (in_.damping.present())
      add(model_.damping, "Rayleigh damping", kConstant, e,
          in_.damping.massCoefficient * structuralMass +
              in_.damping.stiffnessCoefficient * stiffness);
    add(model_.damping, "element damping", kConstant, e, nodal(element.damping()));
    addLineLoads(e, element, triad, turn);
    if (in_.rotary.present()) addRotation(e, element, nodal, turn);
    if (in_.mud != nullptr) addMud(e, element, triad.transpose() * gravity_, nodal, turn);
  }

  void addLineLoads(int e, const beam::Element& element, const Matrix3& triad,
                    const Matrix12& turn) {
    const auto i = static_cast<std::size_t>(e);
    const Matrix12 slopes = slopeTurn(e, turn);
    const loads::LoadedElement loaded{element.section(), triad, in_.string.nodes[i].s,
                                      in_.string.nodes[i + 1].s};
    for (const auto& load : in_.loads)
      for (const auto& line : load->onElement(loaded, in_.rotary))
        addLoad(line.name, line.law, e, slopes.transpose() * element.distributedLoad(line.force));
  }

  Matrix12 slopeTurn(int e, const Matrix12& turn) const {
    const auto i = static_cast<std::size_t>(e);
    return beam::slopeRotation(turn, in_.path.axisInFrame(i), in_.path.axisInFrame(i + 1));
  }

  /// K_a + F K_gF + T K_gT, or the corotational tangent of the path state, in nodal frames.
  Matrix12 prestressedStiffness(int e, const Matrix12& turn) const {
    const auto i = static_cast<std::size_t>(e);
    if (!in_.path.tangent.empty()) {
      count("geometric stiffness");
      return in_.path.tangent[i];
    }
    const beam::Element& element = *in_.string.elements[i].formulation;
    Matrix12 stiffness = element.stiffness();
    const double force = in_.path.axialForce(e);
    const double torque = in_.path.torque(e);
    if (force != 0.0 || torque != 0.0) {
      count("geometric stiffness");
      stiffness += force * element.geometricAxial() + torque * element.geometricTorque();
    }
    return turn.transpose() * stiffness * turn;
  }

  /// Omega (C_ac' - C_ac) D', dOmega/dt C_ac' D on the left, -dOmega/dt F_thetaz on the right.
  template <class Nodal>
  void addRotation(int e, const beam::Element& element, const Nodal& nodal, const Matrix12& turn) {
    const Matrix12 coupling = nodal(element.gyroscopic());
    add(model_.damping, "gyroscopic", "Omega", e, coupling.transpose() - coupling);
    addStiffness("spin-up", "dOmega/dt", e, coupling.transpose());
    addLoad("spin-up", in_.rotary.scalar("dOmega/dt"), e, -(turn.transpose() * element.spinLoad()));
    count("gyroscopic matrices");
  }

  template <class Nodal>
  void addMud(int e, const beam::Element& element, const Vector3& gravity, const Nodal& nodal,
              const Matrix12& turn) {
    const auto i = static_cast<std::size_t>(e);
    const double bore =
        in_.well.boreRadius(0.5 * (in_.string.nodes[i].s + in_.string.nodes[i + 1].s));
    const auto mud = in_.mud->element(element.section(), bore, element.length(), gravity);
    model_.mass.back() += nodal(mud.mass);
    for (const auto& term : mud.damping)
      if (model::ScalarLaw::isOne(term.law) || in_.rotary.present())
        add(model_.damping, term.name, term.law, e, nodal(term.matrix));
    for (const auto& term : mud.stiffness)
      if (model::ScalarLaw::isOne(term.law) || in_.rotary.present())
        addStiffness(term.name, term.law, e, nodal(term.matrix));
    addLoad("mud", model::ScalarLaw::one(), e, slopeTurn(e, turn).transpose() * mud.load);
  }

  /// R_ipa and the loads at nodes.
  void addNodalLoads() {
    Vector reaction = Eigen::Map<const Vector>(in_.path.reaction.data(), in_.path.reaction.size());
    if (reaction.any()) {
      const int constant = model_.lawIndex(model::ScalarLaw::one());
      model_.loads.push_back({"path reaction", constant, reaction});
      out_.pathReaction = std::move(reaction);
    }
    for (const auto& load : loads::pointLoads(in_.loads, in_.string.depths(), in_.rotary)) {
      Vector vector = Vector::Zero(kNodeDofs * model_.nodes);
      vector(kNodeDofs * (load.node - 1) + load.component) = load.value;
      if (load.law.isOne()) out_.load += vector;
      model_.loads.push_back({load.name, model_.lawIndex(load.law), std::move(vector)});
    }
  }

  void addStiffness(const std::string& name, const std::string& law, int e,
                    const Matrix12& matrix) {
    add(model_.stiffness, name, law, e, matrix);
    if (model::ScalarLaw::isOne(law)) out_.stiffness[static_cast<std::size_t>(e)] += matrix;
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

  void addLoad(const std::string& name, const model::ScalarLaw& law, int e,
               const Vector12& vector) {
    if (!vector.any()) return;
    const int index = model_.lawIndex(law);
    auto load = std::find_if(model_.loads.begin(), model_.loads.end(),
                             [&](const NodalLoad& l) { return l.name == name && l.law == index; });
    if (load == model_.loads.end()) {
      if (law.isOne()) distributed_.push_back(model_.loads.size());
      model_.loads.push_back({name, index, Vector::Zero(kNodeDofs * model_.nodes)});
      load = std::prev(model_.loads.end());
    }
    load->vector.segment<12>(kNodeDofs * e) += vector;
  }

  const EquationInput& in_;
  Vector3 gravity_;  ///< of the loads, global axes [m/s2]
  PathEquations out_;
  StringModel& model_ = out_.model;
  std::vector<std::size_t> distributed_;  ///< positions of the constant loads of the elements
};

}  // namespace

PathEquations buildEquations(const EquationInput& input) { return Builder(input).build(); }

StringModel linearise(PathEquations equations,
                      const std::vector<Matrix12>& staticGeometricStiffness, const Vector& state,
                      const loads::RayleighDamping& damping, ContactBatch contact) {
  StringModel model = std::move(equations.model);
  model.state = state;
  model.contact = std::move(contact);
  const bool any = std::any_of(staticGeometricStiffness.begin(), staticGeometricStiffness.end(),
                               [](const Matrix12& m) { return !m.isZero(0.0); });
  if (!any) return model;
  model.stiffness.push_back(
      {"static geometric", model.lawIndex(model::ScalarLaw::one()), staticGeometricStiffness});
  if (!equations.rayleigh) return model;
  auto& term = model.damping[*equations.rayleigh];
  for (std::size_t e = 0; e < term.matrices.size(); ++e)
    term.matrices[e] += damping.stiffnessCoefficient * staticGeometricStiffness[e];
  return model;
}

}  // namespace tooljoint::drillstring
