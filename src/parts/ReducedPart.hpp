// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A reduced part as a part of its own, to be written and used again without the one it came from.
#pragma once

#include <string>

#include "parts/file/PartFile.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::parts {

/// What a part that came from no file is to a file: every interface node a set of its name ("17").
PartContent contentOf(const model::Substructure& part);

/// The reduced part in total displacements of its kept dofs: with D = D_s + Phi q and s the part of
/// D_s on the kept dofs, coordinates q + s, so that it fits parts with another reference state.
/// Interface sets, positions and node numbers are those of `original`, whose dofs the reduced part
/// was made from; its basis is there, on the dofs of the first original. Point laws are left out
/// and named in `omitted`. ModelError for a basis that has no interface dofs as coordinates.
PartContent reducedContent(const PartContent& original,
                           const reduction::ReducedSubstructure& reduced);

}  // namespace tooljoint::parts
