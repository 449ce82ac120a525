// SPDX-License-Identifier: BSD-3-Clause
// Positions of the nodes of imported parts: turned and moved so that joined nodes meet.
#include "parts/PartsGeometry.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/SampleParts.hpp"

namespace tooljoint::parts {
namespace PartsGeometryTest {

/// Bars of two elements of 1 m along x; node n of part p has the number 10 p + n unless joined.
class PartsGeometry : public ::testing::Test {
 protected:
  void addBar(const std::map<int, std::int64_t>& joined = {}, bool placed = true,
              const Matrix3& axes = Matrix3::Identity()) {
    const int p = static_cast<int>(scene_.parts.size());
    PartContent content;
    content.part = samples::bar("bar", 1, 2, 1e6, 2.0);
    auto part = content.part;
    for (int node = 1; node <= 3; ++node) {
      const auto other = joined.find(node);
      const std::int64_t number = other == joined.end() ? 10 * p + node : other->second;
      if (placed) content.positions[node] = Vector3(node - 1.0, 0, 0);
      scene_.nodes[number].push_back({p, node});
      part.model.dofs[static_cast<std::size_t>(node - 1)] = model::DofLabel::physical(number, 0);
    }
    scene_.contents.push_back(std::move(content));
    scene_.parts.push_back(std::move(part));
    imported_.emplace_back();
    imported_.back().axes = axes;
  }
  std::map<std::int64_t, Vector3> positions() const { return nodePositions(scene_, imported_); }

  /// x of a part is y of the frame.
  static Matrix3 quarterTurn() { return (Matrix3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(); }

  PartsScene scene_;
  std::vector<ImportedPart> imported_;
};

void expectAt(const Vector3& found, double x, double y, double z) {
  EXPECT_LT((found - Vector3(x, y, z)).norm(), 1e-14) << found.transpose();
}

TEST_F(PartsGeometry, JoinedPartsMeetAndTurnedOnesGoOnInTheirDirection) {
  addBar();
  addBar({{1, 3}}, true, quarterTurn());
  const auto found = positions();
  ASSERT_EQ(found.size(), 5u);
  expectAt(found.at(3), 2, 0, 0);
  expectAt(found.at(12), 2, 1, 0);
  expectAt(found.at(13), 2, 2, 0);
}

TEST_F(PartsGeometry, AChainIsPlacedWhateverTheOrderOfItsParts) {
  addBar();
  addBar({{1, 23}});  // joined only with the next part
  addBar({{1, 3}});
  const auto found = positions();
  expectAt(found.at(22), 3, 0, 0);
  expectAt(found.at(23), 4, 0, 0);
  expectAt(found.at(13), 6, 0, 0);
}

TEST_F(PartsGeometry, PartsThatShareNothingKeepTheirOrigin) {
  addBar();
  addBar({}, true, quarterTurn());
  expectAt(positions().at(13), 0, 2, 0);
}

TEST_F(PartsGeometry, PartsWithoutPositionsAreLeftOut) {
  addBar();
  addBar({{1, 3}}, false);
  EXPECT_EQ(positions().size(), 3u);
  EXPECT_TRUE(positions().count(12) == 0);
}

TEST_F(PartsGeometry, LinksAreTheElements) {
  addBar();
  addBar({{1, 3}});
  const std::set<std::pair<std::int64_t, std::int64_t>> elements{{1, 2}, {2, 3}, {3, 12}, {12, 13}};
  EXPECT_EQ(nodeLinks(scene_), elements);
}

TEST_F(PartsGeometry, DensePartsHaveNoLinks) {
  constexpr int nodes = 40;  // 780 pairs, 19.5 for each node
  model::Substructure part;
  for (int node = 1; node <= nodes; ++node)
    part.model.dofs.push_back(model::DofLabel::physical(node, 0));
  const Matrix dense = Matrix::Ones(nodes, nodes);
  part.model.stiffness.push_back({"dense", Sparse(dense.sparseView()), 0});
  scene_.parts.push_back(part);
  EXPECT_TRUE(nodeLinks(scene_).empty());
}

}  // namespace PartsGeometryTest
}  // namespace tooljoint::parts
