// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Codes of the header entry of DMIG (Nastran quick reference guide, bulk data entry DMIG).
#pragma once

namespace tooljoint::parts::dmig {

/// Forms of a matrix (IFO).
inline constexpr int square = 1, rectangular = 2, symmetric = 6, columnsByNumber = 9;
/// Types of what is given (TIN).
inline constexpr int singleReal = 1, doubleReal = 2;

}  // namespace tooljoint::parts::dmig
