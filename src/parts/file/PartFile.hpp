// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Part files: matrices, loads, labels and interfaces of a part in files that any program can
/// write, and reduced parts in the same format. docs/file-formats.md describes the format: either a
/// JSON file that names Matrix Market files, or one HDF5 file.
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

/// A part in the form of a file. Coordinates without a node (modes of an already reduced part) have
/// Modal labels.
struct PartContent {
  std::string file;
  model::Substructure part;  ///< interface: the dofs of all sets; laws have names, and NaN as value
                             ///< except for "1"
  std::vector<InterfaceSet> interfaces;
  std::map<std::int64_t, Vector3>
      positions;      ///< of nodes, in the frame of the part [m]; empty if the file has none
  StoredBasis basis;  ///< empty unless the file contains one
  std::vector<std::string>
      omitted;          ///< point laws of the original part, which a part file cannot contain
  bool turned = false;  ///< the axes of the part differ from those of the scene
};

/// Nodes of a part: those of its dofs, and of the rows of its basis.
std::set<std::int64_t> nodesOf(const PartContent& content);

/// True if the parameter File of a deck is the text of a part.json, not its name.
bool isPartText(const std::string& file);

/// Reads a part. `path` is a .json file, a folder with a part.json, an HDF5 file, or the text of a
/// part.json; `name` is the name of the part in messages. DeckError with part, file and dof: a
/// missing or malformed file, unknown names, a matrix that is not square or has another size,
/// repeated labels, an interface dof that the part does not have, an entry that is not finite.
/// ModelError: a mass that is not symmetric or indefinite. Not collective: see readPartEverywhere.
PartContent readPart(const std::string& path, const std::string& name);

/// The files that readPart(path) reads, `path` first: those named in a JSON file, and those that a
/// format of another code reads with one. FileError if a JSON file cannot be read.
std::set<std::string> filesOfPart(const std::string& path);

/// The same as readPart on every rank; an error is thrown on all ranks. Collective.
PartContent readPartEverywhere(const std::string& path, const std::string& name);

/// Throws ModelError with part, file and dof if the mass is not symmetric (1e-10 of the diagonal)
/// or has a direction of negative mass.
void checkMass(const PartContent& content);

/// Warns of a stiffness with entries on only one side of its diagonal: probably one triangle of a
/// symmetric matrix.
void checkStiffness(const PartContent& content);

enum class FileKind { Hdf5, MatrixMarket, NastranDmig, ExtPtfm };

/// Times at which time-dependent loads are written, for files that contain them as numbers [s].
struct LoadTimes {
  double begin = 0.0, end = 0.0, step = 0.0;
};

/// Writes a part on rank 0: one file `path`, or a folder `path` with part.json and Matrix Market
/// files. ModelError for content that the format of another code cannot represent (parts/foreign/).
/// An existing file is replaced after everything is written. FileError when that fails. The format
/// has no point laws: list them in `omitted`.
void writePart(const PartContent& content, const std::string& path, FileKind kind,
               const LoadTimes& times = {});

}  // namespace tooljoint::parts
