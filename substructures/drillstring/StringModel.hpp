// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The equations of motion of the string before assembly, element by element and split by origin:
///
///     M D'' + C(t) D' + K(t) D = F(t) + F_c(D, D')        (Nguyen et al. 2020, equations 26-27)
///
/// The whole string and any run of its elements are assembled from the same value, so the sum of
/// the parts equals the whole.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"
#include "model/Substructure.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drilling/PointOnString.hpp"
#include "substructures/drillstring/Partition.hpp"

namespace tooljoint::drillstring {

constexpr int kNodeDofs = beam::nodal::perNode;
/// Name of the point set of the borehole wall.
constexpr const char* kContactSet = "contact";

/// Element matrices of one origin in nodal frames, times a law of time.
struct ElementTerm {
  std::string name;                      ///< "gyroscopic", "mud drag", ...
  int law = 0;                           ///< index into StringModel::laws
  std::vector<beam::Matrix12> matrices;  ///< one per element
};

/// Nodal loads of one origin in nodal frames, times a law of time.
struct NodalLoad {
  std::string name;
  int law = 0;
  Vector vector;  ///< 6 nodes [N, N m]
};

/// A batch of contact points at `nodes` (0-based, increasing), in the coordinates of
/// contact::contactComponents().
struct ContactBatch {
  std::shared_ptr<const model::PointLaw> law;  ///< null: no contact in this scene
  std::vector<int> nodes;
};

/// Dofs D are measured from the path state in nodal frames, 6 per node.
struct StringModel {
  int nodes = 0;
  std::vector<char> held;  ///< 6 nodes; 1 where a support holds the dof
  std::vector<model::ScalarLaw> laws{model::ScalarLaw::one()};
  std::vector<beam::Matrix12> mass;
  std::vector<ElementTerm> damping;
  std::vector<ElementTerm> stiffness;
  std::vector<NodalLoad> loads;
  ContactBatch contact;
  std::vector<drilling::PointOnString> drilling;  ///< laws of bit and top drive, if any
  Vector state;  ///< static displacement D_s, 6 nodes; the motion starts here at rest

  int elements() const { return static_cast<int>(mass.size()); }
  int freeDofs() const;
  int lawIndex(const model::ScalarLaw& law);
};

/// Names u, v, w, theta_x, theta_y, theta_z.
const model::ComponentNames& componentNames();

/// The whole string in total displacements of its free dofs, node by node.
model::SecondOrderModel assemble(const StringModel& string);

/// One part: its elements, with loads and contact at the nodes it owns (all its nodes except the
/// first, which belongs to the part above). Nodes shared with its neighbours are the interface.
/// `retained` (positions 6 node + component in the whole string) applies to the dofs of the part.
/// If `contactAt` is not null, contact is restricted to these nodes (0-based, increasing).
model::Substructure assemblePart(const StringModel& string, const PartRange& range,
                                 const std::vector<int>& retained,
                                 const std::vector<int>* contactAt);

}  // namespace tooljoint::drillstring
