// SPDX-License-Identifier: BSD-3-Clause
#include "io/Hdf5.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tooljoint::io::hdf5 {
namespace {

/// Collects the innermost description, and the system's own text when one is quoted.
struct Reason {
  std::string innermost;
  std::string system;
};

herr_t collect(unsigned /*n*/, const H5E_error2_t* error, void* data) {
  auto& reason = *static_cast<Reason*>(data);
  const std::string text = error->desc != nullptr ? error->desc : "";
  if (reason.innermost.empty()) reason.innermost = text;
  // "file write failed: time = ..., errno = 28, error message = 'No space left on device', buf =
  // ..."
  const std::string mark = "error message = '";
  const auto begin = text.find(mark);
  if (reason.system.empty() && begin != std::string::npos) {
    const auto from = begin + mark.size();
    reason.system = text.substr(from, text.find('\'', from) - from);
  }
  return 0;
}

std::string& noted() {
  static std::string reason;
  return reason;
}

/// Called by HDF5 when one of its functions fails, while the error stack is complete (the next call
/// clears it).
herr_t note(hid_t stack, void* /*data*/) {
  Reason reason;
  H5Ewalk2(stack, H5E_WALK_UPWARD, collect, &reason);
  noted() = reason.system.empty() ? reason.innermost : reason.system;
  return 0;
}

/// Descriptor of an open file, -1 when its driver has none.
int descriptorOf(hid_t file) {
  void* handle = nullptr;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) < 0 || handle == nullptr) return -1;
  return *static_cast<int*>(handle);
}

bool putScalar(hid_t object, const std::string& name, hid_t type, const void* value) {
  if (H5Aexists(object, name.c_str()) > 0 && H5Adelete(object, name.c_str()) < 0) return false;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), type, value) >= 0;
}

}  // namespace

void silence() { H5Eset_auto2(H5E_DEFAULT, note, nullptr); }

std::string lastReason() { return noted().empty() ? "unknown reason" : noted(); }

bool reserve(hid_t file) {
  const int descriptor = descriptorOf(file);
  hsize_t end = 0;
  struct stat now {};
  if (descriptor < 0 || H5Fget_filesize(file, &end) < 0 || ::fstat(descriptor, &now) != 0)
    return true;  // nothing to report
  const auto wanted = static_cast<off_t>(end);
  if (now.st_size >= wanted) return true;
  int error = ::posix_fallocate(descriptor, now.st_size, wanted - now.st_size);
  if (error != 0 && error != ENOSPC && error != EFBIG &&
      error != EDQUOT) {  // not supported by this file system: try a byte at the end
    error = ::pwrite(descriptor, "", 1, wanted - 1) == 1 ? 0 : errno;
  }
  if (error != 0) noted() = std::strerror(error);
  return error == 0;
}

bool fits(hid_t file, std::size_t bytes) {
  constexpr hsize_t structure =
      1U << 18U;  ///< more than the growth of headers and indices between two calls
  rlimit limit{};
  hsize_t end = 0;
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      H5Fget_filesize(file, &end) < 0)
    return true;
  if (end + bytes + structure <= limit.rlim_cur) return true;
  noted() = std::strerror(EFBIG);
  return false;
}

void letGo(hid_t file) {
  const int descriptor = descriptorOf(file);
  const int memory = ::memfd_create("tooljoint-results", MFD_CLOEXEC);
  if (descriptor >= 0 && memory >= 0) ::dup2(memory, descriptor);
  if (memory >= 0) ::close(memory);
  H5Fclose(file);
}

Handle textType() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

bool hasLink(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/', 1); end != std::string::npos;
       end = path.find('/', end + 1)) {
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

bool putAttribute(hid_t object, const std::string& name, const std::string& value) {
  const char* text = value.c_str();
  return putScalar(object, name, textType().get(), &text);
}
bool putAttribute(hid_t object, const std::string& name, double value) {
  return putScalar(object, name, H5T_NATIVE_DOUBLE, &value);
}
bool putAttribute(hid_t object, const std::string& name, int value) {
  return putScalar(object, name, H5T_NATIVE_INT, &value);
}

}  // namespace tooljoint::io::hdf5
