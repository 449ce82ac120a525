// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Matrices as Matrix Market text files (R. F. Boisvert, R. Pozo and K. A. Remington, NISTIR 5935,
/// 1996), read strictly. Teuchos reads banner and entry lines. Every rank reads for itself: use
/// parallel::agree if all ranks must fail together.
#pragma once

#include <cstdint>
#include <string>

#include "common/Error.hpp"
#include "common/Types.hpp"

namespace tooljoint::io {

/// A file without a usable matrix; with the faulty entry, if there is one.
struct MatrixFileError : DeckError {
  MatrixFileError(const std::string& sentence, int atRow = -1, int atColumn = -1)
      : DeckError(sentence), row(atRow), column(atColumn) {}
  int row;     ///< 0-based; -1: the fault does not concern an entry
  int column;  ///< likewise
};

/// Largest number of rows, and of columns, of a matrix.
constexpr long largestDimension = 1L << 24U;
/// Number of entries that a dense matrix may always have (128 MB); a larger one only if its file
/// has at least as many bytes.
constexpr std::uint64_t smallDense = 1ULL << 24U;

/// rows x columns of a coordinate or array file of real or integer numbers, general, symmetric or
/// skew-symmetric (one triangle is given and the other derived from it). Repeated entries are
/// added. MatrixFileError with file and line: missing file, another kind of file, sizes that do not
/// match the entries or the length of the file (found before anything is stored), a line of more
/// than 1024 characters, both triangles of a symmetric matrix, a number that is not finite.
Sparse readMatrixMarket(const std::string& path);
/// The same as a dense matrix; a column is a vector. MatrixFileError if it is too large, see
/// requireDense.
Matrix readMatrixMarketDense(const std::string& path);
/// Throws MatrixFileError, beginning with `who`, if the dense form of a matrix from a file of
/// `fileSize` bytes has more numbers than smallDense and than the file has bytes.
void requireDense(const std::string& who, const Sparse& matrix, std::uint64_t fileSize);

/// Text of a general coordinate file, entries by rows; the numbers read back as the same doubles.
std::string matrixMarketText(const Sparse& matrix);
/// Text of an array file.
std::string matrixMarketText(const Matrix& matrix);

}  // namespace tooljoint::io
