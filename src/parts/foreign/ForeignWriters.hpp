// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parts as files of other codes. These contain constant real matrices, labels and loads, but no
/// bases, sets and states.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

/// The matrices of a part whose terms are all constant.
struct ConstantMatrices {
  Sparse mass, damping, stiffness;
};

/// Sums of the terms. ModelError with part, term and law if a term varies in time; `format` is the
/// name of the file format in the message.
ConstantMatrices constantMatrices(const PartContent& content, const std::string& format);

/// Number of each component from 1 to 6 by its direction (u v w theta_x theta_y theta_z and the
/// other names of coupling::componentAxes), 0 for "s" of scalar points. If a name has no direction,
/// all components are numbered in their order. ModelError for more than six.
std::vector<int> componentNumbers(const PartContent& content);

/// DMIG entries of a Nastran punch file: KAAX, MAAX, BAAX and PAX in large field with D exponents,
/// as written by EXTSEOUT(DMIGPCH) (MSC Nastran Quick Reference Guide, "DMIG"), and GRID entries of
/// the positions. Coordinates without a node are scalar points after the largest node. ModelError
/// for terms and loads with a law of time.
std::string dmigText(const PartContent& content);

/// The superelement file (FileFormat FlexASCII) of the module ExtPtfm of OpenFAST, according to its
/// manual, "Superelement input file", and ReadFlexASCII of ExtPtfm_MCKF_IO.f90: header, mass,
/// stiffness, damping, and loads over time without waves. ModelError unless the part has one node
/// with six components, and modes; for terms with a law of time; for a line of loads longer than
/// the 4096 characters that OpenFAST reads.
std::string extPtfmText(const PartContent& content, const LoadTimes& times);

}  // namespace tooljoint::parts
