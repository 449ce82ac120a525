// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SHA-256 (FIPS 180-4, computed by OpenSSL), for the provenance of results.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // EVP_MD_CTX of OpenSSL

namespace tooljoint {

/// The digest of `data` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view data);

/// For data that arrive in pieces.
class Sha256 {
 public:
  Sha256();
  void add(const void* data, std::size_t bytes);
  /// Digest of all added data; nothing can be added afterwards.
  std::string digest();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

}  // namespace tooljoint
