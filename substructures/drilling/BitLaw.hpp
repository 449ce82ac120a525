// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The rock at the bit as a law of its motion. A law is one file that registers itself, in the tree
/// or outside; a deck chooses it as `Bit/Law`.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "deck/ListSpec.hpp"
#include "deck/Registry.hpp"
#include "model/laws/PointLaw.hpp"
#include "substructures/drilling/PointOnString.hpp"
#include "substructures/loads/RotarySpeed.hpp"

namespace tooljoint::drilling {

/// Weights on bit a law was fitted to [N].
struct WeightRange {
  double least = 0.0;
  double most = std::numeric_limits<double>::infinity();
  bool contains(double weight) const { return weight >= least && weight <= most; }
};

/// What a law at the bit is made of beside its own parameters.
class BitLaw {
 public:
  virtual ~BitLaw() = default;
  /// The law gives the weight on bit too: it then acts on the advance [m] (positive into the rock)
  /// and the angle [rad] of the bit, else on the angle alone. Both count from the surface, whatever
  /// the frame.
  virtual bool givesWeight() const = 0;
  /// One point. `weightOnBit` [N]: that of the deck's Loads, for laws that do not give it. Forces
  /// are those on the bit: the resisting ones are negative.
  virtual std::shared_ptr<const model::PointLaw> make(double weightOnBit) const = 0;
  /// Turned backward, the bit advances into uncut rock.
  virtual bool cutsForwardOnly() const { return false; }
  /// The torque falls with the speed, at some speeds at least.
  virtual bool weakensWithSpeed() const { return false; }
  /// Beyond it the program warns.
  virtual WeightRange calibration() const { return {}; }
  /// What `tooljoint check` says of it.
  virtual std::string describe() const = 0;
};

/// name -> law, from its own list.
using BitLaws = deck::Registry<BitLaw, const Teuchos::ParameterList&>;

/// A list of parameters with those that laws of a turning bit share: Radius and, for experts,
/// Sticking Speed.
deck::ListSpec turningBitParameters(const std::string& name, const std::string& doc);

/// Registers a law that is made from its own list, which has the name of the law.
template <class Law>
bool addBitLaw(const deck::ListSpec& parameters) {
  return BitLaws::instance().add(
      parameters.name(), {parameters.doc(), parameters, [](const Teuchos::ParameterList& own) {
                            return std::make_unique<Law>(own);
                          }});
}

/// The deck list `Bit`.
struct BitSettings {
  std::string name;
  std::shared_ptr<const BitLaw> law;
};
deck::ListSpec bitParameters();
/// From the validated list. DeckError as the laws give it.
BitSettings readBit(const Teuchos::ParameterList& list);

/// The law at the last node of a string that turns at `rotary` and advances at `feed` [m/s], in the
/// frame of both. Channels weight_on_bit, where the law gives it, and torque_on_bit.
PointOnString bitOnString(const BitSettings& bit, int node, const loads::RotarySpeed& rotary,
                          double feed, double weightOnBit);

/// What the rock exerts on the bit in steady drilling at the speeds of time t.
struct BitLoad {
  double weight = 0.0;  ///< [N], positive in compression; 0 for a law that does not give it
  double torque = 0.0;  ///< [N m], positive against rotation
};
BitLoad steadyLoad(const PointOnString& bit, double t);

/// Advance [m/s] of steady drilling at which a law that gives the weight gives this one [N], at the
/// speed of time t. DeckError where none up to 1 m/s does: the sentence goes on after the path of a
/// parameter.
double feedFor(const BitSettings& bit, const loads::RotarySpeed& rotary, double t, double weight);

/// "" or a warning that the weights `least` to `most` [N] of `what` lie outside of what the law was
/// fitted to.
std::string outsideCalibration(const BitSettings& bit, const std::string& what, double least,
                               double most);

/// Names of the point sets.
constexpr const char* bitSet = "bit";
constexpr const char* topDriveSet = "top drive";
constexpr const char* hookSet = "hook";

}  // namespace tooljoint::drilling
