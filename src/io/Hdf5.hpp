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

/// Keep HDF5 from printing its own error stack; its reasons are noted instead, for our sentences.
void silence();

/// Reason of the last failed call: the system's text ("No space left on device") when there is one,
/// else HDF5's innermost.
std::string lastReason();

/// Make the disk hold a place for everything the file will have once flushed; false, with the
/// reason noted, when it has no room. A flush that fails half-way leaves HDF5 1.10 unable to close
/// the file, so it must not be tried then.
bool reserve(hid_t file);

/// Whether a file that grows by so many bytes stays within the largest size of a file of this
/// process (RLIMIT_FSIZE); false, with the reason noted. Ask before HDF5 allocates: what it holds
/// must fit even into the memory of letGo(), to which the limit applies too.
bool fits(hid_t file, std::size_t bytes);

/// Close a file that can no longer be written. HDF5 would try to write what it still holds, fail,
/// keep the file open and crash at the end of the process; so its descriptor is first turned to
/// anonymous memory, and the file stays as last flushed.
void letGo(hid_t file);

/// Variable-length UTF-8 string type.
Handle textType();

/// Is there an object of this path? Every group on the way is opened, so a missing one is no
/// error.
bool hasLink(hid_t file, const std::string& path);

/// Write (or replace) a scalar text or number attribute; false when HDF5 refuses.
bool putAttribute(hid_t object, const std::string& name, const std::string& value);
bool putAttribute(hid_t object, const std::string& name, double value);
bool putAttribute(hid_t object, const std::string& name, int value);

}  // namespace tooljoint::io::hdf5
