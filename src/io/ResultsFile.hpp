// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writes results.h5: datasets with units and long names, growing time series, provenance.
/// docs/file-formats.md describes the layout. Only rank 0 writes; on the other ranks every call
/// returns at once, so callers need no rank test (but a FileError occurs only on rank 0: use
/// parallel::agree if all ranks must fail together).
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

/// Version of the layout of results.h5, first number of docs/file-formats.md: raised when readers
/// must be changed.
constexpr int resultsFormatVersion = 1;

using Shape = std::vector<std::size_t>;

/// Provenance of results. ResultsFile itself adds program versions, date and ranks.
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

/// A dataset that grows by one row per sample. Rows are buffered up to a chunk. flush() writes an
/// incomplete chunk uncompressed; it stays so until it is complete and flushed again.
class TimeSeries {
 public:
  ~TimeSeries();
  TimeSeries(const TimeSeries&) = delete;
  TimeSeries& operator=(const TimeSeries&) = delete;

  /// Adds one row of its shape. FileError if the file cannot be written, Error(Internal) with the
  /// dataset for a number that is not finite.
  void append(const double* row);
  void append(double value) { append(&value); }
  /// Number of rows appended so far, buffered ones included; 0 on ranks that do not write.
  std::size_t rows() const { return rows_; }

 private:
  friend class ResultsFile;
  TimeSeries(ResultsFile& file, std::string path, const Shape& rowShape);
  void writeChunk(std::vector<double>& values, std::size_t chunk, bool compressed);
  /// Replaces a complete chunk that is partly on disk; false if there is none.
  bool replace();
  /// Writes the buffer and continues buffering, or writes it compressed for the last time. Returns
  /// true if that replaces a part on disk.
  bool writeBuffer(bool last);

  ResultsFile& file_;
  std::string path_;
  Shape rowShape_;
  std::size_t rowSize_ = 1;
  std::size_t chunkRows_ = 1;
  std::size_t rows_ = 0;
  std::size_t written_ = 0;          ///< rows on the disk
  std::vector<double> buffer_;       ///< rows of the incomplete chunk
  bool begun_ = false;               ///< a part of that chunk is on disk, uncompressed
  std::vector<double> replacement_;  ///< the complete chunk `replaced_`, which is partly on disk
  std::size_t replaced_ = 0;
  std::int64_t dataset_ = -1;
};

/// An HDF5 results file under construction. It is written as `path`.part and renamed in finish(),
/// so that a file named `path` is always complete. After flush() the .part can be read even if the
/// process is killed.
class ResultsFile {
 public:
  /// Creates `path`.part and writes the provenance. FileError with the reason of the system if that
  /// fails.
  ResultsFile(const std::string& path, const Provenance& provenance,
              const ResultsOptions& options = {});
  /// Closes open objects; the .part remains and is readable.
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// Writes a dataset; missing groups are made. The product of `shape` is the number of values,
  /// row-major; {} is a scalar. `unit` is the SI unit ("1" for pure numbers, "" for text),
  /// `longName` a sentence. FileError on a write error, Error(Internal) for an existing path, a
  /// wrong shape, a missing unit or long name, or a number that is not finite.
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

  /// A new growing dataset, samples x rowShape. The reference is valid as long as this file.
  TimeSeries& series(const std::string& path, const Shape& rowShape, const std::string& unit,
                     const std::string& longName);

  /// Series made after this call begin with rows of an earlier results file; `rows` gives their
  /// number for each path. FileError if they cannot be read.
  void continueFrom(const std::string& file, const std::map<std::string, std::uint64_t>& rows);
  /// The rows with which a series of this path begins, row-major.
  std::vector<double> carried(const std::string& path) const;
  /// Rows of each series so far, by path.
  std::map<std::string, std::uint64_t> rows() const;

  /// Writes an attribute of an existing group or dataset ("/" for the file); replaces one with that
  /// name.
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, int value);

  /// Writes everything so far to disk.
  void flush();
  /// Writes buffered data and closes; the file remains `path`.part.
  void close();
  /// close(), then renames to `path`. Call once, at the end.
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
  bool failed_ = false;                          ///< a write failed: buffered data are discarded
  std::int64_t file_ = -1;
  std::vector<std::unique_ptr<TimeSeries>> series_;
  std::unique_ptr<ResultsReader> earlier_;  ///< source of continued series, if any
  std::map<std::string, std::uint64_t> earlierRows_;
};

}  // namespace tooljoint::io
