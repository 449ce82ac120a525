// SPDX-License-Identifier: BSD-3-Clause
#include "common/Sha256.hpp"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include "common/Error.hpp"

namespace tooljoint {

std::string sha256(std::string_view data) {
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(data.data(), data.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw Error(ExitCode::Internal, "OpenSSL cannot compute a SHA-256 digest on this machine.");
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace tooljoint
