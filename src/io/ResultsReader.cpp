// SPDX-License-Identifier: BSD-3-Clause
#include "io/ResultsReader.hpp"

#include <algorithm>

#include "common/Error.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "io/Hdf5.hpp"

namespace tooljoint::io {

using hdf5::Handle;

namespace {

constexpr double largestDataset = 2147483648.0;  // values: 16 GB of numbers
constexpr double smallDataset = 8388608.0;       // bytes; always allowed for a dataset
constexpr hsize_t largestTexts = 1U << 30U;  // bytes; many texts may refer to the same stored text
constexpr double bestCompression =
    1032.0;  // largest compression ratio of deflate (zlib: technical details)

Handle openDataset(hid_t file, const std::string& path) {
  return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
}

std::vector<std::size_t> extents(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

/// Product of the extents, infinite if too large for an integer.
double valuesOf(const std::vector<std::size_t>& shape) {
  double count = 1.0;
  for (std::size_t extent : shape) count *= static_cast<double>(extent);
  return count;
}

/// True if a dataset stores its values in other files, which may be anything.
bool isElsewhere(hid_t dataset) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_external_count(creation.get()) != 0 || H5Pget_layout(creation.get()) == H5D_VIRTUAL;
}

/// Name of a filter of a dataset that this HDF5 cannot decode; empty if it can decode all.
std::string unknownFilter(hid_t dataset) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  for (int i = 0; i < H5Pget_nfilters(creation.get()); ++i) {
    char name[64] = "";
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(creation.get(), static_cast<unsigned>(i), nullptr,
                                               &values, nullptr, sizeof name, name, nullptr);
    if (filter >= 0 && H5Zfilter_avail(filter) <= 0)
      return *name != '\0' ? std::string(name) : "filter " + std::to_string(filter);
  }
  return {};
}

/// Size of a file opened by HDF5 [bytes].
double fileSize(hid_t file) {
  hsize_t size = 0;
  H5Fget_filesize(file, &size);
  return static_cast<double>(size);
}

herr_t visit(hid_t /*file*/, const char* name, const H5O_info_t* info, void* data) {
  if (info->type == H5O_TYPE_DATASET)
    static_cast<std::vector<std::string>*>(data)->push_back("/" + std::string(name));
  return 0;
}

/// True if an attribute has exactly one value.
bool isSingle(const Handle& attribute) {
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  return H5Sget_simple_extent_npoints(space.get()) == 1;
}

/// True if the type of a dataset or attribute belongs to one of two classes.
bool isClass(const Handle& type, H5T_class_t a, H5T_class_t b) {
  const H5T_class_t found = H5Tget_class(type.get());
  return found == a || found == b;
}

/// A text of fixed length, padded with zeros or blanks.
bool isFixedText(const Handle& type) {
  return H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) <= 0;
}

/// `count` of them; `read` fills the bytes with the type of the file.
template <class Read>
std::vector<std::string> fixedTexts(const Handle& type, std::size_t count, const Read& read) {
  const std::size_t length = H5Tget_size(type.get());
  std::vector<char> bytes(count * length);
  std::vector<std::string> values;
  if (!bytes.empty() && read(bytes.data()) < 0) return values;
  const bool blanks = H5Tget_strpad(type.get()) == H5T_STR_SPACEPAD;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string text(bytes.data() + i * length, length);
    values.push_back(text.substr(0, text.find('\0')));
    if (blanks) values.back().erase(values.back().find_last_not_of(' ') + 1);
  }
  return values;
}

}  // namespace

ResultsReader::ResultsReader(const std::string& path) : path_(path) {
  hdf5::silence();
  const std::string reason = whyUnreadable(path);
  if (!reason.empty())
    throw FileError("The results file " + path + " cannot be read: " + reason + ".");
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0)
    throw FileError("The results file " + path + " cannot be read: " + hdf5::lastReason() + ".");
}

ResultsReader::~ResultsReader() {
  if (file_ >= 0) H5Fclose(file_);
}

void ResultsReader::fail(const std::string& what) const {
  throw FileError("The results file " + path_ + " has no " + what + ".");
}

std::size_t ResultsReader::count(const std::string& path, std::int64_t dataset) const {
  if (isElsewhere(dataset))
    throw FileError("The results file " + path_ + " has the values of " + path +
                    " in other files, which are not read. Copy them into it.");
  if (const std::string filter = unknownFilter(dataset); !filter.empty())
    throw FileError("The results file " + path_ + " has " + path + " compressed by \"" + filter +
                    "\", which this program cannot undo. Write it with gzip, or without "
                    "compression.");
  const double values = valuesOf(extents(dataset));
  const Handle type(H5Dget_type(dataset), H5Tclose);
  const double bytes = values * static_cast<double>(H5Tget_size(type.get()));
  const double stored =
      std::min(static_cast<double>(H5Dget_storage_size(dataset)), fileSize(file_));
  const bool small = bytes <= smallDataset;
  if (values > largestDataset || !(small || bytes <= bestCompression * stored))
    throw FileError("The results file " + path_ + " announces " + formatNumber(values) +
                    " values in " + path + ", for which it stores " + formatNumber(stored) +
                    " bytes: it is damaged, or no file of this program.");
  return static_cast<std::size_t>(values);
}

bool ResultsReader::has(const std::string& path) const { return hdf5::hasLink(file_, path); }

std::vector<std::string> ResultsReader::datasets() const {
  std::vector<std::string> paths;
  H5Ovisit(file_, H5_INDEX_NAME, H5_ITER_INC, visit, &paths);
  return paths;
}

std::vector<std::size_t> ResultsReader::shape(const std::string& path) const {
  const Handle dataset = openDataset(file_, path);
  if (!dataset.valid()) fail("dataset " + path);
  return extents(dataset.get());
}

ResultsReader::Kind ResultsReader::kind(const std::string& path) const {
  const Handle dataset = openDataset(file_, path);
  if (!dataset.valid()) fail("dataset " + path);
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const H5T_class_t found = H5Tget_class(type.get());
  return found == H5T_STRING ? Kind::Text : found == H5T_INTEGER ? Kind::Integer : Kind::Real;
}

std::vector<double> ResultsReader::numbers(const std::string& path) const {
  const Handle dataset = openDataset(file_, path);
  if (!dataset.valid()) fail("dataset " + path);
  std::vector<double> values(count(path, dataset.get()));
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  if (!isClass(type, H5T_FLOAT, H5T_INTEGER) ||
      (!values.empty() && H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                  values.data()) < 0)) {
    fail("readable numbers in " + path);
  }
  return values;
}

std::vector<double> ResultsReader::rows(const std::string& path, std::size_t first,
                                        std::size_t count) const {
  const Handle dataset = openDataset(file_, path);
  if (!dataset.valid()) fail("dataset " + path);
  const std::vector<std::size_t> whole = extents(dataset.get());
  if (whole.empty() || first > whole[0] || count > whole[0] - first) {
    fail("rows " + std::to_string(first) + " to " + std::to_string(first + count) + " in " + path);
  }
  std::vector<hsize_t> start(whole.size(), 0);
  std::vector<hsize_t> block(whole.begin(), whole.end());
  start[0] = first;
  block[0] = count;
  this->count(path, dataset.get());
  std::size_t size = count;
  for (std::size_t i = 1; i < whole.size(); ++i) size *= whole[i];
  std::vector<double> values(size);
  if (size == 0) return values;
  const Handle onDisk(H5Dget_space(dataset.get()), H5Sclose);
  const Handle inMemory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                        H5Sclose);
  H5Sselect_hyperslab(onDisk.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  if (H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, inMemory.get(), onDisk.get(), H5P_DEFAULT,
              values.data()) < 0) {
    fail("readable numbers in " + path);
  }
  return values;
}

std::vector<int> ResultsReader::integers(const std::string& path) const {
  const Handle dataset = openDataset(file_, path);
  if (!dataset.valid()) fail("dataset " + path);
  std::vector<int> values(count(path, dataset.get()));
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  if (!isClass(type, H5T_INTEGER, H5T_INTEGER) ||
      (!values.empty() &&
       H5Dread(dataset.get(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)) {
    fail("readable integers in " + path);
  }
  return values;
}

std::vector<std::string> ResultsReader::texts(const std::string& path) const {
  const Handle dataset = openDataset(file_, path);
  if (!dataset.valid()) fail("dataset " + path);
  const std::size_t number = count(path, dataset.get());
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  if (isFixedText(type)) {
    const auto fixed = fixedTexts(type, number, [&](char* bytes) {
      return H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes);
    });
    if (fixed.size() < number) fail("readable texts in " + path);
    return fixed;
  }
  std::vector<char*> raw(number, nullptr);
  const Handle text = hdf5::textType();
  const Handle all(H5Dget_space(dataset.get()), H5Sclose);
  hsize_t bytes = 0;
  if (H5Tis_variable_str(type.get()) > 0 &&
      H5Dvlen_get_buf_size(dataset.get(), type.get(), all.get(), &bytes) >= 0 &&
      bytes > largestTexts)
    fail("texts of less than 1 GB in " + path);
  if (!isClass(type, H5T_STRING, H5T_STRING) ||
      (!raw.empty() &&
       H5Dread(dataset.get(), text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) < 0)) {
    fail("readable texts in " + path);
  }
  std::vector<std::string> values;
  for (const char* one : raw) values.emplace_back(one != nullptr ? one : "");
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  if (!raw.empty()) H5Dvlen_reclaim(text.get(), space.get(), H5P_DEFAULT, raw.data());
  return values;
}

bool ResultsReader::hasAttribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string ResultsReader::textAttribute(const std::string& object, const std::string& name) const {
  const Handle attribute(
      H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail("attribute " + name + " of " + object);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  if (isFixedText(type) && isSingle(attribute)) {
    const auto fixed = fixedTexts(
        type, 1, [&](char* bytes) { return H5Aread(attribute.get(), type.get(), bytes); });
    if (fixed.empty()) fail("text in the attribute " + name + " of " + object);
    return fixed.front();
  }
  char* raw = nullptr;
  if (!isClass(type, H5T_STRING, H5T_STRING) || !isSingle(attribute) ||
      H5Aread(attribute.get(), hdf5::textType().get(), &raw) < 0) {
    fail("text in the attribute " + name + " of " + object);
  }
  std::string value = raw != nullptr ? raw : "";
  H5free_memory(raw);
  return value;
}

}  // namespace tooljoint::io
