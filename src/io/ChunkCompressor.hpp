// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Compression of chunks of doubles for HDF5. Not for other rooms: include ResultsFile.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

struct z_stream_s;

namespace tooljoint::io {

/// Converts a chunk to the bytes that the HDF5 filters shuffle and deflate decode.
///
/// Shuffled bytes form planes: the lowest byte of all values, the next one, ... Low bytes of
/// computed numbers are noise. Deflate cannot shorten them but spends most of its time on them.
/// Such a plane is a stored block of the stream; the other planes are deflated.
class ChunkCompressor {
 public:
  /// `level` of deflate, 1 to 9.
  explicit ChunkCompressor(int level);
  ~ChunkCompressor();
  ChunkCompressor(const ChunkCompressor&) = delete;
  ChunkCompressor& operator=(const ChunkCompressor&) = delete;

  /// Bytes of `values`, consecutive rows of `rowSize` numbers; they are valid until the next call.
  const std::vector<unsigned char>& compress(const std::vector<double>& values,
                                             std::size_t rowSize);

 private:
  int level_;
  std::unique_ptr<z_stream_s> stream_;
  std::vector<unsigned char> planes_, bytes_;
};

}  // namespace tooljoint::io
