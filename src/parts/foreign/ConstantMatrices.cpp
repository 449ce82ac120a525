// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "parts/foreign/ForeignWriters.hpp"
#include "parts/foreign/PartFormat.hpp"

namespace tooljoint::parts {

namespace {

template <class Terms>
Sparse sumOf(const PartContent& content, const Terms& terms, const std::string& format) {
  const auto& m = content.part.model;
  Sparse sum(m.size(), m.size());
  for (const auto& term : terms) {
    const auto& law = m.laws[static_cast<std::size_t>(term.law)];
    if (!law.isOne())
      throw ModelError("Part " + inQuotes(content.part.name) + " cannot be written as " + format +
                       ": its matrix " + inQuotes(term.name) + " varies in time with the law " +
                       inQuotes(law.name) +
                       ", and the file holds constant matrices. Write HDF5 or "
                       "Matrix Market instead.");
    sum += Sparse(term.matrix);
  }
  return sum;
}

}  // namespace

ConstantMatrices constantMatrices(const PartContent& content, const std::string& format) {
  const auto& m = content.part.model;
  return {Sparse(m.mass), sumOf(content, m.damping, format), sumOf(content, m.stiffness, format)};
}

std::vector<int> componentNumbers(const PartContent& content) {
  const auto& names = content.part.model.componentNames;
  std::vector<int> numbers(names.size(), -1);
  const auto axes = coupling::componentAxes(names);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (axes.translation[axis] >= 0)
      numbers[static_cast<std::size_t>(axes.translation[axis])] = k + 1;
    if (axes.rotation[axis] >= 0) numbers[static_cast<std::size_t>(axes.rotation[axis])] = k + 4;
  }
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c] == scalarComponent) numbers[c] = 0;
  if (std::find(numbers.begin(), numbers.end(), -1) == numbers.end()) return numbers;
  int next = 0;
  for (int& number : numbers)
    if (number != 0) number = ++next;
  if (next > 6)
    throw ModelError("Part " + inQuotes(content.part.name) + " has " + std::to_string(next) +
                     " components of a node, but the format has six: " + quotedList(names) + ".");
  return numbers;
}

}  // namespace tooljoint::parts
