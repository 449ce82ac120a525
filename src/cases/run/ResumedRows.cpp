// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/ResumedRows.hpp"

#include <fmt/format.h>

#include "cases/CaseLists.hpp"
#include "cases/ListText.hpp"
#include "common/Sha256.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::cases {

std::string identity(const Case& owner) {
  Teuchos::ParameterList list(owner.deck().list());
  for (const char* name : {"Output", "Torque and Drag", "Buckling", "Bottom-Hole Assembly"})
    list.remove(name, false);
  for (const auto& analysis : AnalysisLists::instance().lists()) list.remove(analysis.name, false);
  auto text = programStamp() + "\n" + canonicalText(list) + owner.files();
  parallel::broadcast(text);  // only rank 0 reads the files
  return text;
}

std::string fileKey(const RowKeys& keys, const std::string& row) {
  return sha256(keys.whose + "\n" + row);
}

namespace {

/// "3 of 12 depths", "3 states"
std::string counted(const RowKeys& keys, int known) {
  return keys.rows.empty() ? fmt::format("{} {}", known, keys.plural)
                           : fmt::format("{} of {} {}", known, keys.rows.size(), keys.plural);
}

}  // namespace

void announceKnown(const RowKeys& keys, int known, int files) {
  if (known > 0)
    log::info(counted(keys, known) + " are known from before (--fresh forgets them)");
  else if (files > 0)
    log::info(fmt::format(
        "The folder holds {0} of another deck, other settings or another program. They are "
        "not used: all {0} are computed.",
        keys.plural));
}

std::string interruptedSentence(const RowKeys& keys, int known, const std::string& folder) {
  return fmt::format(
      "Interrupted with {} done. They are kept in {}; the same command goes on from there.",
      counted(keys, known), folder);
}

}  // namespace tooljoint::cases
