// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "parts/foreign/ForeignWriters.hpp"

namespace tooljoint::parts {

namespace {

constexpr int interfaceDofs = 6;
constexpr std::size_t longestLineRead = 4096;  // character(4096) :: Line in ReadReducedFile
constexpr double mostSteps = 1e7;

class ExtPtfmWriter {
 public:
  ExtPtfmWriter(const PartContent& content, const LoadTimes& times)
      : content_(content), times_(times), matrices_(constantMatrices(content, "ExtPtfm")) {}

  std::string text() {
    order();
    const auto n = std::to_string(order_.size());
    const auto [step, count] = samples();
    text_ = "!Part " + excerpt(content_.part.name, 70) + ", written by Tooljoint\n";
    text_ += "!Flex 5 Format\n!Dimension: " + n + "\n";
    text_ += "!Time increment in simulation: " + formatNumber(step) + "\n";
    text_ += "!Total simulation time in file: " + formatNumber(step * (count - 1)) + "\n";
    matrix("!Mass Matrix (Units (kg,m))", matrices_.mass);
    matrix("!Stiffness Matrix (Units (N,m))", matrices_.stiffness);
    matrix("!Damping Matrix (Units (N,m,kg))", matrices_.damping);
    loads(step, count);
    return text_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ModelError("Part " + inQuotes(content_.part.name) +
                     " cannot be written as ExtPtfm: " + what + ".");
  }

  /// The six dofs of the interface node, then the modes.
  void order() {
    const auto& m = content_.part.model;
    const auto numbers = componentNumbers(content_);
    std::vector<int> interface(interfaceDofs, -1), modes;
    std::int64_t node = 0;
    for (int i = 0; i < m.size(); ++i) {
      const auto& l = m.dofs[static_cast<std::size_t>(i)];
      if (l.kind != model::DofLabel::Kind::Physical) {
        modes.push_back(i);
        continue;
      }
      if (node != 0 && l.entity != node)
        fail("it has dofs of the nodes " + std::to_string(node) + " and " +
             std::to_string(l.entity) +
             ". Expected one interface node, and modes. Fix the others, or do not retain them");
      node = l.entity;
      const int number = numbers[static_cast<std::size_t>(l.component)];
      if (number > 0) interface[static_cast<std::size_t>(number - 1)] = i;
    }
    if (std::count(interface.begin(), interface.end(), -1) > 0)
      fail("its interface node has " +
           std::to_string(interfaceDofs - std::count(interface.begin(), interface.end(), -1)) +
           " of the six components u, v, w, theta_x, theta_y, theta_z");
    order_ = interface;
    order_.insert(order_.end(), modes.begin(), modes.end());
  }

  /// Two rows for constant loads.
  std::pair<double, long> samples() const {
    const auto& m = content_.part.model;
    const bool constant = std::all_of(m.loads.begin(), m.loads.end(), [&](const auto& load) {
      return m.laws[static_cast<std::size_t>(load.law)].isOne();
    });
    if (constant) return {1.0, 2};
    if (!(times_.step > 0.0) || !(times_.end > times_.begin))
      fail("its loads vary in time. Give the deck a Transient list, which says from when to when");
    const double count = std::ceil((times_.end - times_.begin) / times_.step - 1e-9) + 1;
    if (count > mostSteps)
      fail("its loads have " + countText(count) + " times. Take a larger step");
    return {times_.step, static_cast<long>(count)};
  }

  /// Writes a number in its own field; it reads back as the same double.
  void number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), " %23.16e", value);
    text_ += text;
  }

  void matrix(const std::string& heading, const Sparse& A) {
    text_ += heading + "\n!Dimension: " + std::to_string(order_.size()) + "\n";
    for (const int i : order_) {
      for (const int j : order_) number(A.coeff(i, j));
      text_ += "\n";
    }
  }

  void loads(double step, long count) {
    const auto n = order_.size();
    if ((n + 2) * 24 > longestLineRead)
      fail("a line of its loads has " + std::to_string(n + 2) +
           " numbers, which OpenFAST cannot read. Keep fewer modes");
    text_ += "!Loading and Wave Elevation (Units (N,m))\n!Dimension: 1 time column - " +
             std::to_string(n) + " force columns - 1 wave elevation column\n";
    for (long k = 0; k < count; ++k) {
      const double t = step * static_cast<double>(k);
      const Vector force = content_.part.model.loadAt(times_.begin + t);
      number(t);
      for (const int i : order_) number(force[i]);
      number(0.0);
      text_ += "\n";
    }
  }

  const PartContent& content_;
  LoadTimes times_;
  ConstantMatrices matrices_;
  std::vector<int> order_;  ///< positions in the part, by row of the file
  std::string text_;
};

}  // namespace

std::string extPtfmText(const PartContent& content, const LoadTimes& times) {
  return ExtPtfmWriter(content, times).text();
}

}  // namespace tooljoint::parts
