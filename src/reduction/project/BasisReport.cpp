// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/BasisReport.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tooljoint::reduction {

namespace {

constexpr double twoPi = 6.28318530717958647692;

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char line[512];
  std::snprintf(line, sizeof line, pattern, args...);
  return line;
}

/// "12.34", "-" for what was not computed.
std::string number(double value, const char* pattern) {
  return value < 0 ? "-" : format(pattern, value);
}

std::string rowLine(const BasisRow& row) {
  const std::string frequency = row.eigenvalue < 0 ? format("omega^2 = %.4g", row.eigenvalue)
                                                   : format("%.6g", row.frequency());
  return format("  %-16s %-24s %18s %10.1e  %-8s %s\n", row.kind.c_str(), row.name.c_str(),
                frequency.c_str(), row.residual, row.kept ? "kept" : "dropped", row.why.c_str());
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
      "%s of part \"%s\": %d interface + %d retained dofs, %d of %d interior coordinates kept as "
      "modes (%s)\n",
      basis.c_str(), part.c_str(), interface, retained, modes, interior,
      method.empty() ? "none" : method.c_str());
  if (!sharedWith.empty()) text += "  taken over from the identical part \"" + sharedWith + "\"\n";
  text += format("  %-16s %-24s %18s %10s  %-8s %s\n", "kind", "name", "frequency [Hz]", "residual",
                 "", "why");
  double worst = 0;
  for (const auto& row : *rows)
    if (row.kind == "constraint") worst = std::max(worst, row.residual);
  if (!all && interface + retained > 0)
    text += format("  %-16s %-24s %18s %10.1e  %-8s %s\n", "constraint",
                   format("%d dofs", interface + retained).c_str(), "", worst, "kept",
                   "interface and retained dofs");
  int dropped = 0;
  for (const auto& row : *rows) {
    if (!all && row.kind == "constraint") continue;
    if (!row.kept && ++dropped > 2 && !all) continue;
    text += rowLine(row);
  }
  if (!all && dropped > 2)
    text += format("  ... and %d more that were computed and dropped\n", dropped - 2);
  text += format("  |Phi'M Phi - I| %.1e; m_DD - I %.1e, off-diagonal of sym k_DD %.1e%s\n",
                 orthogonality, massDefect, stiffnessDefect,
                 structureEnforced ? " (rounding removed)" : "");
  if (checked) {
    text += format(
        "  rank %d of %d, condition %.2e; static exactness %s; zero-energy modes %d of the part, "
        "%d reduced\n",
        rank, reducedSize(), conditioning, number(staticDefect, "%.1e").c_str(), zeroEnergyFull,
        zeroEnergyReduced);
    const std::string step = explicitStep > 0 ? format("%.3e s", explicitStep) : "any length";
    text += format("  largest frequency of the reduced part %.6g Hz: %s\n", largestOmega / twoPi,
                   explicitStep < 0 ? "RK4 refuses it, its mass is singular"
                                    : ("RK4 stays stable up to a step of " + step).c_str());
  }
  for (const auto& sentence : remarks) text += "  note: " + sentence + "\n";
  return text;
}

std::string summaryTable(const std::vector<const BasisReport*>& reports) {
  std::string text =
      format("%-20s %9s %9s %9s %7s %11s %11s %9s %9s %9s %6s %11s %10s\n", "part", "interface",
             "retained", "interior", "modes", "highest Hz", "dropped Hz", "residual", "M-orth.",
             "static", "zero E", "omega max", "RK4 step");
  int interface = 0, retained = 0, interior = 0, modes = 0;
  double step = -1;
  for (const BasisReport* r : reports) {
    double residual = 0;
    for (const auto& row : *r->rows)
      if (row.kept) residual = std::max(residual, row.residual);
    const double dropped = r->firstDroppedHz();
    text +=
        format("%-20s %9d %9d %9d %7d %11.5g %11s %9.1e %9.1e %9s %6s %11s %10s%s\n",
               r->part.c_str(), r->interface, r->retained, r->interior, r->modes, r->cutOffHz(),
               dropped > 0 ? format("%.5g", dropped).c_str() : "-", residual, r->orthogonality,
               number(r->staticDefect, "%.1e").c_str(),
               r->checked ? format("%d/%d", r->zeroEnergyFull, r->zeroEnergyReduced).c_str() : "-",
               number(r->largestOmega, "%.5g").c_str(), number(r->explicitStep, "%.3e").c_str(),
               r->sharedWith.empty() ? "" : (" = " + r->sharedWith).c_str());
    if (r->negativeModes > 0)
      text +=
          format("  %d kept mode(s) of \"%s\" have omega^2 < 0: buckled between its kept dofs\n",
                 r->negativeModes, r->part.c_str());
    interface += r->interface;
    retained += r->retained;
    interior += r->interior;
    modes += r->modes;
    if (r->explicitStep > 0) step = step < 0 ? r->explicitStep : std::min(step, r->explicitStep);
  }
  text +=
      format("%-20s %9d %9d %9d %7d %11s %11s %9s %9s %9s %6s %11s %10s\n", "total", interface,
             retained, interior, modes, "", "", "", "", "", "", "", number(step, "%.3e").c_str());
  return text;
}

}  // namespace tooljoint::reduction
