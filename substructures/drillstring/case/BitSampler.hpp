// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Speed, weight and torque of the bit at a sample, from its law and from constant loads.
#pragma once

#include <vector>

#include "cases/PointRecord.hpp"
#include "substructures/drillstring/figures/BitFigures.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/loads/Load.hpp"

namespace tooljoint::drillstring {

class BitSampler {
 public:
  /// The scene must outlive the object.
  explicit BitSampler(const Scene& scene);

  /// \param drilling  records of the laws of the scene, evaluated at this sample
  BitSample at(const cases::Sample& sample, const std::vector<cases::PointRecord>& drilling) const;

 private:
  const Scene& scene_;
  std::vector<loads::PointLoad> loads_;  ///< on w and theta_z of the last node
};

}  // namespace tooljoint::drillstring
