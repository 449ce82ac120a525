// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_ParameterList.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "substructures/well/ArcChain.hpp"

namespace tooljoint::well {
namespace {

const double pi = 3.14159265358979323846;
const std::map<std::string, double> depthUnits = {{"m", 1.0}, {"ft", 0.3048}, {"km", 1000.0}};
const std::map<std::string, double> angleUnits = {{"deg", pi / 180.0}, {"rad", 1.0}};
const std::array<const char*, 3> columnNames = {"measured depth", "inclination", "azimuth"};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  std::istringstream in(line);
  while (std::getline(in, cell, ',')) cells.push_back(trimmed(cell));
  if (!line.empty() && trimmed(line).back() == ',') cells.emplace_back();
  return cells;
}

/// Number that fills the whole cell and is finite.
bool toNumber(const std::string& cell, double& value) {
  const char* begin = cell.data() + (cell.size() > 1 && cell[0] == '+' ? 1 : 0);
  const char* end = cell.data() + cell.size();
  const auto result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(value);
}

/// Reads a survey line by line; faults are collected and thrown together.
class SurveyReader {
 public:
  SurveyReader(std::string file, const std::string& depthUnit, const std::string& angleUnit)
      : file_(std::move(file)), factor_{depthUnits.at(depthUnit), angleUnits.at(angleUnit), angleUnits.at(angleUnit)} {}

  std::vector<Station> read() {
    std::ifstream in(file_);
    if (!in) throw DeckError("The survey file " + file_ + " cannot be read.");
    std::string line;
    while (std::getline(in, line)) {
      ++line_;
      const std::string text = trimmed(line);
      if (text.empty() || text[0] == '#') continue;
      take(split(text));
    }
    if (stations_.size() < 2 && faults_.empty()) fault("a survey needs at least two stations.");
    if (!faults_.empty()) throw DeckError(faults_);
    return stations_;
  }

 private:
  void fault(const std::string& sentence) {
    faults_ += (faults_.empty() ? "" : "\n") + file_ + ":" + std::to_string(line_) + ": " + sentence;
  }

  void take(const std::vector<std::string>& cells) {
    double number = 0.0;
    if (!started_ && !toNumber(cells[0], number) && !cells[0].empty() && std::isalpha(static_cast<unsigned char>(cells[0][0]))) {
      started_ = true;
      header(cells);
      return;
    }
    started_ = true;
    if (cells.size() != columns_) {
      fault("found " + std::to_string(cells.size()) + " columns where " + std::to_string(columns_) +
            " are expected (measured depth, inclination, azimuth; separated by commas).");
      return;
    }
    station(cells);
  }

  void header(const std::vector<std::string>& cells) {
    columns_ = cells.size();
    std::array<bool, 3> seen = {false, false, false};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto bracket = cells[i].find_first_of("[(");
      const int which = columnOf(lowered(trimmed(cells[i].substr(0, bracket))));
      if (which < 0) continue;  // further columns (comments, true vertical depth) are allowed and not read
      const auto k = static_cast<std::size_t>(which);
      if (seen[k]) fault(std::string("the column ") + columnNames[k] + " stands twice in the header.");
      seen[k] = true;
      position_[k] = i;
      if (bracket != std::string::npos) unit(k, cells[i].substr(bracket + 1));
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (!seen[k])
        fault(std::string("the header has no column for the ") + columnNames[k] +
              " (known names: MD, Measured Depth; Inc, Inclination; Azi, Azimuth).");
    if (!faults_.empty()) throw DeckError(faults_);
  }

  static int columnOf(const std::string& name) {
    if (name == "md" || name == "measured depth" || name == "depth") return 0;
    if (name == "inc" || name == "incl" || name == "inclination") return 1;
    if (name == "azi" || name == "az" || name == "azim" || name == "azimuth") return 2;
    return -1;
  }

  void unit(std::size_t k, const std::string& bracketed) {
    const auto& known = k == 0 ? depthUnits : angleUnits;
    const std::string name = trimmed(bracketed.substr(0, bracketed.find_first_of("])")));
    const auto found = known.find(lowered(name));
    if (found != known.end()) {
      factor_[k] = found->second;
      return;
    }
    std::string names;
    for (const auto& entry : known) names += (names.empty() ? "" : ", ") + entry.first;
    fault("the unit \"" + name + "\" of the " + columnNames[k] + " is not known; known are " + names + ".");
  }

  void station(const std::vector<std::string>& cells) {
    std::array<double, 3> value{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!toNumber(cells[position_[k]], value[k])) {
        fault("the " + std::string(columnNames[k]) + " \"" + cells[position_[k]] + "\" is not a finite number.");
        return;
      }
      value[k] *= factor_[k];
    }
    if (stations_.empty() && value[0] != 0.0)
      fault("the first station must be at measured depth 0 (add the line of the surface, for example \"0, 0, 0\").");
    if (!stations_.empty() && !(value[0] > stations_.back().depth))
      fault("the measured depth does not increase from the station before.");
    if (value[1] < 0.0 || value[1] > pi) fault("the inclination must lie between 0 and 180 degrees.");
    if (std::abs(value[2]) > 2.0 * pi * (1.0 + 1e-12)) fault("the azimuth must lie between -360 and 360 degrees.");
    const Station now{value[0], value[1], value[2]};
    if (!stations_.empty() &&
        (direction(now.inclination, now.azimuth) + direction(stations_.back().inclination, stations_.back().azimuth)).norm() <
            1e-6)
      fault("the hole turns back by 180 degrees from the station before, so the arc between them is not defined.");
    stations_.push_back(now);
  }

  std::string file_;
  std::array<double, 3> factor_;
  std::array<std::size_t, 3> position_ = {0, 1, 2};
  std::size_t columns_ = 3;
  bool started_ = false;
  int line_ = 0;
  std::string faults_;
  std::vector<Station> stations_;
};

std::unique_ptr<Trajectory> fromList(const Teuchos::ParameterList& list, const std::string& folder) {
  const auto& name = list.get<std::string>("File");
  const std::string file = name.empty() || name[0] == '/' || folder.empty() ? name : folder + "/" + name;
  if (!std::ifstream(file)) throw DeckError(list.name() + "/File names a file that cannot be read: " + file + ".");
  return minimumCurvature(readSurvey(file, list.get<std::string>("Depth Unit"), list.get<std::string>("Angle Unit")));
}

const bool registered = TrajectoryRegistry::instance().add(
    "Survey",
    {"Survey stations joined by circular arcs (minimum curvature method).",
     deck::ListSpec("Survey", "Survey stations from a CSV file, joined by minimum curvature.")
         .text("File", deck::Required{}, "CSV file with measured depth, inclination and azimuth, relative to the deck.")
         .choice("Depth Unit", std::string("m"), {"m", "ft", "km"}, "Unit of the measured depth where the header gives none.")
         .choice("Angle Unit", std::string("deg"), {"deg", "rad"},
                 "Unit of inclination and azimuth where the header gives none."),
     fromList});

}  // namespace

std::vector<Station> readSurvey(const std::string& file, const std::string& depthUnit, const std::string& angleUnit) {
  if (depthUnits.count(depthUnit) == 0 || angleUnits.count(angleUnit) == 0)
    throw DeckError("The survey units \"" + depthUnit + "\", \"" + angleUnit +
                    "\" are not known; known are m, ft, km and deg, rad.");
  return SurveyReader(file, depthUnit, angleUnit).read();
}

std::unique_ptr<Trajectory> minimumCurvature(const std::vector<Station>& stations) {
  if (stations.size() < 2) throw DeckError("A survey needs at least two stations.");
  if (stations.front().depth != 0.0) throw DeckError("The first survey station must be at measured depth 0.");
  auto chain = std::make_unique<ArcChain>(direction(stations[0].inclination, stations[0].azimuth));
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const Vector3 before = direction(stations[i - 1].inclination, stations[i - 1].azimuth);
    const Vector3 now = direction(stations[i].inclination, stations[i].azimuth);
    const double length = stations[i].depth - stations[i - 1].depth;
    const std::string which = "Survey station " + std::to_string(i + 1);
    if (!(length > 0.0)) throw DeckError(which + " is not deeper than the station before.");
    if ((now + before).norm() < 1e-6) throw DeckError(which + " turns back by 180 degrees from the station before.");
    chain->addArc(length, now);
  }
  return chain;
}

}  // namespace tooljoint::well
