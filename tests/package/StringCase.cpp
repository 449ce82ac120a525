// SPDX-License-Identifier: BSD-3-Clause
#include "StringCase.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <tooljoint/common/Error.hpp>
#include <tooljoint/run.hpp>

namespace {

constexpr double length = 90.0, density = 7850.0, youngModulus = 2.1e11, gravity = 9.81;

const std::string deck = R"xml(<ParameterList name="hanging">
  <ParameterList name="Well">
    <Parameter name="Trajectory" type="string" value="Vertical"/>
    <ParameterList name="Vertical"><Parameter name="Length" type="double" value="100"/></ParameterList>
    <Parameter name="Bore Radius" type="double" value="0.108"/>
  </ParameterList>
  <ParameterList name="Drillstring">
    <Parameter name="Assembly" type="Array(string)" value="{10*pipe}"/>
    <ParameterList name="Components">
      <ParameterList name="pipe">
        <Parameter name="Length" type="double" value="9"/>
        <Parameter name="Outer Radius" type="double" value="0.0635"/>
        <Parameter name="Inner Radius" type="double" value="0.054"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="Material">
      <Parameter name="Density" type="double" value="7850"/>
      <Parameter name="Young Modulus" type="double" value="2.1e11"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Loads"><Parameter name="Gravity" type="double" value="9.81"/></ParameterList>
</ParameterList>
)xml";

}  // namespace

void runStringCase() {
  std::ofstream("hanging.xml") << deck;
  const auto results = tooljoint::runDeck("hanging.xml", {}, MPI_COMM_WORLD, {"hanging", ""});
  const auto displacement = results.histories().numbers("/static/displacement");
  const double stretch = displacement[displacement.size() - 4];  // w of the last node
  const double expected = density * gravity * length * length / (2.0 * youngModulus);
  if (std::abs(stretch / expected - 1.0) > 1e-6)
    throw std::runtime_error("the pipes stretch by " + std::to_string(stretch) + " m, not by " +
                             std::to_string(expected) + " m");
  try {
    results.number("transient.local_error");
    throw std::runtime_error("a key of earlier versions is taken");
  } catch (const tooljoint::UsageError& error) {
    if (std::string(error.what()).find("now called \"transient.step_error\"") == std::string::npos)
      throw std::runtime_error("the new name of a key is not told: " + std::string(error.what()));
  }
  if (results.status() != "finished" || !std::ifstream("hanging/results.h5"))
    throw std::runtime_error("a run by the installed libraries left no results");
}
