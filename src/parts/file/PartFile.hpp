// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Part files: matrices, loads, labels and interfaces of a part in files that any program
/// can write, and reduced parts written the same way. docs/file-formats.md describes the format:
/// either a JSON file that names Matrix Market files, or one HDF5 file.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/SharedSparse.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::parts {

/// Value of "format" in a part file.
constexpr const char* partFormat = "tooljoint part 1";

/// Dofs that may be joined with those of another part, in the order of the file.
struct InterfaceSet {
  std::string name;
  std::vector<int> dofs;            ///< positions
  std::vector<std::int64_t> nodes;  ///< each once, in order of first appearance
};

/// Vectors of the part this one was reduced from: D = offset + vectors q.
struct StoredBasis {
  std::vector<model::DofLabel> dofs;  ///< rows
  model::SharedSparse vectors;
  Vector offset;
  bool empty() const { return dofs.empty(); }
};

/// A part as a file holds it. Coordinates without a node (modes of a part that was reduced before)
/// have Modal labels.
struct PartContent {
  std::string file;
  model::Substructure part;  ///< interface: the dofs of all sets; laws have names, and NaN for a
                             ///< value but that of "1"
  std::vector<InterfaceSet> interfaces;
  std::map<std::int64_t, Vector3>
      positions;      ///< of nodes, in the frame of the part [m]; empty when the file gives none
  StoredBasis basis;  ///< empty unless the file holds one
  std::vector<std::string>
      omitted;          ///< point laws of the original part, which a part file cannot hold
  bool turned = false;  ///< a scene has other axes than the part
};

/// Nodes that a part knows: those of its dofs, and of the rows of its basis.
std::set<std::int64_t> nodesOf(const PartContent& content);

/// Whether what a deck gives as File is the text of a part.json, not its name.
bool isPartText(const std::string& file);

/// Reads a part. `path` is a .json file, a folder with a part.json, an HDF5 file, or the text of a
/// part.json; `name` is what messages call the part. DeckError naming part, file and dof: a file
/// that is missing or malformed, unknown names, a matrix that is not square or of another size,
/// labels that stand twice, an interface dof the part does not have, an entry that is not finite.
/// ModelError: a mass that is not symmetric or indefinite. Not collective: see readPartEverywhere.
PartContent readPart(const std::string& path, const std::string& name);

/// The files that readPart(path) reads, `path` itself first of all: those a JSON file names, and
/// those a format of another code reads with one. FileError when a JSON file cannot be read.
std::set<std::string> filesOfPart(const std::string& path);

/// The same as readPart on every rank; all ranks end alike. Collective.
PartContent readPartEverywhere(const std::string& path, const std::string& name);

/// Throws ModelError naming part, file and dof when the mass is not symmetric (1e-10 of the
/// diagonal) or has a direction of negative mass.
void checkMass(const PartContent& content);

/// Warns of a stiffness that has entries on one side of its diagonal alone: one triangle of a
/// symmetric matrix, most probably.
void checkStiffness(const PartContent& content);

enum class FileKind { Hdf5, MatrixMarket, NastranDmig, ExtPtfm };

/// When loads that vary in time are written, for files that hold them as numbers [s].
struct LoadTimes {
  double begin = 0.0, end = 0.0, step = 0.0;
};

/// Writes a part on rank 0: one file `path`, or a folder `path` with part.json and Matrix Market
/// files in it. ModelError for what a file of another code cannot hold (parts/foreign/). What was
/// there is replaced when all is written. FileError when that fails. Point laws are no
/// part of the format: name them in `omitted`.
void writePart(const PartContent& content, const std::string& path, FileKind kind,
               const LoadTimes& times = {});

}  // namespace tooljoint::parts
