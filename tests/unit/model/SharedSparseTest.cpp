// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Matrices of models: copies share storage, changes do not reach the copies.
#include "model/SharedSparse.hpp"

#include <gtest/gtest.h>

#include "model/SecondOrderModel.hpp"

namespace SharedSparseTest {

using namespace tooljoint;
using model::SharedSparse;

Sparse sample() {
  Sparse a(3, 3);
  a.insert(0, 0) = 2;
  a.insert(1, 2) = -1;
  a.insert(2, 2) = 4;
  return a;
}

TEST(SharedSparse, ReadsAsTheMatrixItIsMadeFrom) {
  const SharedSparse a = sample();
  EXPECT_TRUE(a.isCompressed());
  EXPECT_EQ(a.nonZeros(), 3);
  EXPECT_EQ((Matrix(a) - Matrix(sample())).norm(), 0.0);
  EXPECT_EQ((a * Vector::Ones(3) - sample() * Vector::Ones(3)).norm(), 0.0);
  EXPECT_EQ(a.diagonal().sum(), 6.0);
  const Sparse& same = a;
  EXPECT_EQ(same.valuePtr(), a.valuePtr());
  double sum = 0;
  for (int i = 0; i < a.outerSize(); ++i)
    for (SharedSparse::InnerIterator it(a, i); it; ++it) sum += it.value();
  EXPECT_EQ(sum, 5.0);
  EXPECT_EQ(SharedSparse().size(), 0);
}

TEST(SharedSparse, CopiesShareUntilOneIsChanged) {
  SharedSparse a = sample();
  SharedSparse b = a, c;
  c = a;
  EXPECT_TRUE(b.sharesWith(a));
  EXPECT_TRUE(c.sharesWith(a));
  EXPECT_EQ(b.valuePtr(), a.valuePtr()) << "no copy of the entries";
  b.coeffRef(0, 0) = 7;
  b.coeffRef(0, 1) = 5;  // a new entry
  EXPECT_FALSE(b.sharesWith(a));
  EXPECT_EQ(b.coeff(0, 0), 7);
  EXPECT_EQ(b.coeff(0, 1), 5);
  EXPECT_EQ(b.nonZeros(), 4);
  c *= 2.0;
  EXPECT_EQ(c.coeff(1, 2), -2);
  EXPECT_EQ((Matrix(a) - Matrix(sample())).norm(), 0.0) << "nobody else has changed";
  a = a.transpose() * a;  // from itself
  EXPECT_EQ((Matrix(a) - Matrix(sample()).transpose() * Matrix(sample())).norm(), 0.0);
}

TEST(SharedSparse, OutlivesWhatItWasCopiedFrom) {
  model::SecondOrderModel copy;
  {
    model::SecondOrderModel original;
    original.mass = sample();
    original.stiffness.push_back({"spring", 3.0 * sample(), 0});
    copy = original;
    EXPECT_TRUE(copy.mass.sharesWith(original.mass));
    original.mass.resize(2, 2);
    EXPECT_EQ(original.mass.nonZeros(), 0);
  }
  EXPECT_EQ(copy.mass.coeff(2, 2), 4);
  EXPECT_EQ(copy.stiffness[0].matrix.coeff(0, 0), 6);
}

}  // namespace SharedSparseTest
