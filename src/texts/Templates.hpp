// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The files of xml/templates, built into the program (cmake/Templates.cmake).
#pragma once

#include <map>
#include <string>

namespace tooljoint::texts {

/// File name -> text.
const std::map<std::string, std::string>& templateFiles();

}  // namespace tooljoint::texts
