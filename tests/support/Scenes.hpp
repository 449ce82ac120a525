// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The stages of a run in memory for the scenes of xml/.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "reduction/Reduce.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "tests/support/SourceFolder.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::testing_ {

inline drillstring::Scene reference(const std::vector<std::string>& overrides = {}) {
  return drillstring::readScene(testing_::sourceFolder() + "/xml/helical_170m.xml", overrides);
}

inline model::SecondOrderModel reduced(const drillstring::Scene& scene,
                                       const drillstring::StaticStage& stage) {
  return coupling::couple(
      reduction::reduceAll(drillstring::cut(scene, stage), scene.list().sublist("Reduction")));
}

/// All sampled displacements of all nodes, one column per sample.
class History : public transient::SampleSink {
 public:
  explicit History(const model::SecondOrderModel& model) : model_(model) {}
  void sample(double /*t*/, const Vector& q, const Vector& /*qDot*/,
              const Vector& /*qDDot*/) override {
    columns_.push_back(model_.recoveryOffset + model_.recovery * q);
  }
  const std::vector<Vector>& columns() const { return columns_; }

 private:
  const model::SecondOrderModel& model_;
  std::vector<Vector> columns_;
};

inline std::vector<Vector> move(const drillstring::Scene& scene,
                                const model::SecondOrderModel& model) {
  History history(model);
  transient::integrate(model, scene.list().sublist("Transient"), history);
  return history.columns();
}

/// eps_t of (45) in Nguyen et al. 2020, its largest value over the samples: mean over u, v, w of |c
/// - c_ref| / |c_ref|.
inline double largestError(const std::vector<Vector>& motion,
                           const std::vector<Vector>& reference) {
  double largest = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const auto component = [c](const Vector& d) {
        return Eigen::Map<const Matrix>(d.data(), 6, d.size() / 6).row(c);
      };
      sum += (component(motion.at(i)) - component(reference[i])).norm() /
             component(reference[i]).norm();
    }
    largest = std::max(largest, sum / 3.0);
  }
  return largest;
}

}  // namespace tooljoint::testing_
