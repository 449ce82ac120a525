// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// User vectors: their span, and possible errors of a file.
#include <Eigen/Dense>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "coupling/Synthesis.hpp"
#include "io/MatrixMarket.hpp"
#include "linalg/Deterministic.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/BasisFamilies.hpp"
#include "tests/support/ErrorText.hpp"

namespace UserVectorsTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

using Change = std::function<void(Teuchos::ParameterList&)>;

std::unique_ptr<ReductionMethod> basisOf(const std::string& file, const Change& change = {}) {
  Teuchos::ParameterList list("Reduction");
  list.sublist("User Vectors").set("File", file);
  if (change) change(list.sublist("User Vectors"));
  return makeBasis("User Vectors", list);
}

void write(const std::string& file, const Matrix& vectors) {
  std::ofstream(file) << io::matrixMarketText(vectors);
}

model::Substructure bar(const std::string& name = "bar") {
  auto part = samples::bar(name, 1, 8, 3.0, 2.0);
  samples::classify(part, {1, 9});
  return part;
}

TEST(UserVectors, FixedInterfaceModesFromAFileAreCraigBampton) {
  const auto reference =
      makeBasis("Craig-Bampton", Teuchos::ParameterList())->build(bar(), samples::modes(4));
  // Any mixture of the modes, with constraint modes added: the span is the same.
  const Matrix mixed = Matrix(reference.vectors) * linalg::scatteredNumbers(6, 4, 3);
  write("mixed.mtx", mixed);
  const auto basis = basisOf("mixed.mtx")->build(bar(), samples::modes(4));
  EXPECT_LT((basis.eigenvalues - reference.eigenvalues).norm(),
            1e-10 * reference.eigenvalues.norm());
  EXPECT_LT((Matrix(basis.vectors) - Matrix(reference.vectors)).norm(), 1e-9);
  const auto small = reduce(bar(), basis, ReductionOptions(), 0);
  EXPECT_TRUE(small.report.structureEnforced);
  EXPECT_LT(small.report.staticDefect, 1e-12);
}

TEST(UserVectors, TheFirstColumnsAreTaken) {
  write("many.mtx", linalg::scatteredNumbers(9, 5, 11));
  EXPECT_EQ(basisOf("many.mtx")->build(bar(), samples::modes(2)).modes(), 2);
  EXPECT_EQ(basisOf("many.mtx")->build(bar(), samples::modes(0)).modes(), 0);
  const auto all = basisOf("many.mtx")->build(bar(), samples::modes(9));
  EXPECT_EQ(all.modes(), 5);
  ASSERT_EQ(all.remarks.size(), 1u);
  EXPECT_EQ(all.remarks[0], "requested 9 modes, many.mtx has 5 vectors");
}

TEST(UserVectors, SparseFilesWillDo) {
  Sparse unit(9, 2);
  unit.insert(3, 0) = 1.0;
  unit.insert(5, 1) = 2.0;
  std::ofstream("unit.mtx") << io::matrixMarketText(unit);
  EXPECT_EQ(basisOf("unit.mtx")->build(bar(), ModeRequest()).modes(), 2);
}

TEST(UserVectors, EveryPartHasItsOwnFileAlsoWhenTheyAreIdentical) {
  std::vector<model::Substructure> parts{bar("one"), samples::bar("two", 9, 8, 3.0, 2.0)};
  samples::classify(parts[0], {9}, {1});
  samples::classify(parts[1], {9}, {17});
  parts[0].interface = {8};
  parts[0].retained = {0};
  write("of one.mtx", linalg::scatteredNumbers(9, 2, 1));
  write("of two.mtx", linalg::scatteredNumbers(9, 2, 2));
  ReductionOptions options;
  options.basis = "User Vectors";
  const auto reduced = coupling::synthesise(parts, *basisOf("of %.mtx"), options).parts;
  EXPECT_TRUE(reduced[1].report.sharedWith.empty());
  EXPECT_GT((reduced[0].basis->eigenvalues - reduced[1].basis->eigenvalues).norm(), 1e-3);
}

TEST(UserVectors, OtherPartsTakeFixedInterfaceModes) {
  write("some.mtx", linalg::scatteredNumbers(9, 3, 1));
  const auto basis = basisOf("some.mtx", [](auto& list) {
    list.set("Substructures", Teuchos::Array<std::string>(Teuchos::tuple<std::string>("bar")));
  });
  EXPECT_EQ(basis->build(bar(), samples::modes(3)).modeKind[0], "user");
  EXPECT_EQ(basis->build(bar("other"), samples::modes(3)).modeKind[0], "fixed-interface");
}

TEST(UserVectors, AnUnknownPartIsRefused) {
  write("some.mtx", linalg::scatteredNumbers(9, 3, 1));
  ReductionOptions options;
  options.basis = "User Vectors";
  auto part = bar("column");
  part.retained = part.interface;
  part.interface.clear();
  const auto basis = basisOf("some.mtx", [](auto& list) {
    list.set("Substructures", Teuchos::Array<std::string>(Teuchos::tuple<std::string>("colum")));
  });
  EXPECT_NE(errorText([&] {
              coupling::synthesise({part}, *basis, options);
            }).find("no substructure has this name; did you mean \"column\"?"),
            std::string::npos);
}

TEST(UserVectors, WrongSizesAreRefused) {
  write("short.mtx", linalg::scatteredNumbers(7, 2, 1));
  const auto sentence = errorText([] { basisOf("short.mtx")->build(bar(), samples::modes(2)); });
  EXPECT_NE(sentence.find("short.mtx: its vectors have 7 rows, but part \"bar\" has 9 dofs"),
            std::string::npos)
      << sentence;
}

TEST(UserVectors, DependentVectorsAreRefusedOrDropped) {
  Matrix vectors = linalg::scatteredNumbers(9, 4, 7);
  vectors.col(2) = vectors.col(0) - 3 * vectors.col(1);
  write("dependent.mtx", vectors);
  const auto sentence =
      errorText([] { basisOf("dependent.mtx")->build(bar(), samples::modes(4)); });
  EXPECT_NE(
      sentence.find("dependent.mtx: column 3 is a linear combination of the preceding columns"),
      std::string::npos)
      << sentence;
  const auto basis = basisOf("dependent.mtx", [](auto& list) {
                       list.set("Dependent Vectors", "Drop");
                     })->build(bar(), samples::modes(4));
  EXPECT_EQ(basis.modes(), 3);
  ASSERT_EQ(basis.remarks.size(), 1u);
  EXPECT_EQ(basis.remarks[0], "dependent vectors of dependent.mtx are dropped: columns 3");
}

TEST(UserVectors, AConstraintModeAddsNothing) {
  Matrix straight(9, 1);
  for (int i = 0; i < 9; ++i) straight(i, 0) = 1 + 2.0 * i;
  write("straight.mtx", straight);
  EXPECT_NE(errorText([] {
              basisOf("straight.mtx")->build(bar(), samples::modes(1));
            }).find("column 1 is a linear combination"),
            std::string::npos);
}

TEST(UserVectors, MissingFilesAndListsAreRefused) {
  EXPECT_NE(errorText([] {
              basisOf("absent %.mtx")->build(bar(), samples::modes(1));
            }).find("absent bar.mtx"),
            std::string::npos);
  EXPECT_NE(errorText([] {
              makeBasis("User Vectors", Teuchos::ParameterList("Reduction"));
            }).find("has no list \"User Vectors\". Add the list with its \"File\""),
            std::string::npos);
}

}  // namespace UserVectorsTest
