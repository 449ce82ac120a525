// SPDX-License-Identifier: BSD-3-Clause
// DMIG entries of Nastran: written entries are read again, every form of a field is accepted, and
// errors name line and field.
#include <Eigen/Dense>
#include <fstream>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "parts/file/PartFile.hpp"
#include "parts/foreign/ForeignWriters.hpp"
#include "parts/foreign/PartFormat.hpp"
#include "tests/support/SampleParts.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace tooljoint::parts {
namespace NastranDmigTest {

using model::DofLabel;

class PunchFile {
 public:
  explicit PunchFile(const std::string& text) { std::ofstream(path()) << text; }
  std::string path() const { return scratch_ / "part.pch"; }
  PartContent read() const { return readPart(path(), "wing"); }
  void expect(const std::string& sentence) const {
    try {
      read();
      FAIL() << "was read";
    } catch (const DeckError& error) {
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  }

 private:
  test::Scratch scratch_;
};

/// A header with the mass of component 1 of points 7 and 12, so that a test adds only the
/// stiffness.
std::string withMass(const std::string& stiffness) {
  return "DMIG    MAAX           0       6       2       0\n"
         "DMIG*   MAAX                           7               1\n"
         "*                      7               1 2.000000000D+00\n"
         "DMIG*   MAAX                          12               1\n"
         "*                     12               1 3.000000000D+00\n" +
         stiffness;
}

const std::string symmetricHeader = "DMIG    KAAX           0       6       2       0\n";

Matrix stiffness(const PartContent& part) { return Matrix(part.part.model.stiffnessAt(0)); }
Matrix two(double a, double b, double c, double d) {
  return (Matrix(2, 2) << a, b, c, d).finished();
}

TEST(NastranDmig, NumbersOfFortran) {
  const auto read = [](const std::string& text) {
    double value = 0.0;
    return fortranNumber(text, true, value) ? value : -999.0;
  };
  EXPECT_EQ(read("-1.5-3"), -1.5e-3);
  EXPECT_EQ(read("+2.D+2"), 200.0);
  EXPECT_EQ(read(".5d-1"), 0.05);
  EXPECT_EQ(read("7.E2"), 700.0);
  for (const char* text :
       {"", "7", ".", "1.5E", "1.5DD3", "1.5E+-3", "1.2.3", "x", "1. 5", "1.E999"})
    EXPECT_EQ(read(text), -999.0) << text;
}

TEST(NastranDmig, LargeFieldWithDoubleExponents) {
  const auto part =
      PunchFile(withMass("$ a comment\n" + symmetricHeader +
                         "DMIG*   KAAX                           7               1\n"
                         "*                      7               1 1.500000000D+03\n"
                         "*                     12               1-2.50000000D+002\n"
                         "DMIG*   KAAX                          12               1\n"
                         "*                     12               1 4.000000000D+02\n"))
          .read();
  EXPECT_EQ(stiffness(part), two(1500, -250, -250, 400));
  EXPECT_EQ(Matrix(part.part.model.mass), two(2, 0, 0, 3));
  EXPECT_EQ(part.part.model.componentNames, (std::vector<std::string>{"u"}));
}

TEST(NastranDmig, SmallFieldAndFreeFormat) {
  const Matrix expected = two(60000, 4.1e8, 4.1e8, 7);
  const std::string small =
      "DMIG    KAAX    7       1               7       1       6.+4            +a\n"
      "+a      12      1       4.1+8\n"
      "DMIG    KAAX    12      1               12      1       7.0\n";
  EXPECT_EQ(stiffness(PunchFile(withMass(symmetricHeader + small)).read()), expected);
  const std::string free =
      "dmig,KAAX,0,6,2\n"
      "DMIG,kaax,7,1,,7,1,6.E4,0.0,+\n"
      "+,12,1,4.1D8\n"
      "DMIG*,KAAX,12,1,,*\n"
      "*,12,1,7.\n";
  EXPECT_EQ(stiffness(PunchFile(withMass(free)).read()), expected);
}

TEST(NastranDmig, EitherTriangleOrBothOfASymmetricMatrix) {
  const auto columns = [](const std::string& lower, const std::string& upper) {
    return withMass("DMIG,KAAX,0,6,2\nDMIG,KAAX,7,1,,7,1,5.0\n" + lower +
                    "DMIG,KAAX,12,1,,12,1,4.0\n" + upper);
  };
  const std::string below = ",12,1,-3.0\n", above = ",7,1,-3.0\n";
  for (const auto& text : {columns(below, ""), columns("", above), columns(below, above)})
    EXPECT_EQ(stiffness(PunchFile(text).read()), two(5, -3, -3, 4));
  PunchFile(columns(below, ",7,1,-3.1\n"))
      .expect(
          "part.pch:10 gives the entry of component 1 of point 7 and component 1 of point 12 "
          "of a symmetric matrix as -3.1, but line 8 gives its transpose as -3");
  PunchFile(columns(below + ",12,1,-3.0\n", "")).expect("twice; it stands in line 8");
}

TEST(NastranDmig, SquareMatrixKeepsItsTriangles) {
  const auto part = PunchFile(withMass("DMIG,K2GG,0,1,2\nDMIG,K2GG,7,1,,7,1,5.0,,\n"
                                       ",12,1,-3.0\nDMIG,K2GG,12,1,,12,1,4.0,,\n,7,1,2.0\n"))
                        .read();
  EXPECT_EQ(stiffness(part), two(5, 2, -3, 4));  // column entries: row 12, column 7 is -3
}

TEST(NastranDmig, OrderOfTheDofsIsThatOfTheLabels) {
  // columns and rows are not sorted, component 5 of point 3 is last in the file
  const auto part = PunchFile(
                        "DMIG,KAAX,0,6,2\nDMIG,MAAX,0,6,2\n"
                        "DMIG,KAAX,12,2,,12,2,4.0\nDMIG,KAAX,12,1,,12,1,3.0\n"
                        "DMIG,KAAX,3,5,,3,5,2.0\nDMIG,KAAX,100,,,100,,9.0\n"
                        "DMIG,MAAX,12,1,,12,1,1.0\n")
                        .read();
  EXPECT_EQ(part.part.model.componentNames,
            (std::vector<std::string>{"u", "v", "w", "theta_x", "theta_y", "s"}));
  EXPECT_EQ(part.part.model.dofs,
            (std::vector<DofLabel>{DofLabel::physical(3, 4), DofLabel::physical(12, 0),
                                   DofLabel::physical(12, 1), DofLabel::physical(100, 5)}));
  EXPECT_EQ(Vector(stiffness(part).diagonal()), (Vector(4) << 2, 3, 4, 9).finished());
  EXPECT_EQ(Vector(Matrix(part.part.model.mass).diagonal()), (Vector(4) << 0, 1, 0, 0).finished());
}

TEST(NastranDmig, DampingLoadsAndPositions) {
  const std::string base =
      "SOL 103\nCEND\nK2GG = KAAX\nBEGIN SUPER = 4\nGRID,7,,1.5,-2.,3.+1\nGRID,12,9,1.,1.,1.\n"
      "GRID,99,,0.,0.,0.\nSPOINT,5\n" +
      withMass(
          "DMIG,KAAX,0,6,2\nDMIG,KAAX,7,1,,7,1,1.0\nDMIG,BAAX,0,6,2\n"
          "DMIG,BAAX,12,1,,12,1,0.25\nDMIG,PAX,0,9,2,0,,,2\nDMIG,PAX,1,0,,7,1,10.0\n");
  const auto one =
      PunchFile(base + "CORD2R,9,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nENDDATA\nno more\n").read();
  EXPECT_EQ(Matrix(one.part.model.dampingAt(0)), two(0, 0, 0, 0.25));
  EXPECT_EQ(one.part.model.loadAt(0), (Vector(2) << 10, 0).finished());
  ASSERT_EQ(one.positions.size(), 1U);  // point 12 is given in another frame
  EXPECT_EQ(one.positions.at(7), Vector3(1.5, -2, 30));
  // each of several load cases has a law given by the deck
  const auto several = PunchFile(base + "DMIG,PAX,2,0,,12,1,20.0\n").read().part.model;
  ASSERT_EQ(several.loads.size(), 2U);
  EXPECT_EQ(several.loads[1].vector, (Vector(2) << 0, 20).finished());
  EXPECT_EQ(several.laws[static_cast<std::size_t>(several.loads[1].law)].name, "PAX 2");
}

TEST(NastranDmig, NamesFaultsByLineAndField) {
  const auto stiff = [](const std::string& text) { return PunchFile(withMass(text)); };
  stiff("DMIG,KAAX,0,6,4\n")
      .expect(
          "part.pch:6 gives the matrix \"KAAX\" the complex type TIN = 4. A part is real: "
          "expected 1 (real single) or 2 (real double)");
  stiff("DMIG,KAAX,0,7,2\n")
      .expect(
          "part.pch:6: field 4 is \"7\", expected a form IFO: 1 (square), 2 or 9 "
          "(rectangular) or 6 (symmetric)");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,7,8,,7,1,1.0\n")
      .expect("part.pch:7: field 4 is \"8\", expected a component from 1 to 6, or 0 or blank");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,0x,1,,7,1,1.0\n")
      .expect("part.pch:7: field 3 is \"0x\", expected the number of a grid point");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,7,1,,7,1,12\n")
      .expect("part.pch:7: field 8 is \"12\", expected a finite real number with a decimal point");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,7,1,,7,1,1.0,2.0\n")
      .expect("field 9 is \"2.0\", expected a blank field or 0.0: the matrix is real");
  stiff("DMIG,KAAX,7,1,,7,1,1.0\n").expect("\"KAAX\", which has no header");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,0,6,2\n")
      .expect("part.pch:7 is a second header of the matrix \"KAAX\"; the first is in line 6");
  stiff("DMIG,KAAX,0,6,2\nCBAR,1,1,7,12\n").expect("part.pch:7 is an entry \"CBAR\"");
  stiff("DMIG,K4AAX,0,6,2\n").expect("\"K4AAX\" is structural damping");
  stiff("DMIG,XYZ,0,6,2\n").expect("has a name that does not say what it is");
  stiff("DMIG,KAAX,0,9,2,0,,,3\n").expect("has numbered columns (IFO 9)");
  stiff("DMIG,MUG1,0,2,2\n").expect("is rectangular (IFO 2) and no mass");
  stiff("DMIG,MUG1,0,9,2\n").expect("is rectangular (IFO 9) and no mass");
  stiff("DMIG,KAAX,0,6,2\n").expect("\"KAAX\" has a header, but no column: the file is cut short");
  PunchFile("BEGIN BULK\n" + withMass("begin super=2\nDMIG,KAAX,0,6,2\n"))
      .expect("part.pch:7 begins a second section of bulk data; the first begins in line 1");
  stiff("").expect("part.pch has no stiffness matrix. A part needs mass and stiffness");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,7,,,7,,1.0\n")
      .expect("point 7 is a scalar point (component 0) and has component 1");
  stiff("DMIG,KAAX,0,6,2\nDMIG,KAAX,7,1,,7,1,1.0\nDMIG,PAX,0,9,2,,,,1\nDMIG,PAX,1,,,8,1,1.0\n")
      .expect("the load \"PAX\" acts on component 1 of point 8, which neither mass nor stiffness");
  PunchFile("+       1\n").expect("part.pch:1 continues no entry");
  PunchFile("$ empty\n").expect("has no DMIG entry");
  PunchFile("GRID,1,,0.,0.,0.,7\n").expect("field 7 is \"7\", expected 0 or blank");
}

/// A free plane beam, u v theta: the rigid motions make its stiffness singular.
PartContent freeBeam() {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {3, 1}}};
  PartContent content;
  content.part = samples::framePart("free beam", frame, {{1, 2, {101, 102, 103}}});
  content.part.model.damping.push_back({"C", Sparse(0.02 * content.part.model.mass), 0});
  content.part.model.loads.push_back(
      {"weight", Vector::LinSpaced(content.part.model.size(), -1, 1), 0});
  content.positions = {{1, {0, 0, 0}}, {103, {2.25, 0.75, 0}}};
  return content;
}

/// Rows and columns of `a` in the order of the labels of `b`, components by name.
Matrix inOrderOf(const PartContent& a, const PartContent& b, const Matrix& A) {
  const auto nameOf = [](const PartContent& part, const DofLabel& label) {
    return std::make_pair(
        label.entity, part.part.model.componentNames[static_cast<std::size_t>(label.component)]);
  };
  std::map<std::pair<std::int64_t, std::string>, Eigen::Index> row;
  for (const auto& label : a.part.model.dofs)
    row.emplace(nameOf(a, label), static_cast<Eigen::Index>(row.size()));
  std::map<std::string, std::string> names{{"theta_z", "theta"}};
  const auto n = static_cast<Eigen::Index>(b.part.model.dofs.size());
  Matrix out(n, A.cols() == 1 ? 1 : n);
  const auto at = [&](Eigen::Index i) {
    auto key = nameOf(b, b.part.model.dofs[static_cast<std::size_t>(i)]);
    if (names.count(key.second) > 0) key.second = names[key.second];
    return row.at(key);
  };
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j) out(i, j) = A(at(i), A.cols() == 1 ? 0 : at(j));
  return out;
}

void expectClose(const Matrix& a, const Matrix& b) {
  ASSERT_EQ(a.rows(), b.rows());
  // ten digits of a field at least, eleven with an exponent of one digit
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-10 * a.cwiseAbs().maxCoeff());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      EXPECT_NEAR(a(i, j), b(i, j), 6e-10 * std::abs(a(i, j)) + 1e-300) << i << ", " << j;
}

TEST(NastranDmig, FreeBeamComesBackToTheDigitsOfAField) {
  const auto beam = freeBeam();
  const PunchFile file(dmigText(beam));
  const auto back = file.read();
  EXPECT_EQ(back.part.model.componentNames, gridComponents());
  expectClose(inOrderOf(beam, back, Matrix(beam.part.model.mass)), Matrix(back.part.model.mass));
  expectClose(inOrderOf(beam, back, stiffness(beam)), stiffness(back));
  expectClose(inOrderOf(beam, back, Matrix(beam.part.model.dampingAt(0))),
              Matrix(back.part.model.dampingAt(0)));
  expectClose(inOrderOf(beam, back, beam.part.model.loadAt(0)), back.part.model.loadAt(0));
  EXPECT_EQ(back.positions.at(103), Vector3(2.25, 0.75, 0));
}

TEST(NastranDmig, ModesBecomeScalarPointsAndZeroMassStays) {
  PartContent content;
  content.part = samples::bar("bar", 3, 3, 1.0 / 3.0, 6.0);
  auto& m = content.part.model;
  m.dofs[1] = DofLabel::modal(0, 0);
  m.dofs[2] = DofLabel::modal(0, 1);
  Sparse mass(4, 4);
  mass.insert(1, 1) = 1.0;  // the other modes have none
  m.mass = mass;
  const auto back = PunchFile(dmigText(content)).read();
  EXPECT_EQ(back.part.model.componentNames, (std::vector<std::string>{"u", "s"}));
  EXPECT_EQ(back.part.model.dofs,
            (std::vector<DofLabel>{DofLabel::physical(3, 0), DofLabel::physical(6, 0),
                                   DofLabel::physical(7, 1), DofLabel::physical(8, 1)}));
  EXPECT_EQ(Vector(Matrix(back.part.model.mass).diagonal()), (Vector(4) << 0, 0, 1, 0).finished());
  const std::vector<int> order{0, 3, 1, 2};
  const Matrix K = stiffness(content), again = stiffness(back);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      EXPECT_NEAR(again(i, j),
                  K(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]), 1e-11);
}

TEST(NastranDmig, UnsymmetricStiffnessIsWrittenSquare) {
  auto beam = freeBeam();
  auto& m = beam.part.model;
  Sparse skew(m.size(), m.size());
  skew.insert(0, 1) = 40.0;
  skew.insert(1, 0) = -40.0;
  m.stiffness.push_back({"torque", skew, 0});
  const auto text = dmigText(beam);
  EXPECT_NE(text.find("DMIG    KAAX           0       1       2       0\n"), std::string::npos);
  const auto back = PunchFile(text).read();
  expectClose(inOrderOf(beam, back, stiffness(beam)), stiffness(back));
  m.damping.push_back({"gyroscopic", skew, m.lawIndex(samples::spin())});
  EXPECT_THROW(dmigText(beam), ModelError);
}

TEST(NastranDmig, JsonFileBesideItGivesTheSets) {
  const test::Scratch scratch;
  std::ofstream(scratch / "beam.pch") << dmigText(freeBeam());
  const auto json = [&](const std::string& more) {
    std::ofstream(scratch / "part.json")
        << R"({"format": "tooljoint part 1", "matrices": "beam.pch")" << more << "}";
    return readPart(scratch.folder(), "beam");
  };
  const auto part = json(R"(, "interfaces": {"tip": [2], "slope": [[1, "theta_z"], [1, 1]]})");
  ASSERT_EQ(part.interfaces.size(), 2U);
  EXPECT_EQ(part.interfaces[0].name, "tip");
  EXPECT_EQ(part.interfaces[0].dofs, (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(part.interfaces[1].dofs, (std::vector<int>{2, 0}));
  EXPECT_EQ(part.part.interface, (std::vector<int>{0, 2, 3, 4, 5}));
  EXPECT_THROW(json(R"(, "dofs": [[1, "u"]])"), DeckError);
}

}  // namespace NastranDmigTest
}  // namespace tooljoint::parts
