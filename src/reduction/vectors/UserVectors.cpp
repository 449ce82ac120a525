// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and a user's own vectors from Matrix Market files. Any vectors x of a part do:
/// with x - Phi_C x_C in place of x the kept dofs stay what they are, and constraint modes and
/// vectors span the same space. The vectors become Ritz vectors of their span (W. Ritz 1909; E. L.
/// Wilson, M.-W. Yuan, J. M. Dickens, Dynamic analysis by direct superposition of Ritz vectors,
/// Earthquake Engng Struct. Dyn. 10 (1982) 813-821).
#include <Eigen/Dense>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/reading/FileName.hpp"
#include "io/MatrixMarket.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

struct UserOptions {
  std::string file;
  std::vector<std::string> parts;  ///< empty: all
  bool drop = false;               ///< dependent vectors, instead of refusing them
  double independence = 1e-8;
};

class UserVectors : public ReductionMethod {
 public:
  explicit UserVectors(UserOptions options)
      : options_(std::move(options)),
        modes_(MethodRegistry::instance().make("Craig-Bampton", {})) {}

  bool namesParts() const override { return true; }

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    if (!named(part.name)) return modes_->build(part, request);
    const Partition p = partition(part);
    const ConstraintModes constraint = constraintModes(part, p, constantStiffness(part.model));
    const Sparse K = block(symmetricPart(constantStiffness(part.model)), p.interior, p.interior),
                 M = block(part.model.mass, p.interior, p.interior);
    const std::string file = fileOf(part.name);
    // A part without interior dofs has nothing to give vectors for.
    const Matrix given = p.interior.empty() ? Matrix(p.size, 0) : read(file, part.name, p.size);
    const auto wanted = request.kind == ModeRequest::Kind::Count
                            ? std::min<Eigen::Index>(request.count, given.cols())
                            : given.cols();
    OrthonormalSet set(M, options_.independence,
                       "Part \"" + part.name + "\", vectors of " + file + ": ");
    const std::vector<int> dropped =
        collect(given.leftCols(wanted), p, constraint, file, part, set);
    double defect = 0;
    auto vectors = ritzVectors(K, M, set.basis(), 0, "user", defect);
    if (request.kind == ModeRequest::Kind::Below)
      vectors.erase(std::remove_if(vectors.begin(), vectors.end(),
                                   [&](const ModalVector& v) {
                                     return signedOmega(v.eigenvalue) > request.omegaMax;
                                   }),
                    vectors.end());
    for (auto& vector : vectors) vector.why = "from " + file;
    std::vector<int> all(p.interior.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    Basis basis = fixedInterfaceBasis(part, p, constraint, {all}, std::move(vectors));
    basis.orthogonality = defect;
    basis.method = "Ritz vectors of " + file;
    if (request.kind == ModeRequest::Kind::Count && request.count > given.cols() &&
        !p.interior.empty())
      basis.remarks.push_back("asked for " + std::to_string(request.count) + " modes, " + file +
                              " has " + std::to_string(given.cols()) + " vectors");
    if (request.kind == ModeRequest::Kind::All && !basis.complete)
      basis.remarks.push_back("all " + std::to_string(basis.modes()) + " vectors of " + file +
                              " are kept; the part has " + std::to_string(p.interior.size()) +
                              " modes");
    if (!dropped.empty())
      basis.remarks.push_back("dependent vectors of " + file + " are dropped: columns " +
                              listOf(dropped));
    return basis;
  }

  /// Changes nothing; sees all parts, and refuses names that are none of theirs.
  bool augment(const model::SecondOrderModel&, const std::vector<std::vector<int>>&,
               const std::vector<model::Substructure>& parts, std::vector<Basis>&) const override {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.name);
    checkNames(names);
    return false;
  }

  /// The names, and every file that will be needed: that it is there, can be read and has a row for
  /// every dof.
  void checkInput(const std::vector<PartOutline>& parts) const override {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.name);
    checkNames(names);
    for (const auto& part : parts)
      if (part.inner && named(part.name)) read(fileOf(part.name), part.name, part.dofs);
  }

 private:
  bool named(const std::string& part) const {
    return options_.parts.empty() ||
           std::find(options_.parts.begin(), options_.parts.end(), part) != options_.parts.end();
  }

  std::string fileOf(const std::string& part) const {
    std::string name;
    for (const char c : options_.file)
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
    for (const auto& name : options_.parts) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      const std::string guess = closest(name, names);
      throw DeckError("\"User Vectors\" are given for \"" + name +
                      "\", but no substructure has that name" +
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

  /// x_I - psi x_C of every column, as far as it is new; the columns that are not.
  std::vector<int> collect(const Matrix& given, const Partition& p,
                           const ConstraintModes& constraint, const std::string& file,
                           const model::Substructure& part, OrthonormalSet& set) const {
    Sparse psi(p.size, static_cast<Eigen::Index>(p.kept.size()));
    psi.setFromTriplets(constraint.entries.begin(), constraint.entries.end());
    std::vector<int> dependent;
    for (Eigen::Index j = 0; j < given.cols(); ++j) {
      Vector held(static_cast<Eigen::Index>(p.kept.size())),
          inner(static_cast<Eigen::Index>(p.interior.size())), before(inner.size());
      for (std::size_t i = 0; i < p.kept.size(); ++i)
        held[static_cast<Eigen::Index>(i)] = given(p.kept[i], j);
      const Vector rest = given.col(j) - psi * held;
      for (std::size_t i = 0; i < p.interior.size(); ++i) {
        inner[static_cast<Eigen::Index>(i)] = rest[p.interior[i]];
        before[static_cast<Eigen::Index>(i)] = given(p.interior[i], j);
      }
      // A vector that is constraint modes alone leaves rounding.
      const bool constrained = set.norm(inner) <= options_.independence * set.norm(before);
      if (!constrained && set.add(inner)) continue;
      if (!options_.drop)
        throw DeckError(
            file + ": column " + std::to_string(j + 1) +
            " is a combination of the columns before it and of the constraint modes of part \"" +
            part.name + "\". Leave it out, or set \"Dependent Vectors\" to \"Drop\".");
      dependent.push_back(static_cast<int>(j));
    }
    return dependent;
  }

  UserOptions options_;
  std::unique_ptr<ReductionMethod> modes_;
};

deck::ListSpec ownParameters() {
  deck::ListSpec list("User Vectors",
                      "Where vectors come from. The number of modes asked for takes the first "
                      "columns of each file.");
  list.text("File", deck::Required{},
            "Matrix Market file of a dense or sparse real matrix, one row for each dof of the part "
            "and one column for each vector, relative to the deck; \"%\" stands "
            "for the name of the part.");
  list.textArray("Substructures", deck::Optional{}, {},
                 "Names of the substructures that have a file; the others take fixed-interface "
                 "modes. All of them when absent.");
  list.choice("Dependent Vectors", std::string("Refuse"), {"Refuse", "Drop"},
              "What happens to a vector that is a combination of those before it and of constraint "
              "modes: an error, or it is left out with a remark.");
  list.real("Independence", "", 1e-8, deck::Range{0.0, 0.1, true, false},
            "The part of a vector, measured by mass, that must be new, or it is dependent.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "User Vectors",
    {"Constraint modes and the Ritz vectors of a user's own vectors from files (Wilson, Yuan and "
     "Dickens 1982).",
     ownParameters(), [](const Teuchos::ParameterList& given) {
       Teuchos::ParameterList list(given);  // an absent list has no defaults
       UserOptions options;
       if (!list.isParameter("File"))
         throw DeckError(
             "Reduction takes the basis \"User Vectors\", but has no list \"User Vectors\" with "
             "the \"File\" they are in. Add it.");
       options.file = deck::fileName(list, "File");
       if (list.isParameter("Substructures"))
         options.parts = list.get<Teuchos::Array<std::string>>("Substructures").toVector();
       options.drop = list.get("Dependent Vectors", std::string("Refuse")) == "Drop";
       options.independence = list.get("Independence", options.independence);
       return std::unique_ptr<ReductionMethod>(new UserVectors(options));
     }});

}  // namespace

}  // namespace tooljoint::reduction
