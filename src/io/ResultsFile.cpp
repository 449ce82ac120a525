// SPDX-License-Identifier: BSD-3-Clause
#include "io/ResultsFile.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "io/ChunkCompressor.hpp"
#include "io/Hdf5.hpp"
#include "io/ResultsReader.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::io {

using hdf5::Handle;

namespace {

/// Rows of one chunk of a time series: about as many as give these bytes, and a few for long rows.
constexpr std::size_t chunkBytes = 1U << 16U, longChunkBytes = 1U << 18U, fewRows = 4;

std::size_t rowsOfChunk(std::size_t rowSize) {
  const std::size_t bytes = std::max<std::size_t>(rowSize, 1) * sizeof(double);
  return std::clamp<std::size_t>(
      std::max(chunkBytes / bytes, std::min(fewRows, longChunkBytes / bytes)), 1, 1024);
}

[[noreturn]] void wrongUse(const std::string& sentence) {
  throw Error(ExitCode::Internal, sentence);
}

std::size_t product(const Shape& shape) {
  std::size_t count = 1;
  for (std::size_t extent : shape) count *= extent;
  return count;
}

void requireFinite(const std::string& path, const double* values, std::size_t count) {
  const double* bad =
      std::find_if(values, values + count, [](double x) { return !std::isfinite(x); });
  if (bad != values + count) {
    wrongUse("The result " + path + " holds " + formatNumber(*bad) + " at position " +
             std::to_string(bad - values) + ", which is never written.");
  }
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Access properties with which the structure of the file on disk changes only in flush(): no
/// metadata is evicted from the cache in between, so a killed process leaves the state of the last
/// flush.
Handle accessProperties() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(access.get(), &cache);
  cache.evictions_enabled = false;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  H5Pset_mdc_config(access.get(), &cache);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  return access;
}

/// Creation properties of a dataset. `early`: its position in the file is fixed before its values
/// are written, so that it can be reserved (not for compressed data and texts, whose size is
/// unknown then).
Handle creationProperties(bool early) {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (early) {
    H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  }
  return creation;
}

}  // namespace

// -------------------------------------------------------------------------------------------------
// TimeSeries

TimeSeries::TimeSeries(ResultsFile& file, std::string path, const Shape& rowShape)
    : file_(file),
      path_(std::move(path)),
      rowShape_(rowShape),
      rowSize_(product(rowShape)),
      chunkRows_(rowsOfChunk(rowSize_)) {}

TimeSeries::~TimeSeries() = default;

void TimeSeries::append(const double* row) {
  if (!file_.active_) return;
  if (file_.file_ < 0)
    wrongUse("The results file " + file_.path_ + " is closed; " + path_ + " cannot grow.");
  requireFinite(path_, row, rowSize_);
  buffer_.insert(buffer_.end(), row, row + rowSize_);
  ++rows_;
  if (rows_ % chunkRows_ != 0) return;
  const std::size_t chunk = rows_ / chunkRows_ - 1;
  if (begun_ && file_.compressor_) {
    replacement_.swap(buffer_);
    replaced_ = chunk;
  } else {
    writeChunk(buffer_, chunk, true);
  }
  buffer_.clear();
  begun_ = false;
}

/// Writes chunk number `chunk`; `values` are padded with zeros to a complete chunk.
void TimeSeries::writeChunk(std::vector<double>& values, std::size_t chunk, bool compressed) {
  if (rowSize_ == 0) return;
  written_ = std::max(written_, chunk * chunkRows_ + values.size() / rowSize_);
  values.resize(chunkRows_ * rowSize_);
  const void* bytes = values.data();
  std::size_t size = values.size() * sizeof(double);
  std::uint32_t leftOut = 0;  // a bit for each filter not applied to the chunk
  if (file_.compressor_) {
    constexpr std::uint32_t shuffleAndDeflate = 3;
    leftOut = shuffleAndDeflate;
    if (compressed) {
      const auto& packed = file_.compressor_->compress(values, rowSize_);
      if (packed.size() < size) bytes = packed.data(), size = packed.size(), leftOut = 0;
    }
  }
  std::vector<hsize_t> extent{written_}, start{chunk * chunkRows_};
  extent.insert(extent.end(), rowShape_.begin(), rowShape_.end());
  start.resize(extent.size());
  const bool inPlace = begun_ && bytes == values.data();
  const bool good = hdf5::fits(file_.file_, inPlace ? 0 : size) &&
                    H5Dset_extent(dataset_, extent.data()) >= 0 && hdf5::reserve(file_.file_) &&
                    H5Dwrite_chunk(dataset_, H5P_DEFAULT, leftOut, start.data(), size, bytes) >= 0;
  if (!good) file_.fail("writing " + path_);
}

bool TimeSeries::replace() {
  if (replacement_.empty()) return false;
  writeChunk(replacement_, replaced_, true);
  replacement_.clear();
  return true;
}

bool TimeSeries::writeBuffer(bool last) {
  if (buffer_.empty()) return false;
  const std::size_t held = buffer_.size();
  writeChunk(buffer_, (rows_ - 1) / chunkRows_, last);
  buffer_.resize(last ? 0 : held);
  return std::exchange(begun_, !last) && last;
}

// -------------------------------------------------------------------------------------------------
// ResultsFile

struct ResultsFile::DatasetRequest {
  const std::string& path;
  hid_t type;
  hid_t space;
  hid_t creation;
  hid_t access;
  const std::string& unit;
  const std::string& longName;
};

ResultsFile::ResultsFile(const std::string& path, const Provenance& provenance,
                         const ResultsOptions& options)
    : path_(path), options_(options), active_(parallel::rank() == 0) {
  if (!active_) return;
  if (options_.compression > 0)
    compressor_ = std::make_unique<ChunkCompressor>(options_.compression);
  hdf5::silence();
  stageText(path_,
            std::string(4096, '\0'));  // a full disk is detected here, more simply than inside HDF5
  file_ = H5Fcreate(partPath().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, accessProperties().get());
  if (file_ < 0) fail("creating it");
  try {
    attribute("/", "format", std::string("tooljoint results"));
    attribute("/", "format_version", resultsFormatVersion);
    attribute("/", "program_version", programVersion());
    attribute("/", "git_hash", gitHash());
    attribute("/", "trilinos_version", trilinosVersion());
    attribute("/", "mpi_version", mpiVersion());
    attribute("/", "hdf5_version", hdf5Version());
    attribute("/", "date", now());
    attribute("/", "ranks", parallel::size());
    attribute("/", "deck_file", provenance.deckFile);
    attribute("/", "deck_sha256", provenance.deckSha256);
    attribute("/", "deck_text", provenance.deckText);
    attribute("/", "overrides", join(provenance.overrides, "\n"));
    flush();
  } catch (...) {
    abandon();
    throw;
  }
}

ResultsFile::~ResultsFile() {
  try {
    close();
  } catch (...) {  // a destructor must not throw; errors are reported by close() or finish()
    abandon();
  }
}

void ResultsFile::fail(const std::string& doing) {
  const std::string reason = hdf5::lastReason();
  failed_ = true;
  abandon();
  std::string advice = "Make room or name another folder with --output.";
  if (reason == std::strerror(EAGAIN)) {
    advice =
        "Another run seems to be writing there; where the file system cannot lock files, set "
        "HDF5_USE_FILE_LOCKING=FALSE.";
  }
  throw FileError("The results file " + partPath() + " cannot be written (" + doing +
                  "): " + reason + ". " + advice);
}

/// Discards buffered data and releases the file; this also closes its datasets (H5F_CLOSE_STRONG).
void ResultsFile::abandon() noexcept {
  for (auto& s : series_) {
    s->buffer_.clear();
    s->replacement_.clear();
    s->dataset_ = -1;
  }
  if (file_ >= 0) hdf5::letGo(std::exchange(file_, -1));
}

std::int64_t ResultsFile::createDataset(const DatasetRequest& request) {
  if (file_ < 0)
    wrongUse("The results file " + path_ + " is closed; " + request.path + " cannot be written.");
  if (request.longName.empty()) wrongUse("The result " + request.path + " has no long name.");
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link.get(), 1);
  const hid_t dataset = H5Dcreate2(file_, request.path.c_str(), request.type, request.space,
                                   link.get(), request.creation, request.access);
  if (dataset < 0) {
    if (hdf5::hasLink(file_, request.path))
      wrongUse("The result " + request.path + " is written twice.");
    fail("making " + request.path);
  }
  if (!hdf5::putAttribute(dataset, "units", request.unit) ||
      !hdf5::putAttribute(dataset, "long_name", request.longName)) {
    H5Dclose(dataset);
    fail("making " + request.path);
  }
  return dataset;
}

void ResultsFile::writeValues(const std::string& path, std::int64_t type, const void* values,
                              std::size_t count, const Shape& shape, const std::string& unit,
                              const std::string& longName) {
  if (product(shape) != count) {
    wrongUse("The result " + path + " has " + std::to_string(count) +
             " values, but its shape has " + std::to_string(product(shape)) + ".");
  }
  if (file_ >= 0 && !hdf5::fits(file_, count * sizeof(double))) fail("making " + path);
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Handle space(
      shape.empty() ? H5Screate(H5S_SCALAR)
                    : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
      H5Sclose);
  const Handle creation = creationProperties(H5Tis_variable_str(type) <= 0);
  const Handle dataset(
      createDataset({path, type, space.get(), creation.get(), H5P_DEFAULT, unit, longName}),
      H5Dclose);
  if (!hdf5::reserve(file_)) fail("writing " + path);
  if (count > 0 && H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail("writing " + path);
}

void ResultsFile::write(const std::string& path, const double* values, const Shape& shape,
                        const std::string& unit, const std::string& longName) {
  if (!active_) return;
  if (unit.empty()) wrongUse("The result " + path + " has no unit; \"1\" is that of pure numbers.");
  requireFinite(path, values, product(shape));
  writeValues(path, H5T_NATIVE_DOUBLE, values, product(shape), shape, unit, longName);
}

void ResultsFile::write(const std::string& path, const std::vector<double>& values,
                        const Shape& shape, const std::string& unit, const std::string& longName) {
  if (product(shape) != values.size()) {
    wrongUse("The result " + path + " has " + std::to_string(values.size()) +
             " values, but its shape has " + std::to_string(product(shape)) + ".");
  }
  write(path, values.data(), shape, unit, longName);
}

void ResultsFile::write(const std::string& path, const Vector& values, const Shape& shape,
                        const std::string& unit, const std::string& longName) {
  write(path, std::vector<double>(values.data(), values.data() + values.size()), shape, unit,
        longName);
}

void ResultsFile::write(const std::string& path, const std::vector<int>& values, const Shape& shape,
                        const std::string& unit, const std::string& longName) {
  if (!active_) return;
  if (unit.empty()) wrongUse("The result " + path + " has no unit; \"1\" is that of pure numbers.");
  writeValues(path, H5T_NATIVE_INT, values.data(), values.size(), shape, unit, longName);
}

void ResultsFile::write(const std::string& path, const std::vector<std::string>& values,
                        const std::string& longName) {
  if (!active_) return;
  std::vector<const char*> texts;
  texts.reserve(values.size());
  for (const auto& value : values) texts.push_back(value.c_str());
  writeValues(path, hdf5::textType().get(), texts.data(), texts.size(), {texts.size()}, "",
              longName);
}

void ResultsFile::write(const std::string& path, const Matrix& values, const std::string& unit,
                        const std::string& longName) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
  write(path, rows.data(),
        {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())}, unit,
        longName);
}

void ResultsFile::write(const std::string& path, double value, const std::string& unit,
                        const std::string& longName) {
  write(path, &value, Shape{}, unit, longName);
}

TimeSeries& ResultsFile::series(const std::string& path, const Shape& rowShape,
                                const std::string& unit, const std::string& longName) {
  series_.push_back(std::unique_ptr<TimeSeries>(new TimeSeries(*this, path, rowShape)));
  TimeSeries& result = *series_.back();
  if (!active_) return result;
  if (unit.empty()) wrongUse("The result " + path + " has no unit; \"1\" is that of pure numbers.");
  std::vector<hsize_t> extent{0};
  std::vector<hsize_t> limit{H5S_UNLIMITED};
  std::vector<hsize_t> chunk{result.chunkRows_};
  for (std::size_t e : rowShape) {
    extent.push_back(e);
    limit.push_back(e);
    chunk.push_back(std::max<std::size_t>(e, 1));
  }
  const auto rank = static_cast<int>(extent.size());
  const Handle space(H5Screate_simple(rank, extent.data(), limit.data()), H5Sclose);
  const Handle creation = creationProperties(options_.compression == 0);
  H5Pset_chunk(creation.get(), rank, chunk.data());
  if (options_.compression > 0) {
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), static_cast<unsigned>(options_.compression));
  }
  // no chunk cache: rows are buffered here, and a write either reaches the disk or fails
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access.get(), 0, 0, 0.0);
  result.dataset_ = createDataset(
      {path, H5T_NATIVE_DOUBLE, space.get(), creation.get(), access.get(), unit, longName});
  result.buffer_.reserve(result.chunkRows_ * result.rowSize_);
  const std::size_t carried = earlierRows_.count(path) > 0 ? earlierRows_.at(path) : 0;
  for (std::size_t first = 0; first < carried; first += result.chunkRows_) {
    const std::size_t count = std::min(result.chunkRows_, carried - first);
    const auto rows = earlier_->rows(path, first, count);
    if (rows.size() != count * result.rowSize_)
      throw FileError("The results before the checkpoint have another size of " + path + ".");
    for (std::size_t i = 0; i < count; ++i) result.append(rows.data() + i * result.rowSize_);
  }
  return result;
}

void ResultsFile::continueFrom(const std::string& file,
                               const std::map<std::string, std::uint64_t>& rows) {
  if (!active_) return;
  earlier_ = std::make_unique<ResultsReader>(file);
  earlierRows_ = rows;
}

std::vector<double> ResultsFile::carried(const std::string& path) const {
  const auto found = earlierRows_.find(path);
  return found == earlierRows_.end() ? std::vector<double>()
                                     : earlier_->rows(path, 0, found->second);
}

std::map<std::string, std::uint64_t> ResultsFile::rows() const {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& s : series_) counts[s->path_] = s->rows_;
  return counts;
}

namespace {

template <class Value>
bool attributeOf(hid_t file, const std::string& object, const std::string& name,
                 const Value& value) {
  const Handle target(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
  return target.valid() && hdf5::putAttribute(target.get(), name, value);
}

}  // namespace

void ResultsFile::attribute(const std::string& object, const std::string& name,
                            const std::string& value) {
  if (active_ && !attributeOf(file_, object, name, value))
    fail("attribute " + name + " of " + object);
}
void ResultsFile::attribute(const std::string& object, const std::string& name, double value) {
  if (active_ && !attributeOf(file_, object, name, value))
    fail("attribute " + name + " of " + object);
}
void ResultsFile::attribute(const std::string& object, const std::string& name, int value) {
  if (active_ && !attributeOf(file_, object, name, value))
    fail("attribute " + name + " of " + object);
}

void ResultsFile::flush() { writeBuffers(false); }

/// Chunks that are partly on disk are replaced one by one: the space of the old chunk must not be
/// reused before the index on disk no longer refers to it.
void ResultsFile::writeBuffers(bool last) {
  if (!active_ || file_ < 0) return;
  const auto synchronise = [this] {
    if (!hdf5::reserve(file_) || H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail("flushing it");
  };
  for (auto& s : series_) {
    if (s->replace()) synchronise();
    if (s->writeBuffer(last)) synchronise();  // may use the space of the replaced chunk
  }
  synchronise();
}

void ResultsFile::close() {
  if (!active_ || file_ < 0) return;
  writeBuffers(true);
  for (auto& s : series_) {
    H5Dclose(s->dataset_);
    s->dataset_ = -1;
  }
  if (H5Fclose(file_) < 0) fail("closing it");
  file_ = -1;
}

void ResultsFile::finish() {
  if (!active_) return;
  if (failed_) wrongUse("The results file " + path_ + " failed before and cannot be finished.");
  close();
  if (std::rename(partPath().c_str(), path_.c_str()) != 0) {
    throw FileError("The results file " + partPath() + " cannot be renamed to " + path_ + ": " +
                    std::strerror(errno) + ".");
  }
}

}  // namespace tooljoint::io
