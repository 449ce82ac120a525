// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The sentence a piece of work fails with.
#pragma once

#include <functional>
#include <string>

#include "common/Error.hpp"

namespace tooljoint {

/// What `work` fails with; empty where it does not fail. Other exceptions pass.
inline std::string errorText(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace tooljoint
