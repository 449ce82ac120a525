// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/ContactLaw.hpp"

#include <Teuchos_ParameterList.hpp>
#include <string>

namespace tooljoint::contact {

std::shared_ptr<const ContactLaw> makeLaw(const std::string& name) {
  return LawRegistry::instance().make(name, Teuchos::ParameterList());
}

}  // namespace tooljoint::contact
