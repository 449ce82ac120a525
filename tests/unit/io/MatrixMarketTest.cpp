// SPDX-License-Identifier: BSD-3-Clause
// Matrix Market files of other programs, and faulty ones.
#include "io/MatrixMarket.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <limits>

#include "tests/unit/io/Scratch.hpp"

namespace tooljoint::io {
namespace MatrixMarketTest {

std::string file(const std::string& name, const std::string& text) {
  static const test::Scratch scratch;
  auto path = scratch / name;
  std::ofstream(path) << text;
  return path;
}

const std::string general = "%%MatrixMarket matrix coordinate real general\n";

void expectRefused(const std::string& text, const std::string& sentence, int row = -1,
                   int column = -1) {
  const auto path = file("bad.mtx", text);
  try {
    readMatrixMarket(path);
    FAIL() << "was read: " << text;
  } catch (const MatrixFileError& error) {
    EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    EXPECT_EQ(
        std::string(error.what()).rfind(path, 0) == 0 || sentence.rfind("The matrix file", 0) == 0,
        true)
        << error.what();
    EXPECT_EQ(error.row, row);
    EXPECT_EQ(error.column, column);
  }
}

TEST(MatrixMarket, ReadsWhatOthersWrite) {
  const Matrix a = readMatrixMarketDense(
      file("a.mtx", general + "% a remark\n%\n2 3 3\n1 1 1.5\n2 3 -2e-3\n\n1 1 0.5\n"));
  EXPECT_EQ(a, (Matrix(2, 3) << 2.0, 0, 0, 0, 0, -2e-3).finished());
  const Matrix s = readMatrixMarketDense(
      file("s.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 4\n2 1 -1\n"));
  EXPECT_EQ(s, (Matrix(2, 2) << 4, -1, -1, 0).finished());
  const Matrix k = readMatrixMarketDense(
      file("k.mtx", "%%MatrixMarket matrix coordinate integer skew-symmetric\n2 2 1\n2 1 3\n"));
  EXPECT_EQ(k, (Matrix(2, 2) << 0, -3, 3, 0).finished());
  const Matrix d = readMatrixMarketDense(
      file("d.mtx", "%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n4\n"));
  EXPECT_EQ(d, (Matrix(2, 2) << 1, 3, 2, 4).finished());
  const Matrix e = readMatrixMarketDense(
      file("e.mtx", "%%MatrixMarket matrix array real symmetric\r\n2 2\r\n1\r\n2\r\n3\r\n"));
  EXPECT_EQ(e, (Matrix(2, 2) << 1, 2, 2, 3).finished());
}

TEST(MatrixMarket, WritesNumbersThatReadBackAsTheSame) {
  Matrix full(3, 2);
  full << 0.1, -1.0 / 3.0, 1e-300, 7.25e307, 0.0, 3.0;
  EXPECT_EQ(readMatrixMarketDense(file("full.mtx", matrixMarketText(full))), full);
  const Sparse sparse = full.sparseView();
  const Sparse back = readMatrixMarket(file("sparse.mtx", matrixMarketText(sparse)));
  EXPECT_EQ(back.nonZeros(), 5);
  EXPECT_EQ(Matrix(back), full);
}

TEST(MatrixMarket, RefusesWithFileLineAndEntry) {
  expectRefused("", "is empty");
  expectRefused("1 2 3\n", ":1 does not begin with a Matrix Market banner");
  expectRefused("%%MatrixMarket matrix coordinate complex general\n1 1 0\n",
                "only real or integer");
  expectRefused("%%MatrixMarket matrix coordinate pattern general\n1 1 0\n", "\"pattern\"");
  expectRefused(general + "2 2\n", ":2 should give the sizes here");
  expectRefused(general + "2 2 1 1\n", "should give the sizes here");
  expectRefused(general + "2 -2 1\n", "should give the sizes here");
  expectRefused(general + "2 2 2\n1 1 1\n", "only 1 of the 2 entries");
  expectRefused(general + "2 2 1\n1 1 1\n2 2 1\n", ":4 is one entry more than the 1 announced");
  expectRefused(general + "2 2 1\n3 1 1\n", "row 3, column 1 stands outside of the 2 x 2 matrix", 2,
                0);
  expectRefused(general + "2 2 1\n0 1 1\n", "stands outside", -1, 0);
  expectRefused(general + "2 2 1\n1 2 nan\n",
                ":3: the entry in row 1, column 2 is \"nan\", which is no finite number", 0, 1);
  expectRefused(general + "2 2 1\n2 2 -inf\n", "\"-inf\"", 1, 1);
  expectRefused(general + "2 2 1\n2 2 1e999\n", "\"1e999\"", 1, 1);
  expectRefused(general + "2 2 1\n2 2 1.0.0\n", "\"1.0.0\"", 1, 1);
  expectRefused(general + "2 2 1\n1 1\n", "should be \"row column value\"");
  expectRefused(general + "2 2 1\n1 1 1 1\n", "should be \"row column value\"");
  expectRefused("%%MatrixMarket matrix coordinate real symmetric\n2 3 0\n", "only a square matrix");
  expectRefused("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 2 1\n2 1 1\n",
                "above and below its diagonal");
  expectRefused("%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n1 1 1\n",
                "diagonal of a skew", 0, 0);
  expectRefused("%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n",
                "no entry for row 2, column 2");
  expectRefused("%%MatrixMarket matrix array real general\n2 1\n1\n2\n3\n",
                "is more than the entries of a 2 x 1 matrix");
  expectRefused("%%MatrixMarket matrix array real general\n2 1\n1\ninf\n",
                "row 2, column 1 is \"inf\"", 1, 0);
  try {
    readMatrixMarket("/dev/zero");
    FAIL();
  } catch (const DeckError& error) {
    EXPECT_STREQ(error.what(),
                 "The matrix file /dev/zero cannot be read: it is no regular file, but a device.");
  }
  try {
    readMatrixMarket("there is no such file.mtx");
    FAIL();
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be read: No such file"), std::string::npos);
    EXPECT_EQ(error.code(), ExitCode::InvalidDeck);
  }
}

/// No memory is allocated for announced sizes.
TEST(MatrixMarket, RefusesSizesThatTheFileCannotHold) {
  expectRefused(general + "2 2 1000000000000\n1 1 1\n",
                ":2 announces 1000000000000 entries, for which the file of");
  expectRefused("%%MatrixMarket matrix array real general\n16000000 16000000\n1\n",
                ":2 announces 256000000000000 entries");
  expectRefused("%%MatrixMarket matrix array real symmetric\n16000000 16000000\n1\n",
                "entries, for which the file of");
  expectRefused(general + "100000000 100000000 1\n1 1 1\n",
                ":2 should give the sizes here, \"rows columns entries\", with at most 16777216 "
                "rows and columns");
  expectRefused(
      general + "2 2 1\n1 1 " + std::string(2000, '1') + "\n",
      "The matrix file " + file("bad.mtx", "") + " has a line of more than 1024 characters");
  const std::string message = [] {
    try {
      readMatrixMarket(file("long.mtx", general + "2 2 1\n1 1 " + std::string(900, 'x') + "\n"));
    } catch (const MatrixFileError& error) {
      return std::string(error.what());
    }
    return std::string();
  }();
  EXPECT_NE(message.find(std::string(197, 'x') + "...\""), std::string::npos) << message;
  EXPECT_EQ(message.find(std::string(198, 'x')), std::string::npos) << message;
}

TEST(MatrixMarket, ADenseMatrixIsNoLargerThanItsFileAllows) {
  const auto path = file("wide.mtx", general + "10000000 1000000 1\n1 1 1\n");
  EXPECT_EQ(readMatrixMarket(path).nonZeros(), 1);
  try {
    readMatrixMarketDense(path);
    FAIL();
  } catch (const MatrixFileError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("wide.mtx is 10000000 x 1000000, too large for a dense matrix"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(readMatrixMarketDense(file("tall.mtx", general + "1000000 2 1\n3 2 5\n"))(2, 1), 5.0);
}

}  // namespace MatrixMarketTest
}  // namespace tooljoint::io
