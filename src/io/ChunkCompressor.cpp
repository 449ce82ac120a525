// SPDX-License-Identifier: BSD-3-Clause
#include "io/ChunkCompressor.hpp"

#include <array>
#include <cmath>
#include <zlib.h>

#include "common/Error.hpp"

namespace tooljoint::io {

namespace {

/// A plane of bytes with a lower entropy is worth deflating [bit of 8].
constexpr double structuredEntropy = 6.5;
/// A plane is also worth deflating if this fraction of its bytes equals those of the previous row.
constexpr double repeatedShare = 0.6;
/// The zlib strategy for randomly distributed values: the same size in three quarters of the time.
constexpr int bytesOfNumbers = Z_FILTERED;

/// Entropy of single bytes [bit].
double entropy(const unsigned char* plane, std::size_t count) {
  std::array<std::size_t, 256> counts{};
  for (std::size_t i = 0; i < count; ++i) ++counts[plane[i]];
  double sum = 0.0;
  for (const std::size_t c : counts) {
    const double share = static_cast<double>(c) / static_cast<double>(count);
    if (c > 0) sum -= share * std::log2(share);
  }
  return sum;
}

/// True if deflating a plane is worth its time.
bool structured(const unsigned char* plane, std::size_t count, std::size_t rowSize) {
  std::size_t repeated = 0;
  for (std::size_t i = rowSize; i < count; ++i) repeated += plane[i] == plane[i - rowSize] ? 1 : 0;
  return static_cast<double>(repeated) > repeatedShare * static_cast<double>(count) ||
         entropy(plane, count) < structuredEntropy;
}

void require(bool good) {
  if (!good) throw Error(ExitCode::Internal, "zlib cannot compress a chunk of the results.");
}

}  // namespace

ChunkCompressor::ChunkCompressor(int level) : level_(level), stream_(std::make_unique<z_stream>()) {
  require(deflateInit(stream_.get(), level_) == Z_OK);
}

ChunkCompressor::~ChunkCompressor() { deflateEnd(stream_.get()); }

const std::vector<unsigned char>& ChunkCompressor::compress(const std::vector<double>& values,
                                                            std::size_t rowSize) {
  constexpr std::size_t width = sizeof(double);
  const std::size_t count = values.size();
  const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
  planes_.resize(width * count);
  for (std::size_t plane = 0; plane < width; ++plane) {
    unsigned char* const to = planes_.data() + plane * count;
    for (std::size_t i = 0; i < count; ++i) to[i] = bytes[width * i + plane];
  }
  z_stream& stream = *stream_;
  require(deflateReset(&stream) == Z_OK);
  // in addition to its bound, a few bytes for each change of the level
  bytes_.resize(deflateBound(&stream, static_cast<uLong>(planes_.size())) + 64 * width);
  stream.next_out = bytes_.data();
  stream.avail_out = static_cast<uInt>(bytes_.size());
  for (std::size_t plane = 0; plane < width; ++plane) {
    unsigned char* const from = planes_.data() + plane * count;
    stream.avail_in = 0;
    require(deflateParams(&stream, structured(from, count, rowSize) ? level_ : Z_NO_COMPRESSION,
                          bytesOfNumbers) == Z_OK);
    stream.next_in = from;
    stream.avail_in = static_cast<uInt>(count);
    const bool last = plane + 1 == width;
    require(deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH) == (last ? Z_STREAM_END : Z_OK) &&
            stream.avail_in == 0);
  }
  bytes_.resize(stream.total_out);
  return bytes_;
}

}  // namespace tooljoint::io
