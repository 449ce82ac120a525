// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Built-in component libraries; a deck needs no separate file for them (cmake/Templates.cmake).
#pragma once

#include <map>
#include <string>

namespace tooljoint::drillstring {

/// Name -> XML text: "api_pipes", xml/components/api_pipes.xml.
const std::map<std::string, std::string>& componentLibraries();

}  // namespace tooljoint::drillstring
