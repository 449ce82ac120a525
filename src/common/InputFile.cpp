// SPDX-License-Identifier: BSD-3-Clause
#include "common/InputFile.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint {
namespace {

std::string kindOf(mode_t mode) {
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

/// Opens a regular file without blocking; returns the descriptor, or -1 with the reason.
int openRegular(const std::string& path, std::uint64_t& size, std::string& reason) {
  // Without O_NONBLOCK the open of a FIFO waits for a writer; regular files ignore the flag.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    // A socket cannot be opened, so its kind is determined by name.
    const int error = errno;
    const bool special =
        ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
    reason =
        special ? "it is no regular file, but " + kindOf(status.st_mode) : std::strerror(error);
  } else if (S_ISDIR(status.st_mode)) {
    reason = "it is a folder";
  } else if (!S_ISREG(status.st_mode)) {
    reason = "it is no regular file, but " + kindOf(status.st_mode);
  } else {
    size = static_cast<std::uint64_t>(status.st_size);
    return descriptor;
  }
  if (descriptor >= 0) ::close(descriptor);
  return -1;
}

}  // namespace

std::string whyUnreadable(const std::string& path) {
  std::string reason;
  std::uint64_t size = 0;
  const int descriptor = openRegular(path, size, reason);
  if (descriptor >= 0) ::close(descriptor);
  return reason;
}

InputFile::InputFile(const std::string& path) : path_(path) {
  std::string reason;
  descriptor_ = openRegular(path, size_, reason);
  if (descriptor_ < 0) throw FileError(path + " cannot be read: " + reason + ".");
}

InputFile::~InputFile() { ::close(descriptor_); }

bool InputFile::fill() {
  ssize_t count = 0;
  do count = ::read(descriptor_, buffer_.data(), buffer_.size());
  while (count < 0 && errno == EINTR);
  if (count < 0) throw FileError(path_ + " cannot be read further: " + std::strerror(errno) + ".");
  at_ = 0;
  end_ = static_cast<std::size_t>(count);
  return count > 0;
}

std::string InputFile::all(std::uint64_t most) {
  const auto refuse = [&] {
    throw FileError(path_ + " is larger than " + formatNumber(static_cast<double>(most)) +
                    " bytes, the limit for a file of this kind.");
  };
  if (size_ > most) refuse();
  std::string text;
  text.reserve(size_);
  do {
    text.append(buffer_.data() + at_, end_ - at_);
    if (text.size() > most) refuse();  // the file has grown
  } while (fill());
  return text;
}

bool InputFile::line(std::string& text, std::size_t longest) {
  text.clear();
  while (true) {
    if (at_ == end_ && !fill()) return !text.empty();
    const char* begin = buffer_.data() + at_;
    const auto* feed = static_cast<const char*>(std::memchr(begin, '\n', end_ - at_));
    const std::size_t count = feed != nullptr ? static_cast<std::size_t>(feed - begin) : end_ - at_;
    if (text.size() + count > longest)
      throw FileError(path_ + " has a line of more than " + std::to_string(longest) +
                      " characters, the limit for a file of this kind.");
    text.append(begin, count);
    at_ += count + (feed != nullptr ? 1 : 0);
    if (feed != nullptr) return true;
  }
}

std::string readInput(const std::string& path, std::uint64_t most) {
  return InputFile(path).all(most);
}

}  // namespace tooljoint
