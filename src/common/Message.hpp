// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Conversion of values to bytes and back, by cereal, for messages between the ranks of one run.
/// Both ends are the same program on the same kind of machine. A user-defined type needs a function
/// `serialize` for cereal, in the namespace of the type. For set-up code only; the step loop sends
/// plain arrays.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/complex.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <complex>
#include <sstream>
#include <string>
#include <type_traits>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Types.hpp"

namespace cereal {

/// A vector has the same bytes as std::vector<double>.
template <class Archive>
void save(Archive& archive, const tooljoint::Vector& x) {
  archive(make_size_tag(static_cast<size_type>(x.size())),
          binary_data(x.data(), static_cast<std::size_t>(x.size()) * sizeof(double)));
}

template <class Archive>
void load(Archive& archive, tooljoint::Vector& x) {
  size_type size = 0;
  archive(make_size_tag(size));
  x.resize(static_cast<Eigen::Index>(size));
  archive(binary_data(x.data(), size * sizeof(double)));
}

template <class Archive>
void save(Archive& archive, const tooljoint::Matrix& A) {
  archive(A.rows(), A.cols(),
          binary_data(A.data(), static_cast<std::size_t>(A.size()) * sizeof(double)));
}

template <class Archive>
void load(Archive& archive, tooljoint::Matrix& A) {
  Eigen::Index rows = 0, columns = 0;
  archive(rows, columns);
  A.resize(rows, columns);
  archive(binary_data(A.data(), static_cast<std::size_t>(A.size()) * sizeof(double)));
}

template <class Archive, int Columns>
void save(Archive& archive, const Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Columns>& A) {
  archive(A.rows(), A.cols(),
          binary_data(A.data(), static_cast<std::size_t>(A.size()) * sizeof(std::complex<double>)));
}

template <class Archive, int Columns>
void load(Archive& archive, Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Columns>& A) {
  Eigen::Index rows = 0, columns = 0;
  archive(rows, columns);
  A.resize(rows, columns);
  archive(binary_data(A.data(), static_cast<std::size_t>(A.size()) * sizeof(std::complex<double>)));
}

template <class Archive, int Rows, int Columns>
std::enable_if_t<(Rows > 0 && Columns > 0)> serialize(Archive& archive,
                                                      Eigen::Matrix<double, Rows, Columns>& A) {
  archive(binary_data(A.data(), sizeof(double) * Rows * Columns));
}

template <class Archive>
void save(Archive& archive, const tooljoint::Sparse& A) {
  if (!A.isCompressed()) {
    tooljoint::Sparse compressed = A;
    compressed.makeCompressed();
    return save(archive, compressed);
  }
  const auto entries = static_cast<std::size_t>(A.nonZeros());
  archive(A.rows(), A.cols(), A.nonZeros(),
          binary_data(A.outerIndexPtr(), static_cast<std::size_t>(A.rows() + 1) * sizeof(int)),
          binary_data(A.innerIndexPtr(), entries * sizeof(int)),
          binary_data(A.valuePtr(), entries * sizeof(double)));
}

template <class Archive>
void load(Archive& archive, tooljoint::Sparse& A) {
  Eigen::Index rows = 0, columns = 0, entries = 0;
  archive(rows, columns, entries);
  A.resize(rows, columns);
  A.resizeNonZeros(entries);
  archive(binary_data(A.outerIndexPtr(), static_cast<std::size_t>(rows + 1) * sizeof(int)),
          binary_data(A.innerIndexPtr(), static_cast<std::size_t>(entries) * sizeof(int)),
          binary_data(A.valuePtr(), static_cast<std::size_t>(entries) * sizeof(double)));
}

}  // namespace cereal

namespace tooljoint {

template <class T>
std::string toBytes(const T& value) {
  std::ostringstream out;
  cereal::BinaryOutputArchive archive(out);
  archive(value);
  return out.str();
}

/// Throws Error (Internal) unless `bytes` represent exactly one T.
template <class T>
void fromBytes(const std::string& bytes, T& value) {
  std::istringstream in(bytes);
  try {
    cereal::BinaryInputArchive archive(in);
    archive(value);
  } catch (const cereal::Exception& error) {
    throw Error(ExitCode::Internal,
                "A message from another rank is incomplete: " + std::string(error.what()));
  }
  if (in.peek() != std::istringstream::traits_type::eof())
    throw Error(ExitCode::Internal, "A message from another rank is longer than its content.");
}

template <class T>
void parallel::broadcast(T& value, int root) {
  if (size() == 1) return;
  std::string bytes;
  if (rank() == root) bytes = toBytes(value);
  broadcastBytes(bytes, root);
  if (rank() != root) fromBytes(bytes, value);
}

}  // namespace tooljoint
