// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Matrices of finite-element codes as parts. Every format is a separate file that registers
/// itself. Rows and columns are identified by their labels (point, component), never by position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"
#include "parts/file/PartSource.hpp"

namespace tooljoint::parts {

/// Meaning of a square matrix of a part.
enum class Quantity { Stiffness, Mass, Damping };

/// A dof with the labels of finite-element codes.
struct PointDof {
  std::int64_t point = 0;  ///< grid point or scalar point, from 1
  int component = 0;       ///< 1 to 6 of a grid point, 0 of a scalar point
  bool operator<(const PointDof& o) const {
    return std::tie(point, component) < std::tie(o.point, o.component);
  }
  bool operator==(const PointDof& o) const { return point == o.point && component == o.component; }
};

/// "component 2 of point 7", "scalar point 7".
std::string describe(const PointDof& dof);

struct LabelledEntry {
  PointDof row, column;
  double value = 0.0;
};

/// A square matrix with both triangles.
struct LabelledMatrix {
  Quantity quantity = Quantity::Stiffness;
  std::string name;   ///< name of the term in the part
  std::string where;  ///< file, and line or name in the file, for messages
  std::vector<LabelledEntry> entries;
};

struct LabelledLoad {
  std::string name;
  std::string law = "1";
  std::string where;
  std::map<PointDof, double> forces;
};

/// Content of the files of another code.
struct LabelledPart {
  std::string file;  ///< for messages
  std::vector<LabelledMatrix> matrices;
  std::vector<LabelledLoad> loads;
  std::set<PointDof> held;                    ///< dofs held in the other code: omitted from the
                                              ///< part
  std::map<std::int64_t, Vector3> positions;  ///< of points, if the files give them [m]
};

/// The files of a part: a single one, or each by its content.
struct PartFiles {
  std::string whole;  ///< "" if the files are named separately
  std::map<std::string, std::string>
      named;  ///< "stiffness", "mass", "damping", "loads", "mapping": file
  std::string main() const;
};

/// One format. Readers throw DeckError with file, line, field, text found and text expected.
class PartFormat {
 public:
  virtual ~PartFormat() = default;
  /// Lower case, with the dot.
  virtual std::vector<std::string> extensions() const = 0;
  /// Recognises a file with another extension by its first bytes.
  virtual bool recognises(const std::string& opening) const = 0;
  virtual LabelledPart read(const PartFiles& files) const = 0;
  /// Files in the same folder that are read with this one unless a part.json names others; the part
  /// depends on their content too. None by default.
  virtual std::vector<std::string> companions(const std::string& path) const;
};

/// Formats by name.
using PartFormats = deck::Registry<PartFormat>;

/// The format for the extension of this file; nullptr if there is none.
std::unique_ptr<PartFormat> partFormatByExtension(const std::string& path);
/// The format of a file by its extension, otherwise by its first bytes; nullptr if there is none.
std::unique_ptr<PartFormat> partFormatOf(const std::string& path);

/// Files of a format as a source of part values: components, dofs, mass, stiffness, damping, loads
/// and positions. Components are u, v, w, theta_x, theta_y, theta_z (1 to 6) up to the largest
/// existing one, and s (of scalar points), if any. DeckError for a part without mass or stiffness,
/// a load on a dof with neither, and a point that is both a grid point and a scalar point.
std::unique_ptr<PartSource> openForeignPart(const PartFormat& format, const PartFiles& files);

/// The values of a part.json whose entry "matrices" names files of another code, combined with the
/// values of these files, which the JSON file must not give as well. `json` itself without that
/// entry.
std::unique_ptr<PartSource> withForeignMatrices(std::unique_ptr<PartSource> json);

/// Longest line [bytes] that readers accept in a text file.
constexpr std::size_t longestLine = 1024;
/// Names of the components 1 to 6 of a grid point.
const std::vector<std::string>& gridComponents();
/// Name of the one component of a scalar point.
constexpr const char* scalarComponent = "s";

/// A whole number without sign and blanks; -1 for any other text or one above 2^31 - 1.
std::int64_t wholeNumber(const std::string& text);
/// A finite number in Fortran notation: exponents E, D, or only a sign (1.5+3). With `point` a text
/// without a decimal point is rejected. False if the text is not a number.
bool fortranNumber(const std::string& text, bool point, double& value);

}  // namespace tooljoint::parts
