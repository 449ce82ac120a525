// SPDX-License-Identifier: BSD-3-Clause
#include "io/Hdf5.hpp"

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
  // "file write failed: time = ..., errno = 28, error message = 'No space left on device', buf = ..."
  const std::string mark = "error message = '";
  const auto begin = text.find(mark);
  if (reason.system.empty() && begin != std::string::npos) {
    const auto from = begin + mark.size();
    reason.system = text.substr(from, text.find('\'', from) - from);
  }
  return 0;
}

bool putScalar(hid_t object, const std::string& name, hid_t type, const void* value) {
  if (H5Aexists(object, name.c_str()) > 0 && H5Adelete(object, name.c_str()) < 0) return false;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), type, value) >= 0;
}

}  // namespace

void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string lastReason() {
  Reason reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &reason);
  if (!reason.system.empty()) return reason.system;
  return reason.innermost.empty() ? "unknown reason" : reason.innermost;
}

Handle textType() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

bool putAttribute(hid_t object, const std::string& name, const std::string& value) {
  const char* text = value.c_str();
  return putScalar(object, name, textType().get(), &text);
}
bool putAttribute(hid_t object, const std::string& name, double value) {
  return putScalar(object, name, H5T_NATIVE_DOUBLE, &value);
}
bool putAttribute(hid_t object, const std::string& name, int value) { return putScalar(object, name, H5T_NATIVE_INT, &value); }

}  // namespace tooljoint::io::hdf5
