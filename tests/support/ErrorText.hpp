// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The message of a failure.
#pragma once

#include <functional>
#include <string>

#include "common/Error.hpp"

namespace tooljoint {

/// Message with which `work` fails; empty if it does not fail. Other exceptions pass.
inline std::string errorText(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace tooljoint
