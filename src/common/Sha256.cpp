// SPDX-License-Identifier: BSD-3-Clause
#include "common/Sha256.hpp"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include "common/Error.hpp"

namespace tooljoint {
namespace {

void require(bool good) {
  if (!good)
    throw Error(ExitCode::Internal, "OpenSSL cannot compute a SHA-256 digest on this machine.");
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  require(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

void Sha256::add(const void* data, std::size_t bytes) {
  require(EVP_DigestUpdate(context_.get(), data, bytes) == 1);
}

std::string Sha256::digest() {
  std::array<unsigned char, 32> digest{};
  require(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

std::string sha256(std::string_view data) {
  Sha256 all;
  all.add(data.data(), data.size());
  return all.digest();
}

}  // namespace tooljoint
