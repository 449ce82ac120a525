// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/BasisReport.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "common/Constants.hpp"

namespace tooljoint::reduction {

using constants::twoPi;
using fmt::format;

namespace {

/// "12.34", "-" for values that were not computed.
std::string number(double value, const char* pattern) {
  return value < 0 ? "-" : format(fmt::runtime(pattern), value);
}

std::string rowLine(const BasisRow& row) {
  const std::string frequency = row.eigenvalue < 0 ? format("omega^2 = {:.4g}", row.eigenvalue)
                                                   : format("{:.6g}", row.frequency());
  return format("  {:16} {:20} {:>20} {:9.1e}  {:7} {}\n", row.kind, row.name, frequency,
                row.residual, row.kept ? "kept" : "dropped", row.why);
}

}  // namespace

double BasisRow::frequency() const { return std::sqrt(std::abs(eigenvalue)) / twoPi; }

double BasisReport::cutOffHz() const {
  double highest = 0;
  for (const auto& row : *rows)
    if (row.kept && row.kind != "constraint" && row.eigenvalue > 0)
      highest = std::max(highest, row.frequency());
  return highest;
}

double BasisReport::firstDroppedHz() const {
  for (const auto& row : *rows)
    if (!row.kept) return row.frequency();
  return 0;
}

std::string BasisReport::table(bool all) const {
  std::string text = format(
      "{} of part \"{}\": {} interface + {} retained dofs, {} of {} interior coordinates kept as "
      "modes ({})\n",
      basis, part, interface, retained, modes, interior, method.empty() ? "none" : method);
  if (!sharedWith.empty()) text += "  copied from the identical part \"" + sharedWith + "\"\n";
  text += format("  {:16} {:20} {:>20} {:>9}  {:7} {}\n", "kind", "name", "frequency [Hz]",
                 "residual", "", "why");
  double worst = 0;
  for (const auto& row : *rows)
    if (row.kind == "constraint") worst = std::max(worst, row.residual);
  if (!all && interface + retained > 0)
    text += format("  {:16} {:20} {:>20} {:9.1e}  {:7} {}\n", "constraint",
                   format("{} dofs", interface + retained), "", worst, "kept", "boundary dofs");
  int dropped = 0;
  for (const auto& row : *rows) {
    if (!all && row.kind == "constraint") continue;
    if (!row.kept && ++dropped > 2 && !all) continue;
    text += rowLine(row);
  }
  if (!all && dropped > 2) text += format("  ... and {} more computed and not kept\n", dropped - 2);
  text += format("  |Phi'M Phi - I| {:.1e}; m_DD - I {:.1e}, off-diagonal of sym k_DD {:.1e}{}\n",
                 orthogonality, massDefect, stiffnessDefect,
                 structureEnforced ? " (rounding removed)" : "");
  if (checked) {
    text += format("  rank {} of {}, condition {:.2e}; static exactness {}\n", rank, reducedSize(),
                   conditioning, number(staticDefect, "{:.1e}"));
  }
  if (largestOmega >= 0) {
    text += format("  zero-energy modes: {} of the part, {} reduced\n", zeroEnergyFull,
                   zeroEnergyReduced);
    const std::string step = explicitStep > 0 ? format("{:.3e} s", explicitStep) : "any length";
    text += format("  largest frequency of the reduced part {:.6g} Hz: {}\n", largestOmega / twoPi,
                   explicitStep < 0 ? "not for RK4, the mass matrix is singular"
                                    : ("RK4 is stable up to a step of " + step));
  }
  for (const auto& sentence : remarks) text += "  note: " + sentence + "\n";
  return text;
}

std::string summaryTable(const std::vector<const BasisReport*>& reports) {
  std::string text =
      format("{:20} {:>9} {:>8} {:>8} {:>6} {:>11} {:>11} {:>9} {:>9}\n", "part", "interface",
             "retained", "interior", "modes", "highest Hz", "dropped Hz", "residual", "RK4 step");
  int interface = 0, retained = 0, interior = 0, modes = 0, copies = 0;
  double step = -1;
  for (const BasisReport* r : reports) {
    double residual = 0;
    for (const auto& row : *r->rows)
      if (row.kept) residual = std::max(residual, row.residual);
    const double dropped = r->firstDroppedHz();
    text += format("{:20} {:9} {:8} {:8} {:6} {:11.5g} {:>11} {:9.1e} {:>9}\n", r->part,
                   r->interface, r->retained, r->interior, r->modes, r->cutOffHz(),
                   dropped > 0 ? format("{:.5g}", dropped) : "-", residual,
                   number(r->explicitStep, "{:.2e}"));
    if (r->negativeModes > 0)
      text += format(
          "  {} kept mode(s) of \"{}\" have omega^2 < 0: the part is buckled with its boundary "
          "dofs fixed\n",
          r->negativeModes, r->part);
    interface += r->interface;
    retained += r->retained;
    interior += r->interior;
    modes += r->modes;
    copies += r->sharedWith.empty() ? 0 : 1;
    if (r->explicitStep > 0) step = step < 0 ? r->explicitStep : std::min(step, r->explicitStep);
  }
  text += format("{:20} {:9} {:8} {:8} {:6} {:>11} {:>11} {:>9} {:>9}\n", "total", interface,
                 retained, interior, modes, "", "", "", number(step, "{:.2e}"));
  if (copies > 0) text += format("{} parts are copies of identical ones\n", copies);
  return text;
}

}  // namespace tooljoint::reduction
