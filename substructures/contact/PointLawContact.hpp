// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any registered point law as contact with the wall of the hole. Its coordinates are
///
///     y_0 = j0 - r                                      separation from the wall
///     y_1, with y_1' = t.(u', v') + (Omega + theta_z') R_c   sliding around; has no displacement
///     y_2 = w + U t                                     sliding along, U the speed of the block
///
/// A law takes the first one, two or three of them. Its forces f act as J'f at the node,
/// J = dy'/d(u', v', w', theta_z').
#pragma once

#include <memory>
#include <string>

#include "substructures/contact/ContactLaw.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::contact {

/// The registered law `name` with its own parameters. Throws DeckError for a name that is not
/// registered.
std::shared_ptr<const ContactLaw> pointLawContact(const std::string& name,
                                                  const Teuchos::ParameterList& own);

}  // namespace tooljoint::contact
