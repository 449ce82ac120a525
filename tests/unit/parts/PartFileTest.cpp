// SPDX-License-Identifier: BSD-3-Clause
// Part files of both kinds: written parts are read again, and errors are named.
#include "parts/file/PartFile.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "tests/support/SampleParts.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace tooljoint::parts {
namespace PartFileTest {

using model::DofLabel;

/// A part with all contents of the format.
PartContent sample() {
  PartContent content;
  auto& part = content.part;
  part = samples::bar("bar", 3, 3, 10.0, 6.0);
  auto& m = part.model;
  const int omega = m.lawIndex(samples::spin());
  Sparse skew(4, 4);
  skew.insert(0, 1) = 1.0 / 3.0;
  skew.insert(1, 0) = -1.0 / 3.0;
  m.damping.push_back({"gyroscopic", skew, omega});
  m.damping.push_back({"a/b", m.mass, 0});
  m.loads.push_back({"pull", Vector::LinSpaced(4, 0.1, 0.7), 0});
  m.loads.push_back({"pull", Vector::Ones(4), omega});
  m.initialVelocity = Vector::LinSpaced(4, -1, 1);
  part.reference = Vector::Constant(4, 1e-3);
  m.initialDisplacement = part.reference;
  part.interface = {0, 3};
  part.retained = {2};
  content.interfaces = {{"left", {0}, {3}}, {"right", {3}, {6}}};
  content.positions = {{3, {0, 0, 0}}, {6, {0.1, 0, 1e-17}}};
  content.basis.dofs = {DofLabel::physical(3, 0), DofLabel::physical(4, 0),
                        DofLabel::physical(9, 0)};
  content.basis.vectors = Matrix(Matrix::Identity(3, 4)).sparseView();
  content.basis.offset = Vector::LinSpaced(3, 0, 1.0 / 3.0);
  content.omitted = {"contact"};
  return content;
}

void expectSame(const PartContent& a, const PartContent& b) {
  const auto& x = a.part.model;
  const auto& y = b.part.model;
  EXPECT_EQ(x.componentNames, y.componentNames);
  EXPECT_EQ(x.dofs, y.dofs);
  EXPECT_EQ(Matrix(x.mass), Matrix(y.mass));
  const auto same = [&](const std::vector<model::MatrixTerm>& s,
                        const std::vector<model::MatrixTerm>& t) {
    ASSERT_EQ(s.size(), t.size());
    for (const auto& term : s) {
      const auto it = std::find_if(t.begin(), t.end(),
                                   [&](const auto& other) { return other.name == term.name; });
      ASSERT_NE(it, t.end()) << term.name;
      EXPECT_EQ(Matrix(term.matrix), Matrix(it->matrix));
      EXPECT_EQ(x.laws[static_cast<std::size_t>(term.law)].name,
                y.laws[static_cast<std::size_t>(it->law)].name);
    }
  };
  same(x.damping, y.damping);
  same(x.stiffness, y.stiffness);
  ASSERT_EQ(x.loads.size(), y.loads.size());
  EXPECT_EQ(x.loadAt(0.0).allFinite(), true);
  for (const auto& load : x.loads)
    EXPECT_TRUE(std::any_of(y.loads.begin(), y.loads.end(), [&](const auto& other) {
      return other.name == load.name && other.vector == load.vector &&
             x.laws[static_cast<std::size_t>(load.law)].name ==
                 y.laws[static_cast<std::size_t>(other.law)].name;
    }));
  EXPECT_EQ(x.initialDisplacement, y.initialDisplacement);
  EXPECT_EQ(x.initialVelocity, y.initialVelocity);
  EXPECT_EQ(a.part.reference, b.part.reference);
  EXPECT_EQ(a.part.interface, b.part.interface);
  EXPECT_EQ(a.part.retained, b.part.retained);
  ASSERT_EQ(a.interfaces.size(), b.interfaces.size());
  for (std::size_t i = 0; i < a.interfaces.size(); ++i) {
    EXPECT_EQ(a.interfaces[i].name, b.interfaces[i].name);
    EXPECT_EQ(a.interfaces[i].dofs, b.interfaces[i].dofs);
    EXPECT_EQ(a.interfaces[i].nodes, b.interfaces[i].nodes);
  }
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.basis.dofs, b.basis.dofs);
  EXPECT_EQ(Matrix(a.basis.vectors), Matrix(b.basis.vectors));
  EXPECT_EQ(a.basis.offset, b.basis.offset);
  EXPECT_EQ(a.omitted, b.omitted);
}

TEST(PartFile, ComesBackBitByBitFromBothKinds) {
  const test::Scratch scratch;
  const auto content = sample();
  writePart(content, scratch / "part.h5", FileKind::Hdf5);
  writePart(content, scratch / "folder", FileKind::MatrixMarket);
  for (const auto& path : {scratch / "part.h5", scratch / "folder", scratch / "folder/part.json"}) {
    const auto back = readPart(path, "bar");
    expectSame(content, back);
    // D = offset + vectors q, node 9 has no dof of the part
    EXPECT_EQ(back.part.model.recoveryNodes, (std::vector<std::int64_t>{3, 4, 9}));
    EXPECT_EQ(back.part.model.recoveryOffset, content.basis.offset);
  }
}

TEST(PartFile, KeepsModesApartFromNodes) {
  const test::Scratch scratch;
  auto content = sample();
  content.part.model.dofs[1] = DofLabel::modal(0, 0);
  content.part.model.dofs[2] = DofLabel::modal(0, 1);
  for (const auto kind : {FileKind::Hdf5, FileKind::MatrixMarket}) {
    const auto path = scratch / (kind == FileKind::Hdf5 ? "modes.h5" : "modes");
    writePart(content, path, kind);
    expectSame(content, readPart(path, "bar"));
  }
}

/// A folder whose part.json is `json`, with 2 x 2 matrices beside it.
class BadPart {
 public:
  explicit BadPart(const std::string& json) {
    write("part.json", json);
    write("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 2\n2 2 1\n");
    write("K.mtx", "%%MatrixMarket matrix array real general\n2 2\n2\n-1\n-1\n1\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_ / name) << text;
  }
  PartContent read() const { return readPart(scratch_ / "part.json", "beam"); }
  template <class Kind>
  void expect(const std::string& sentence) const {
    try {
      readPart(scratch_ / "part.json", "beam");
      FAIL() << "was read";
    } catch (const Kind& error) {
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  }

 private:
  test::Scratch scratch_;
};

std::string json(const std::string& dofs = R"([[1,"u"],[2,"u"]])", const std::string& more = "") {
  return R"({"format": "tooljoint part 1", "components": ["u"], "dofs": )" + dofs +
         R"(, "mass": "M.mtx", "stiffness": "K.mtx")" + more + "}";
}

TEST(PartFile, OfTwoDofsIsRead) {
  const auto model = BadPart(json()).read().part.model;
  EXPECT_EQ(model.dofs,
            (std::vector<DofLabel>{DofLabel::physical(1, 0), DofLabel::physical(2, 0)}));
  EXPECT_EQ(Matrix(model.stiffnessAt(0)), (Matrix(2, 2) << 2, -1, -1, 1).finished());
}

TEST(PartFile, NamesFaultsOfLabels) {
  BadPart(json(R"([[1,"u"],[1,"u"]])"))
      .expect<DeckError>("\"dofs\" gives u of node 1 twice, as dof 1 and as dof 2");
  BadPart(json(R"([[1,"u"],[2,"x"]])"))
      .expect<DeckError>("names the component \"x\" of node 2; the components are \"u\"");
  BadPart(json(R"([[1,"u"],[0,"u"]])"))
      .expect<DeckError>("names node 0. Nodes are numbered from 1");
  BadPart(json(R"([[1,"u"],[2,"u"],[3,"u"]])"))
      .expect<DeckError>("mass (M.mtx)\" is 2 x 2, but \"dofs\" names 3 dofs");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "interfaces": {"end": [7]})"))
      .expect<DeckError>("\"interfaces/end\" names node 7, but the part has no such node");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "interfaces": {"end": [2, [2, "u"]]})"))
      .expect<DeckError>("names u of node 2 twice");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "stifness": 1)"))
      .expect<DeckError>("Did you mean \"stiffness\"?");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "positions": [[1,0,0]])"))
      .expect<DeckError>("\"positions\" is 1 x 3, expected rows \"node x y z\"");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "positions": [[1,0,0,0],[7,1,0,0]])"))
      .expect<DeckError>(
          "\"positions\" names node 7 in row 2, which the part does not have (its nodes are 1 to "
          "2)");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "interfaces": {"a": [1], "b": [1], "a": [2]})"))
      .expect<DeckError>("part.json gives \"a\" twice in one object. Keep one of them");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "name": 7)"))
      .expect<DeckError>("\"name\" must be a text");
  EXPECT_NO_THROW(
      BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "name": "beam", "positions": [[1,0,0,0]])"))
          .read());
}

TEST(PartFile, NamesFaultsOfMatrices) {
  {
    BadPart bad(json());
    bad.write("M.mtx",
              "%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 2\n2 2 1\n1 2 0.5\n");
    bad.expect<ModelError>(
        "its mass is not symmetric: 0.5 in the row of u of node 1 and the column of u of node 2, "
        "but 0 in the transposed entry");
    bad.write("M.mtx",
              "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 2 1\n2 1 2\n");
    bad.expect<ModelError>("its mass is indefinite: a motion that includes u of node");
    bad.write("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 2\n2 2 -1\n");
    bad.expect<ModelError>("its mass is indefinite: -1 on the diagonal of u of node 2");
    bad.write("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 2\n2 1 1\n");
    bad.expect<ModelError>(
        "u of node 2 has a zero diagonal entry, but is coupled with u of node 1 by 1");
  }
  {
    BadPart bad(json());
    bad.write("K.mtx", "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 nan\n2 2 1\n");
    bad.expect<DeckError>("K.mtx:3");
    bad.expect<DeckError>("That is the row of u of node 1 and the column of u of node 1.");
    bad.write("K.mtx", "%%MatrixMarket matrix array real general\n2 1\n1\n1\n");
    bad.expect<DeckError>("is 2 x 1, which is not square");
    bad.write("K.mtx", "%MatrixMarket matrix array real general\n2 1\n1\n1\n");
    bad.expect<DeckError>("K.mtx");
  }
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "loads": [{"vector": [1, 2, 3]}])"))
      .expect<DeckError>("is 3 x 1, expected 2 numbers in one column");
  BadPart(json(R"([[1,"u"],[2,"u"]])", R"(, "damping": "C.mtx")"))
      .expect<DeckError>("C.mtx cannot be read");
  BadPart("{").expect<DeckError>("is no JSON");
  BadPart(R"({"format": "tooljoint part 9"})").expect<DeckError>("expected \"tooljoint part 1\"");
}

TEST(PartFile, MasslessDofsAreNoFault) {
  BadPart good(json());
  good.write("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 1 2\n");
  const auto mass = Matrix(good.read().part.model.mass);
  EXPECT_EQ(mass, (Matrix(2, 2) << 2, 0, 0, 0).finished());
}

TEST(PartFile, NamesFaultsOfHdf5) {
  const test::Scratch scratch;
  const auto path = scratch / "part.h5";
  writePart(sample(), path, FileKind::Hdf5);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  try {
    readPart(path, "bar");
    FAIL() << "was read";
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("Part \"bar\": " + path + " is not a part file: it cannot be read: "),
              std::string::npos)
        << error.what();
  }
  try {
    readPart(scratch / "nowhere.h5", "bar");
    FAIL() << "was read";
  } catch (const DeckError& error) {
    EXPECT_NE(
        std::string(error.what()).find("nowhere.h5 cannot be read: No such file or directory."),
        std::string::npos)
        << error.what();
  }
}

}  // namespace PartFileTest
}  // namespace tooljoint::parts
