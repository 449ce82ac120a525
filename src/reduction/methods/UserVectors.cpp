// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and a user's own vectors from Matrix Market files. Any vectors x of a part are
/// allowed: x is replaced by x - Phi_C x_C, which does not move the boundary dofs and leaves the
/// span of constraint modes and vectors unchanged. The vectors become Ritz vectors of their span
/// (W. Ritz 1909; E. L. Wilson, M.-W. Yuan, J. M. Dickens, Dynamic analysis by direct superposition
/// of Ritz vectors, Earthquake Engng Struct. Dyn. 10 (1982) 813-821).
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/reading/FileName.hpp"
#include "io/MatrixMarket.hpp"
#include "reduction/methods/BasisBuilder.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

class UserVectors : public ReductionMethod {
 public:
  explicit UserVectors(const Teuchos::ParameterList& list)
      : drop_(list.get<std::string>("Dependent Vectors") == "Drop"),
        independence_(list.get<double>("Independence")) {
    if (!list.isParameter("File"))
      throw DeckError(
          "Reduction uses the basis \"User Vectors\", but has no list \"User Vectors\". Add the "
          "list with its \"File\".");
    file_ = deck::fileName(list, "File");
    if (list.isParameter("Substructures"))
      parts_ = list.get<Teuchos::Array<std::string>>("Substructures").toVector();
  }

  bool namesParts() const override { return true; }

  Basis build(const PartView& part, const ModeRequest& request) const override {
    return fixedInterfaceBasis(part, named(part.part().name) ? vectorsOf(part, request)
                                                             : fixedInterfaceModes(part, request));
  }

  /// Changes nothing; rejects names that belong to none of the parts.
  bool augment(const model::SecondOrderModel&, const std::vector<std::vector<int>>&,
               const std::vector<PartView>& parts, std::vector<Basis>&) const override {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.part().name);
    checkNames(names);
    return false;
  }

  /// Checks the names, and for every required file that it exists, can be read and has a row for
  /// every dof.
  void checkInput(const std::vector<PartOutline>& parts) const override {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.name);
    checkNames(names);
    for (const auto& part : parts)
      if (part.inner && named(part.name)) read(fileOf(part.name), part.name, part.dofs);
  }

 private:
  bool named(const std::string& part) const { return parts_.empty() || contains(parts_, part); }

  InteriorVectors vectorsOf(const PartView& part, const ModeRequest& request) const {
    const auto& interior = part.partition().interior;
    const std::string& name = part.part().name;
    const std::string file = fileOf(name);
    // A part without interior dofs needs no vectors.
    const int dofs = part.model().size();
    const Matrix given = interior.empty() ? Matrix(dofs, 0) : read(file, name, dofs);
    const bool counted = request.kind == ModeRequest::Kind::Count;
    const auto wanted =
        counted ? std::min<Eigen::Index>(request.count, given.cols()) : given.cols();
    OrthonormalSet set(part.interiorMass(), independence_, part.who("vectors of " + file));
    const std::vector<int> dropped = collect(given.leftCols(wanted), part, file, set);

    InteriorVectors result;
    result.groups = {interior};
    addRitzVectors(part.symmetricInteriorStiffness(), part.interiorMass(), set.basis(), 0, "user",
                   result);
    if (request.kind == ModeRequest::Kind::Below)
      while (!result.vectors.empty() &&
             signedOmega(result.vectors.back().eigenvalue) > request.omegaMax)
        result.vectors.pop_back();
    for (auto& vector : result.vectors) vector.why = "from " + file;
    result.keepAll();
    result.complete = result.kept == sizeOf(interior);
    result.method = "Ritz vectors of " + file;
    if (counted && request.count > given.cols() && !interior.empty())
      result.remarks.push_back("requested " + std::to_string(request.count) + " modes, " + file +
                               " has " + std::to_string(given.cols()) + " vectors");
    if (request.kind == ModeRequest::Kind::All && !result.complete)
      result.remarks.push_back("all " + std::to_string(result.kept) + " vectors of " + file +
                               " are used; the part has " + std::to_string(sizeOf(interior)) +
                               " modes");
    if (!dropped.empty())
      result.remarks.push_back("dependent vectors of " + file + " are dropped: columns " +
                               listOf(dropped));
    return result;
  }

  std::string fileOf(const std::string& part) const {
    std::string name;
    for (const char c : file_)
      if (c == '%')
        name += part;
      else
        name += c;
    return name;
  }

  static std::string listOf(const std::vector<int>& columns) {
    std::vector<std::string> text;
    for (int j : columns) text.push_back(std::to_string(j + 1));
    return join(text, ", ");
  }

  void checkNames(const std::vector<std::string>& names) const {
    for (const auto& name : parts_) {
      if (contains(names, name)) continue;
      const std::string guess = closest(name, names);
      throw DeckError("\"User Vectors\" names \"" + name + "\", but no substructure has this name" +
                      (guess.empty() ? "; there are " + quotedList(names) + "."
                                     : "; did you mean \"" + guess + "\"?"));
    }
  }

  static Matrix read(const std::string& file, const std::string& part, int dofs) {
    Matrix vectors;
    try {
      vectors = io::readMatrixMarketDense(file);
    } catch (const DeckError& error) {
      throw DeckError("Vectors of part \"" + part + "\": " + error.what());
    }
    if (vectors.rows() != dofs)
      throw DeckError(file + ": its vectors have " + std::to_string(vectors.rows()) +
                      " rows, but part \"" + part + "\" has " + std::to_string(dofs) +
                      " dofs, interface and retained ones included. Give one row for each dof, in "
                      "the order of the part.");
    return vectors;
  }

  /// Adds the new part of x_I - psi x_C of every column; returns the columns without a new part.
  std::vector<int> collect(const Matrix& given, const PartView& part, const std::string& file,
                           OrthonormalSet& set) const {
    const Partition& p = part.partition();
    const Sparse& psi = part.constraintModes().vectors;
    std::vector<int> dropped;
    for (int j = 0; j < given.cols(); ++j) {
      const Vector vector = given.col(j), rest = vector - psi * Vector(vector(p.boundary));
      // A vector that consists of constraint modes leaves only rounding.
      const Vector inner = rest(p.interior), before = vector(p.interior);
      const bool constrained = set.norm(inner) <= independence_ * set.norm(before);
      if (!constrained && set.add(inner)) continue;
      if (!drop_)
        throw DeckError(file + ": column " + std::to_string(j + 1) +
                        " is a linear combination of the preceding columns and the constraint "
                        "modes of part \"" +
                        part.part().name +
                        "\". Remove it, or set \"Dependent Vectors\" to \"Drop\".");
      dropped.push_back(j);
    }
    return dropped;
  }

  bool drop_;  ///< remove dependent vectors instead of rejecting them
  double independence_;
  std::string file_;
  std::vector<std::string> parts_;  ///< empty: all
};

deck::ListSpec userVectorsParameters() {
  deck::ListSpec list(
      "User Vectors",
      "Source of the vectors. The mode selection uses the first columns of each file.");
  list.text("File", deck::Required{},
            "Matrix Market file of a dense or sparse real matrix, one row for each dof of the part "
            "and one column for each vector, relative to the deck; \"%\" stands "
            "for the name of the part.");
  list.textArray("Substructures", deck::Optional{}, {},
                 "Names of the substructures that have a file; the others take fixed-interface "
                 "modes. All of them when absent.");
  list.choice("Dependent Vectors", std::string("Refuse"), {"Refuse", "Drop"},
              "Treatment of a vector that depends linearly on the preceding ones and the "
              "constraint modes: an error, or the vector is dropped with a remark.");
  list.real("Independence", "", 1e-8, deck::Range{0.0, 0.1, true, false},
            "Fraction of a vector (mass norm) that must be independent of the preceding ones.")
      .expert();
  return list;
}

const bool userVectorsRegistered = addMethod<UserVectors>(
    "User Vectors",
    "Constraint modes and the Ritz vectors of the user's vectors from files (Wilson, Yuan and "
    "Dickens 1982).",
    userVectorsParameters());

}  // namespace

}  // namespace tooljoint::reduction
