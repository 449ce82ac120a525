// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A reduced part as a new part that can be written to a file and used without the original.
#pragma once

#include <string>

#include "parts/file/PartFile.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::parts {

/// File content of a part without a file: every interface node becomes a set named by its number
/// ("17").
PartContent contentOf(const model::Substructure& part);

/// The reduced part in total displacements of its boundary dofs: with D = D_s + Phi q and the
/// values s of D_s on these dofs, its coordinates are q + s, so that it fits parts with another
/// reference state. Interface sets, positions and node numbers are those of `original`, from whose
/// dofs the reduced part was made; its basis refers to the dofs of the first original. Point laws
/// are only listed in `omitted`. ModelError for a basis without interface coordinates.
PartContent reducedContent(const PartContent& original,
                           const reduction::ReducedSubstructure& reduced);

}  // namespace tooljoint::parts
