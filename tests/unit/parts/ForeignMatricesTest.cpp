// SPDX-License-Identifier: BSD-3-Clause
// Matrices of Abaqus and Ansys, and the superelement of OpenFAST: parts are read from text in the
// layouts of the manuals, and errors name line and field.
#include <Eigen/Dense>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "common/Error.hpp"
#include "parts/file/PartFile.hpp"
#include "parts/foreign/ForeignWriters.hpp"
#include "parts/foreign/PartFormat.hpp"
#include "tests/support/SampleParts.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace tooljoint::parts {
namespace ForeignMatricesTest {

using model::DofLabel;

/// Files of one part.
class Folder {
 public:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_ / name) << text;
  }
  PartContent read(const std::string& name) const { return readPart(scratch_ / name, "wing"); }
  void expect(const std::string& name, const std::string& sentence) const {
    try {
      read(name);
      FAIL() << "was read";
    } catch (const DeckError& error) {
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  }

 private:
  test::Scratch scratch_;
};

Matrix stiffness(const PartContent& part) { return Matrix(part.part.model.stiffnessAt(0)); }

/// A free plane beam with u, v (components 1, 2) and theta (6), labels in ascending order.
model::Substructure freeBeam() {
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {4, {3, 1}}};
  auto beam = samples::framePart("free beam", frame, {{1, 4, {2, 3}}});
  return beam;
}

/// Node and number (1, 2, 6) of row i of the beam; nodes are placed in the order 1, 2, 3, 4.
std::pair<int, int> labelOf(const model::Substructure& beam, Eigen::Index i) {
  const auto& label = beam.model.dofs[static_cast<std::size_t>(i)];
  return {static_cast<int>(label.entity), label.component == 2 ? 6 : label.component + 1};
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.16e", value);
  return text;
}

/// Lines "node, dof, node, dof, value" of the lower triangle, rows from the last to the first.
std::string abaqusText(const model::Substructure& beam, const Matrix& A) {
  std::string text = "** a comment\n";
  for (Eigen::Index i = A.rows() - 1; i >= 0; --i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto row = labelOf(beam, i), column = labelOf(beam, j);
      if (A(i, j) != 0.0)
        text += std::to_string(row.first) + "," + std::to_string(row.second) + ", " +
                std::to_string(column.first) + "," + std::to_string(column.second) + ",  " +
                number(A(i, j)) + "\n";
    }
  return text;
}

void expectBeam(const model::Substructure& beam, const PartContent& back) {
  const auto& m = back.part.model;
  ASSERT_EQ(m.size(), beam.model.size());
  EXPECT_EQ(m.componentNames, gridComponents());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const auto label = labelOf(beam, i);
    EXPECT_EQ(m.dofs[static_cast<std::size_t>(i)],
              DofLabel::physical(label.first, label.second - 1));
  }
  const Matrix K = beam.model.stiffnessAt(0), M = beam.model.mass;
  // 17 digits, but only one of two transposed entries is written
  EXPECT_LE((stiffness(back) - K).cwiseAbs().maxCoeff(), 1e-14 * K.cwiseAbs().maxCoeff());
  EXPECT_LE((Matrix(m.mass) - M).cwiseAbs().maxCoeff(), 1e-14 * M.cwiseAbs().maxCoeff());
}

TEST(AbaqusMatrices, FreeBeamComesBackFromTheStiffnessFile) {
  const Folder folder;
  const auto beam = freeBeam();
  folder.write("job_STIF2.mtx", abaqusText(beam, Matrix(beam.model.stiffnessAt(0))));
  folder.write("job_MASS2.mtx", abaqusText(beam, Matrix(beam.model.mass)));
  folder.write("job_DMPV2.mtx", "1,1, 1,1, 0.5\n");
  folder.write("job_LOAD2.mtx", "*CLOAD, REAL\n4, 2, -100.\n4, 2, -1.5\n");
  folder.write("job_MASS1.mtx", "not of this step\n");
  const auto back = folder.read("job_STIF2.mtx");
  expectBeam(beam, back);
  EXPECT_EQ(Matrix(back.part.model.dampingAt(0))(0, 0), 0.5);
  EXPECT_EQ(back.part.model.loadAt(0)[10], -101.5);  // v of node 4
  expectBeam(beam, folder.read("job_MASS2.mtx"));
}

/// An Abaqus job whose second dof has stiffness but no mass.
struct AbaqusJob : Folder {
  explicit AbaqusJob(const std::string& stiffness) {
    write("a_STIF1.mtx", stiffness);
    write("a_MASS1.mtx", "3,1, 3,1, 2.0\n");
  }
  Matrix stiffnessMatrix() const { return stiffness(read("a_STIF1.mtx")); }
  void refuses(const std::string& sentence) const { expect("a_STIF1.mtx", sentence); }
};

TEST(AbaqusMatrices, OneTriangleOrBoth) {
  const Matrix symmetric = (Matrix(2, 2) << 5, -3, -3, 4).finished();
  EXPECT_EQ(AbaqusJob("3,1,3,1,5.\n8,1,3,1,-3.\n8,1,8,1,4.\n").stiffnessMatrix(), symmetric);
  EXPECT_EQ(AbaqusJob("8 1 8 1 4.\n3 1 8 1 -3.0D0\n3 1 3 1 5\n").stiffnessMatrix(), symmetric);
  EXPECT_EQ(AbaqusJob("3,1,3,1,5.\n8,1,3,1,-3.\n3,1,8,1,-2.\n8,1,8,1,4.\n").stiffnessMatrix(),
            (Matrix(2, 2) << 5, -2, -3, 4).finished());
  const std::string lower = "3,1,3,1,5.\n8,1,3,1,-3.\n8,1,8,1,4.\n";
  EXPECT_EQ(AbaqusJob("*MATRIX INPUT, NAME=K, type=unsymmetric\n" + lower).stiffnessMatrix(),
            (Matrix(2, 2) << 5, 0, -3, 4).finished());
  EXPECT_EQ(AbaqusJob("*matrix input, TYPE = SYMMETRIC\n" + lower).stiffnessMatrix(), symmetric);
  const auto part = AbaqusJob("3,1,3,1,5.\n8,1,8,1,4.\n").read("a_STIF1.mtx").part.model;
  EXPECT_EQ(Matrix(part.mass), (Matrix(2, 2) << 2, 0, 0, 0).finished());  // singular, and accepted
}

/// Zeros may appear in both triangles of a triangular file; other pairs beside single entries may
/// not.
TEST(AbaqusMatrices, ZerosInBothTrianglesAreNoFullMatrix) {
  const std::string triangle = "3,1,3,1,5.\n8,1,3,1,-3.\n8,1,8,1,4.\n9,1,8,1,-1.\n9,1,9,1,2.\n";
  const Matrix expected = AbaqusJob(triangle).stiffnessMatrix();
  EXPECT_EQ(expected, expected.transpose());
  EXPECT_EQ(AbaqusJob(triangle + "9,1,3,1,0.\n3,1,9,1,0.\n").stiffnessMatrix(), expected);
  AbaqusJob(triangle + "3,1,8,1,-3.\n")
      .refuses("in both triangles, but that of component 1 of point 9 and component 1 of point 8");
  const Matrix full = AbaqusJob(triangle + "3,1,8,1,-2.\n").stiffnessMatrix();
  EXPECT_EQ(full(0, 1), -2.0);
  EXPECT_EQ(full(1, 2), 0.0) << "a matrix with unequal pairs is given whole";
}

TEST(AbaqusMatrices, HeldDofsAreLeftOut) {
  const AbaqusJob job("3,1,3,1,5.\n8,2,8,2,1.0E+36\n9,1,9,1,4.\n");
  EXPECT_EQ(job.read("a_STIF1.mtx").part.model.dofs,
            (std::vector<DofLabel>{DofLabel::physical(3, 0), DofLabel::physical(9, 0)}));
}

TEST(AbaqusMatrices, NamesFaultsByLineAndField) {
  AbaqusJob("** x\n3,1,3,1,5.\n8,11,8,11,4.\n")
      .refuses("a_STIF1.mtx:3: field 2 is \"11\", expected a displacement or rotation, 1 to 6");
  AbaqusJob("3,1,3,1,5.\n-8,1,-8,1,4.\n")
      .refuses(
          "a_STIF1.mtx:2: field 1 is \"-8\", expected a node from 1. Negative ones are internal");
  AbaqusJob("3,1,3,1,5.0.0\n")
      .refuses("a_STIF1.mtx:1: field 5 is \"5.0.0\", expected a finite number");
  AbaqusJob("3,1,3,1,5.\n3,1,3,1,5.\n")
      .refuses(
          "a_STIF1.mtx:2 gives the entry of component 1 of point 3 and component 1 of point 3 "
          "twice");
  AbaqusJob("1 1 5.\n").refuses("has 3 numbers: FORMAT=COORDINATE has no labels of dofs");
  AbaqusJob("3,1,3,1\n").refuses("has 4 numbers, expected 5: \"node, dof, node, dof, value\"");
  const std::string keyword = "*MATRIX INPUT, NAME=K, ";
  AbaqusJob(keyword + "SCALE FACTOR=2.\n3,1,3,1,5.\n")
      .refuses("gives \"SCALE FACTOR=2.\", expected of *MATRIX INPUT a NAME, and TYPE");
  AbaqusJob("3,1,3,1,5.\n" + keyword + "TYPE=SYMMETRIC\n")
      .refuses("a_STIF1.mtx:2 is the keyword \"*MATRIX INPUT, NAME=K, TYPE=SYMMETRIC\" below");
  AbaqusJob("*USER ELEMENT, NODES=4\n").refuses("is the keyword \"*USER ELEMENT, NODES=4\"");
  AbaqusJob("%%MatrixMarket matrix coordinate real general\n").refuses("is a Matrix Market file");
  const Folder alone;
  alone.write("a_STIF1.mtx", "3,1,3,1,5.\n");
  alone.expect("a_STIF1.mtx", "has no mass beside it: expected the file");
  alone.write("K.mtx", "3,1,3,1,5.\n");
  alone.expect("K.mtx", "is one matrix of a part. Name JOB_STIFn.mtx");
  alone.expect("L.mtx", "L.mtx cannot be read: No such file or directory.");
  alone.write("a_DMPS1.mtx", "3,1,3,1,5.\n");
  alone.expect("a_STIF1.mtx", "a_DMPS1.mtx is structural damping");
}

TEST(AbaqusMatrices, EmptyFilesAreNoMatrices) {
  for (const char* text : {"", "\n\n", "** only a comment\n"}) {
    AbaqusJob(text).refuses("a_STIF1.mtx has no entry of a matrix. Expected lines");
    const AbaqusJob job("3,1,3,1,5.\n"), damped("3,1,3,1,5.\n");
    job.write("a_MASS1.mtx", text);
    job.refuses("a_MASS1.mtx has no entry of a matrix");
    damped.write("a_DMPV1.mtx", text);
    damped.refuses("a_DMPV1.mtx has no entry of a matrix");
  }
}

TEST(AbaqusMatrices, NamedOneByOneInAPartFile) {
  const Folder folder;
  folder.write("K.mtx", "3,1,3,1,5.\n");
  folder.write("M.mtx", "3,1,3,1,2.\n");
  const auto json = [&](const std::string& matrices) {
    folder.write("part.json", R"({"format": "tooljoint part 1", "matrices": )" + matrices +
                                  R"(, "interfaces": {"tip": [3]}})");
  };
  json(R"({"stiffness": "K.mtx", "mass": "M.mtx"})");
  EXPECT_EQ(folder.read("part.json").part.interface, (std::vector<int>{0}));
  json(R"({"stiffness": "K.mtx"})");
  folder.expect("part.json", "\"matrices\" names no \"mass\"");
  json(R"({"stiffness": "K.mtx", "mas": "M.mtx"})");
  folder.expect("part.json", "\"matrices\" has the entry \"mas\". Available: \"stiffness\"");
}

/// A matrix as HBMAT writes it: one number a line, columns of the rows in `order`.
std::string harwellBoeing(const Matrix& A, const std::vector<int>& order, bool symmetric,
                          const Vector& rightSide = {}) {
  std::string starts, rows, values;
  int count = 0;
  const auto field = [](int number) {
    char text[40];
    std::snprintf(text, sizeof(text), "%14d\n", number);
    return std::string(text);
  };
  const auto real = [](double value) {
    char text[40];
    std::snprintf(text, sizeof(text), "%25.16E\n", value);
    std::string out = text;
    out[out.find('E')] = 'D';
    return out;
  };
  const auto n = static_cast<int>(order.size());
  for (int j = 0; j < n; ++j) {
    starts += field(count + 1);
    for (int i = symmetric ? j : 0; i < n; ++i) {
      const double value =
          A(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]);
      if (value == 0.0) continue;
      ++count;
      rows += field(i + 1);
      values += real(value);
    }
  }
  starts += field(count + 1);
  std::string side;
  for (Eigen::Index i = 0; i < rightSide.size(); ++i) side += real(rightSide[i]);
  std::ostringstream text;
  text << "Stiffness matrix from the assembled file                                 KEY\n"
       << 2 * count + n + 1 + rightSide.size() << " " << n + 1 << " " << count << " " << count
       << " " << rightSide.size() << "\n"
       << (symmetric ? "RSA" : "RUA") << "           " << n << " " << n << " " << count << " 0\n"
       << "(1i14)          (1i14)          (1d25.16)           (1d25.16)\n"
       << (rightSide.size() > 0 ? "F                        1             0\n" : "") << starts
       << rows << values << side;
  return text.str();
}

/// The beam in files of Ansys, with equations in another order than the labels.
struct AnsysJob : Folder {
  AnsysJob() {
    for (int i = 0; i < 12; ++i) order.push_back((7 * i + 3) % 12);
    mapping = "         Matrix Eqn      Node    DOF\n";
    const std::vector<std::string> names{"UX", "UY", "", "", "", "ROTZ"};
    for (int i = 0; i < 12; ++i) {
      const auto label = labelOf(beam, order[static_cast<std::size_t>(i)]);
      mapping += std::to_string(i + 1) + "    " + std::to_string(label.first) + "   " +
                 names[static_cast<std::size_t>(label.second - 1)] + "\n";
    }
    write("K.mapping", mapping);
    write("M.mapping", mapping);
    write("M.hb", harwellBoeing(Matrix(beam.model.mass), order, true));
    write("part.json",
          R"({"format": "tooljoint part 1", "matrices": {"stiffness": "K.hb", "mass": "M.hb"}})");
  }
  void refuses(const std::string& sentence) const { expect("part.json", sentence); }
  model::Substructure beam = freeBeam();
  std::vector<int> order;
  std::string mapping;
};

TEST(HarwellBoeing, FreeBeamComesBackByItsMapping) {
  const AnsysJob job;
  const Matrix K = job.beam.model.stiffnessAt(0);
  for (const bool symmetric : {true, false}) {
    job.write("K.hb", harwellBoeing(K, job.order, symmetric, Vector::Unit(12, 5)));
    const auto back = job.read("part.json");
    expectBeam(job.beam, back);
    Vector load = Vector::Zero(12);
    load[job.order[5]] = 1.0;
    EXPECT_EQ(back.part.model.loadAt(0), load);
  }
}

TEST(HarwellBoeing, SeveralNumbersALine) {
  const Folder folder;
  const auto giveStiffness = [&](const std::string& format) {
    folder.write("K.rsa", "title\n 3 1 1 1\nRSA 2 2 3 0\n(3I4) (3I4) " + format +
                              "\n   1   3   4\n   1   2   2\n 5.000E+00-3.000E+00 4.000E+00\n");
  };
  giveStiffness("(1P,3E10.3)");
  folder.write("M.rsa",
               "title\n 3 1 1 1\nRSA 2 2 1 0\n(3I4) (3I4) (3E10.3)\n   1   2   2\n   1\n 2.0\n");
  folder.write("map", "1 7 ROTX\n2 3 uy\n");
  folder.write("part.json", R"({"format": "tooljoint part 1", "matrices":
      {"stiffness": "K.rsa", "mass": "M.rsa", "mapping": "map"}})");
  const auto part = folder.read("part.json");
  EXPECT_EQ(part.part.model.dofs,
            (std::vector<DofLabel>{DofLabel::physical(3, 1), DofLabel::physical(7, 3)}));
  EXPECT_EQ(stiffness(part), (Matrix(2, 2) << 4, -3, -3, 5).finished());
  EXPECT_EQ(Matrix(part.part.model.mass), (Matrix(2, 2) << 0, 0, 0, 2).finished());
  for (const char* format : {"(1P3E10.3)", "(3(1PE10.3))", "(1P, 3(e10.3))", "(1( 3E10.3 ))",
                             "(3ES10.3)", "(3EN10.3)"}) {
    giveStiffness(format);
    EXPECT_EQ(stiffness(folder.read("part.json")), stiffness(part)) << format;
  }
  for (const char* format : {"(3(E10.3)", "(3(X))", "(0(3E10.3))", "(2000(2E10.3))"}) {
    giveStiffness(format);
    folder.expect("part.json", "K.rsa:4 should give the Fortran formats");
  }
  folder.expect("K.rsa", "holds one matrix. Name a part.json");
}

TEST(HarwellBoeing, NamesFaultsByLineAndField) {
  const AnsysJob job;
  const auto good = harwellBoeing(Matrix(job.beam.model.stiffnessAt(0)), job.order, true);
  const auto replaced = [&](std::size_t where, const std::string& old, const std::string& now) {
    job.write("K.hb", std::string(good).replace(where, old.size(), now));
  };
  const auto with = [&](const std::string& old, const std::string& now) {
    replaced(good.find(old), old, now);
  };
  with("RSA", "CSA");
  job.refuses("K.hb:3 gives the complex type \"CSA\". A part is real: expected RSA or RUA");
  with("RSA", "RSE");
  job.refuses("K.hb:3 gives the type \"RSE\", expected RSA (real, symmetric, assembled)");
  with("(1i14)          (1i14)", "none none");
  job.refuses("K.hb:4 should give the Fortran formats");
  with("             1\n", "             x\n");
  job.refuses("K.hb:5 has \"x\" in field 1, expected a pointer to the first entry of a column");
  job.write("K.hb", good.substr(0, good.find('\n', good.size() / 2) + 1));
  job.refuses(" values: the file is cut short");
  job.write("K.hb", good.substr(0, good.rfind('\n', good.size() - 2) + 1));
  job.refuses("is the last line, with number 46 of 47 values: the file is cut short");
  job.write("K.hb", good + "1.0D0\n");
  job.refuses("follows the last number of the matrix: found \"1.0D0\"");
  job.write("K.hb", good + "\n \n");
  EXPECT_EQ(job.read("part.json").part.model.size(), 12);
  with(" 13 47", " 12 47");
  job.refuses("K.hb:2 announces 12 lines of pointers, expected 13");
  with("107 13", "108 13");
  job.refuses("K.hb:2 announces 108 lines of numbers in all, expected 107");
  const auto lastWith = [&](const std::string& old, const std::string& now) {
    replaced(good.rfind(old), old, now);
  };
  lastWith(".", "0");
  job.refuses("in field 1, expected a finite number with a decimal point");
  lastWith("             9\n            10\n", "             9\n             9\n");
  job.refuses("K.hb gives the entry in row 9, column ");
  auto text = harwellBoeing(Matrix(job.beam.model.mass), job.order, true, Vector::Ones(12));
  text.replace(text.find("F                        1"), 26, "F                        2");
  job.write("K.hb", text);
  job.refuses("K.hb:5 announces 2 right-hand sides, expected one");
  job.write("K.hb", good);
  job.write("K.mapping", "1 1 UX\n2 1 TEMP\n");
  job.refuses("K.mapping:2 has the dof \"TEMP\", expected one of \"UX\"");
  job.write("K.mapping", "1 1 UX\n13 1 UY\n");
  job.refuses("K.mapping:2 has the equation \"13\", expected 1 to 12, the rows of");
  job.write("K.mapping", "1 1 UX\n1 1 UY\n");
  job.refuses("K.mapping:2 gives equation 1 twice");
  job.write("K.mapping", "1 1 UX\n");
  job.refuses("gives the dofs of 1 equations, but");
  job.write("part.json", R"({"format": "tooljoint part 1", "matrices":
      {"stiffness": "N.hb", "mass": "M.hb"}})");
  job.write("N.hb", good);
  job.refuses("has no mapping file");
}

/// A superelement: six dofs of node 1 and two modes, not sorted.
PartContent superelement() {
  PartContent content;
  content.part = samples::bar("jacket", 1, 7, 1.0 / 3.0, 6.0);
  auto& m = content.part.model;
  m.componentNames = {"w", "v", "u", "theta_x", "theta_y", "theta_z"};
  m.dofs[0] = DofLabel::modal(0, 0);
  m.dofs[7] = DofLabel::modal(0, 1);
  for (int c = 0; c < 6; ++c) m.dofs[static_cast<std::size_t>(c) + 1] = DofLabel::physical(1, c);
  m.damping.push_back({"C", Sparse(0.1 * m.mass), 0});
  return content;
}

/// The values that ReadFlexASCII of OpenFAST reads from the file, by keyword.
struct FlexAscii {
  explicit FlexAscii(const std::string& text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      const auto after = [&](const std::string& key) {
        return line.rfind(key, 0) == 0 ? std::stod(line.substr(key.size())) : -1.0;
      };
      if (line.rfind("!Dimension:", 0) == 0) n = std::stoi(line.substr(11));
      if (line.rfind("!Time increment", 0) == 0) step = after("!Time increment in simulation:");
      if (line.rfind("!Total", 0) == 0) end = after("!Total simulation time in file:");
      Matrix* matrix = line.rfind("!Mass Matrix", 0) == 0        ? &mass
                       : line.rfind("!Stiffness Matrix", 0) == 0 ? &stiffness
                       : line.rfind("!Damping Matrix", 0) == 0   ? &damping
                       : line.rfind("!Loading", 0) == 0          ? &loads
                                                                 : nullptr;
      if (matrix == nullptr) continue;
      std::getline(in, line);  // dimensions, a comment
      const long rows = matrix == &loads ? std::lround(end / step) + 1 : n;
      *matrix = Matrix(rows, matrix == &loads ? n + 2 : n);
      for (Eigen::Index i = 0; i < matrix->rows(); ++i)
        for (Eigen::Index j = 0; j < matrix->cols(); ++j) in >> (*matrix)(i, j);
      std::getline(in, line);
    }
    whole = !in.bad();
  }
  int n = 0;
  double step = 0, end = 0;
  Matrix mass, stiffness, damping, loads;
  bool whole = false;
};

TEST(ExtPtfm, SuperelementComesBackInItsOrder) {
  auto part = superelement();
  auto& m = part.part.model;
  m.loads.push_back({"weight", Vector::LinSpaced(8, 0.1, 0.8), 0});
  const std::vector<int> order{3, 2, 1, 4, 5, 6, 0, 7};  // u v w, rotations, modes
  const auto inOrder = [&](const Matrix& A) {
    Matrix out(8, 8);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        out(i, j) = A(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]);
    return out;
  };
  const FlexAscii constant(extPtfmText(part, {}));
  EXPECT_EQ(constant.n, 8);
  EXPECT_EQ(constant.mass, inOrder(Matrix(m.mass)));
  EXPECT_EQ(constant.stiffness, inOrder(Matrix(m.stiffnessAt(0))));
  EXPECT_EQ(constant.damping, inOrder(Matrix(m.dampingAt(0))));
  ASSERT_EQ(constant.loads.rows(), 2);
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(constant.loads(1, i + 1), m.loads[0].vector[order[static_cast<std::size_t>(i)]]);
  m.loads.push_back({"wave", Vector::Ones(8), m.lawIndex(samples::spin())});  // 2 + t
  const FlexAscii moving(extPtfmText(part, {1.0, 2.0, 0.25}));
  ASSERT_EQ(moving.loads.rows(), 5);
  EXPECT_EQ(moving.loads(4, 0), 1.0);
  EXPECT_DOUBLE_EQ(moving.loads(4, 1), 0.1 * 4 + 4.0);  // fourth of 0.1 to 0.8, and 2 + 2
  EXPECT_EQ(moving.loads(4, 9), 0.0);                   // no waves
}

TEST(ExtPtfm, OtherPartsAreRefused) {
  const auto refuses = [](const PartContent& part, const std::string& sentence) {
    try {
      extPtfmText(part, {});
      FAIL() << "was written";
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  };
  auto two = superelement();
  two.part.model.dofs[7] = DofLabel::physical(2, 0);
  refuses(two, "it has dofs of the nodes 1 and 2. Expected one interface node, and modes");
  auto five = superelement();
  five.part.model.dofs[6] = DofLabel::modal(0, 2);
  refuses(five, "its interface node has 5 of the six components");
  auto moving = superelement();
  auto& m = moving.part.model;
  m.loads.push_back({"wave", Vector::Ones(8), m.lawIndex(samples::spin())});
  refuses(moving, "its loads vary in time. Give the deck a Transient list");
  auto gyroscopic = superelement();
  auto& g = gyroscopic.part.model;
  g.damping.push_back({"gyroscopic", g.mass, g.lawIndex(samples::spin())});
  refuses(gyroscopic, "its matrix \"gyroscopic\" varies in time with the law \"Omega\"");
}

}  // namespace ForeignMatricesTest
}  // namespace tooljoint::parts
