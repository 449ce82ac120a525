// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Results of the motion of a string over a window of time: of its bit, and of every node and
/// element. Only sums are kept, no histories.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "cases/figures/ContactFigures.hpp"
#include "cases/figures/FigureWindow.hpp"
#include "cases/figures/OrbitFigures.hpp"
#include "cases/figures/SignalFigures.hpp"
#include "io/OutputFolder.hpp"
#include "substructures/drillstring/figures/BendingFigures.hpp"
#include "substructures/drillstring/figures/BitFigures.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

class StringFigures {
 public:
  /// The scene must have a motion, and must outlive the object.
  StringFigures(const Scene& scene, const StaticStage& stage);

  /// Adds the sample if it lies in the window.
  /// \param normalForce  per node [N]
  void sample(const cases::Sample& sample, const BitSample& bit, const Vector& normalForce);

  /// False until a sample lies in the window; there are no results before.
  bool known() const { return samples_ > 0; }
  /// Sets the keys transient.figures.
  void summarise(io::Summary& summary) const;
  /// Warnings from the results of the bit, about the motion and its law.
  std::vector<std::string> warnings() const;
  /// Lines of the log.
  std::string describe() const;
  /// Group /figures of results.h5.
  void write(io::ResultsFile& file) const;
  /// figures_nodes.csv and figures_elements.csv.
  void stageTables(io::OutputFolder& folder) const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  /// A column of figures, one number for each node or element.
  struct Column {
    std::string name, unit, longName;
    Vector values;
  };
  std::vector<Column> nodeColumns() const;
  std::vector<Column> elementColumns() const;
  void summariseNodes(io::Summary& summary) const;
  void summariseBending(io::Summary& summary) const;
  double perHour() const;
  std::vector<int> belowReleases_;  ///< elementsBelowReleases()
  void sampleNodes(const cases::Sample& sample, const Vector& normalForce);

  const Scene& scene_;
  cases::FigureWindow window_;
  Vector nodeDepth_, elementDepth_;  ///< [m]; elements at their middle
  long samples_ = 0;
  double leastWeight_ = std::numeric_limits<double>::infinity();
  double mostWeight_ = -std::numeric_limits<double>::infinity();  ///< on the bit, whole motion
  double first_ = 0.0, last_ = 0.0;                               ///< samples in the window [s]
  BitFigures bit_;
  cases::MagnitudeFigures axial_, lateral_;  ///< accelerations [m/s2]
  cases::OrbitFigures orbit_;
  cases::ContactFigures contact_;
  BendingFigures bending_;
};

}  // namespace tooljoint::drillstring
