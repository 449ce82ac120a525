// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// RAII and error texts over the HDF5 C API, shared by writer and reader. Not for other rooms:
/// include ResultsFile.hpp.
#pragma once

#include <cstddef>
#include <hdf5.h>
#include <string>
#include <utility>

namespace tooljoint::io::hdf5 {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0 && close_ != nullptr) close_(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Stops HDF5 from printing its error stack; the reasons are stored for the messages of this
/// program.
void silence();

/// Reason of the last failed call: the text of the system ("No space left on device") if there is
/// one, otherwise the innermost one of HDF5.
std::string lastReason();

/// Reserves disk space for the complete file after the next flush; false, with the reason stored,
/// if there is not enough. HDF5 1.10 cannot close a file after a flush that failed half-way, so the
/// flush must not be tried then.
bool reserve(hid_t file);

/// True if a file that grows by this number of bytes stays within the file size limit of the
/// process (RLIMIT_FSIZE); otherwise false, with the reason stored. Call it before HDF5 allocates:
/// the limit also applies to the memory of letGo(), which must hold the data of HDF5.
bool fits(hid_t file, std::size_t bytes);

/// Closes a file that can no longer be written. HDF5 would try to write its buffered data, fail,
/// keep the file open and crash at the end of the process. Its descriptor is therefore first
/// redirected to anonymous memory, and the file remains as last flushed.
void letGo(hid_t file);

/// Variable-length UTF-8 string type.
Handle textType();

/// True if an object of this path exists. Every group of the path is opened, so a missing group is
/// no error.
bool hasLink(hid_t file, const std::string& path);

/// Writes (or replaces) a scalar text or number attribute; false if HDF5 fails.
bool putAttribute(hid_t object, const std::string& name, const std::string& value);
bool putAttribute(hid_t object, const std::string& name, double value);
bool putAttribute(hid_t object, const std::string& name, int value);

}  // namespace tooljoint::io::hdf5
