// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Forces of the rock on the bit as a law of the bit's motion. A law is one file that registers
/// itself, in the tree or outside; a deck chooses it as `Bit/Law`.
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

/// Range of weights on bit to which a law was fitted [N].
struct WeightRange {
  double least = 0.0;
  double most = std::numeric_limits<double>::infinity();
  bool contains(double weight) const { return weight >= least && weight <= most; }
};

/// Data of a bit law in addition to its own parameters.
class BitLaw {
 public:
  virtual ~BitLaw() = default;
  /// True if the law gives the weight on bit too. It then acts on the advance [m] (positive into
  /// the rock) and the angle [rad] of the bit, otherwise on the angle only. Both are measured from
  /// the surface, in any frame.
  virtual bool givesWeight() const = 0;
  /// The law of one point. `weightOnBit` [N] is the deck's Loads value, for laws that do not
  /// compute the weight. Forces act on the bit: resisting forces are negative.
  virtual std::shared_ptr<const model::PointLaw> make(double weightOnBit) const = 0;
  /// True if a bit that turns backward advances into uncut rock.
  virtual bool cutsForwardOnly() const { return false; }
  /// True if the torque falls with the speed, at least at some speeds.
  virtual bool weakensWithSpeed() const { return false; }
  /// Outside this range the program warns.
  virtual WeightRange calibration() const { return {}; }
  /// The description that `tooljoint check` prints.
  virtual std::string describe() const = 0;
};

/// name -> law, made from its own list.
using BitLaws = deck::Registry<BitLaw, const Teuchos::ParameterList&>;

/// A list with the parameters that laws of a turning bit share: Radius and, for experts, Sticking
/// Speed.
deck::ListSpec turningBitParameters(const std::string& name, const std::string& doc);

/// Registers a law that is made from its own list; the list has the name of the law.
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
/// From the validated list. DeckError as thrown by the laws.
BitSettings readBit(const Teuchos::ParameterList& list);

/// The law at the last node of a string that turns at `rotary` and advances at `feed` [m/s], in the
/// frame that moves with both. Channels weight_on_bit, if the law gives the weight, and
/// torque_on_bit.
PointOnString bitOnString(const BitSettings& bit, int node, const loads::RotarySpeed& rotary,
                          double feed, double weightOnBit);

/// Load of the rock on the bit in steady drilling at the speeds of time t.
struct BitLoad {
  double weight = 0.0;  ///< [N], positive in compression; 0 for a law that does not give it
  double torque = 0.0;  ///< [N m], positive against rotation
};
BitLoad steadyLoad(const PointOnString& bit, double t);

/// Advance [m/s] of steady drilling with this weight [N] at the speed of time t, for a law that
/// gives the weight. DeckError if no advance up to 1 m/s gives it; the message continues a sentence
/// that begins with the path of a parameter.
double feedFor(const BitSettings& bit, const loads::RotarySpeed& rotary, double t, double weight);

/// A warning that the weights `least` to `most` [N] of `what` are outside the calibrated range of
/// the law; "" inside it.
std::string outsideCalibration(const BitSettings& bit, const std::string& what, double least,
                               double most);

/// Names of the point sets.
constexpr const char* bitSet = "bit";
constexpr const char* topDriveSet = "top drive";
constexpr const char* hookSet = "hook";

}  // namespace tooljoint::drilling
