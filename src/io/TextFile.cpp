// SPDX-License-Identifier: BSD-3-Clause
#include "io/TextFile.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "common/Error.hpp"
#include "common/InputFile.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::io {
namespace {

[[noreturn]] void fail(const std::string& path, int number) {
  throw FileError("The file " + path + " cannot be written: " + std::strerror(number) +
                  ". Make room or name another folder.");
}

}  // namespace

void stageText(const std::string& path, const std::string& text) {
  if (parallel::rank() != 0) return;
  const std::string part = path + ".part";
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail(part, errno);
  std::size_t done = 0;
  int error = 0;
  while (done < text.size() && error == 0) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  // a full disk may be reported only now
  if (::fsync(file) != 0 && error == 0 && errno != EINVAL && errno != EROFS) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return;
  ::unlink(part.c_str());
  fail(path, error);
}

void publishStaged(const std::string& path) {
  if (parallel::rank() != 0) return;
  const std::string part = path + ".part";
  if (std::rename(part.c_str(), path.c_str()) != 0) {
    throw FileError("The file " + part + " cannot be renamed to " + path + ": " +
                    std::strerror(errno) + ".");
  }
}

void writeText(const std::string& path, const std::string& text) {
  stageText(path, text);
  publishStaged(path);
}

std::string readText(const std::string& path) { return readInput(path, largestText); }

}  // namespace tooljoint::io
