// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writing results.h5: datasets with units and long names, growing time series, provenance.
/// docs/file-formats.md describes the layout. Only rank 0 writes; on the other ranks every call
/// returns at once, so callers need no rank test (but a FileError appears on rank 0 alone: use
/// parallel::agree where all ranks must end together).
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::io {

/// Version of the layout of results.h5, first number of docs/file-formats.md: raised when a reader
/// must change.
constexpr int resultsFormatVersion = 1;

using Shape = std::vector<std::size_t>;

/// Where results come from. Program versions, date and ranks are added by ResultsFile itself.
struct Provenance {
  std::string deckFile;
  std::string deckText;
  std::string deckSha256;
  std::vector<std::string> overrides;  ///< PATH=VALUE of the command line
};

struct ResultsOptions {
  int compression = 1;  ///< deflate level 0 (off) to 9 of time series
};

class ChunkCompressor;
class ResultsFile;
class ResultsReader;

/// A dataset that grows by one row per sample. Rows are buffered up to a chunk. A chunk that
/// flush() found begun stands uncompressed on the disk until it is full and flushed again.
class TimeSeries {
 public:
  ~TimeSeries();
  TimeSeries(const TimeSeries&) = delete;
  TimeSeries& operator=(const TimeSeries&) = delete;

  /// Add one row of its shape. FileError when the file cannot be written, Error(Internal)
  /// naming the dataset when a number is not finite.
  void append(const double* row);
  void append(double value) { append(&value); }
  /// Rows appended so far, buffered ones included; 0 on ranks that do not write.
  std::size_t rows() const { return rows_; }

 private:
  friend class ResultsFile;
  TimeSeries(ResultsFile& file, std::string path, const Shape& rowShape);
  void writeChunk(std::vector<double>& values, std::size_t chunk, bool compressed);
  /// Replace the full chunk of which the disk holds a part; false when there is none.
  bool replace();
  /// Write what is buffered and go on buffering, or write it compressed for the last time. Whether
  /// that replaces a part on the disk.
  bool writeBuffer(bool last);

  ResultsFile& file_;
  std::string path_;
  Shape rowShape_;
  std::size_t rowSize_ = 1;
  std::size_t chunkRows_ = 1;
  std::size_t rows_ = 0;
  std::size_t written_ = 0;          ///< rows on the disk
  std::vector<double> buffer_;       ///< rows of the chunk that is not yet full
  bool begun_ = false;               ///< the disk holds a part of that chunk, uncompressed
  std::vector<double> replacement_;  ///< the chunk `replaced_`, full; on the disk it is a part
  std::size_t replaced_ = 0;
  std::int64_t dataset_ = -1;
};

/// An HDF5 results file under construction. It is written as `path`.part and takes its own name in
/// finish(), so that a file called `path` is always a complete one. After flush() the .part can be
/// read even if the process is killed.
class ResultsFile {
 public:
  /// Create `path`.part and write the provenance. FileError with the system's reason when that is
  /// not possible.
  ResultsFile(const std::string& path, const Provenance& provenance,
              const ResultsOptions& options = {});
  /// Closes what is open; the .part stays and is readable.
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// Write a dataset; groups on the way are made. `shape` multiplies to the number of values,
  /// row-major; {} is a scalar. `unit` is the SI unit ("1" for pure numbers, "" for text),
  /// `longName` a sentence. FileError on a write error, Error(Internal) for a path that is already
  /// there, a wrong shape, a missing unit or long name, or a number that is not finite.
  void write(const std::string& path, const double* values, const Shape& shape,
             const std::string& unit, const std::string& longName);
  void write(const std::string& path, const std::vector<double>& values, const Shape& shape,
             const std::string& unit, const std::string& longName);
  void write(const std::string& path, std::initializer_list<double> values, const Shape& shape,
             const std::string& unit, const std::string& longName) {
    write(path, std::vector<double>(values), shape, unit, longName);
  }
  void write(const std::string& path, const Vector& values, const Shape& shape,
             const std::string& unit, const std::string& longName);
  void write(const std::string& path, const std::vector<int>& values, const Shape& shape,
             const std::string& unit, const std::string& longName);
  void write(const std::string& path, const std::vector<std::string>& values,
             const std::string& longName);
  /// A matrix as rows x columns.
  void write(const std::string& path, const Matrix& values, const std::string& unit,
             const std::string& longName);
  void write(const std::string& path, double value, const std::string& unit,
             const std::string& longName);

  /// A new growing dataset, samples x rowShape. The reference lives as long as this file.
  TimeSeries& series(const std::string& path, const Shape& rowShape, const std::string& unit,
                     const std::string& longName);

  /// Series made from now on begin with rows of an earlier results file, so many as `rows` says for
  /// each path. FileError when they cannot be read.
  void continueFrom(const std::string& file, const std::map<std::string, std::uint64_t>& rows);
  /// The rows that a series of this path begins with, row-major.
  std::vector<double> carried(const std::string& path) const;
  /// Rows of each series so far, by path.
  std::map<std::string, std::uint64_t> rows() const;

  /// Attribute of a group or dataset that exists ("/" for the file); replaces one of that name.
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, int value);

  /// Put everything so far on disk.
  void flush();
  /// Write what is buffered and close; the file stays `path`.part.
  void close();
  /// close(), then rename to `path`. Call once, when all is written.
  void finish();

  const std::string& path() const { return path_; }
  std::string partPath() const { return path_ + ".part"; }

 private:
  friend class TimeSeries;
  struct DatasetRequest;
  std::int64_t createDataset(const DatasetRequest& request);
  void writeValues(const std::string& path, std::int64_t type, const void* values,
                   std::size_t count, const Shape& shape, const std::string& unit,
                   const std::string& longName);
  [[noreturn]] void fail(const std::string& doing);
  void abandon() noexcept;
  void writeBuffers(bool last);

  std::string path_;
  ResultsOptions options_;
  std::unique_ptr<ChunkCompressor> compressor_;  ///< of the series; none without compression
  bool active_ = false;                          ///< this rank writes
  bool failed_ = false;                          ///< a write failed: what is buffered is given up
  std::int64_t file_ = -1;
  std::vector<std::unique_ptr<TimeSeries>> series_;
  std::unique_ptr<ResultsReader> earlier_;  ///< what series continue, if anything
  std::map<std::string, std::uint64_t> earlierRows_;
};

}  // namespace tooljoint::io
