// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All files are opened for reading here. Only regular files are read: opening a FIFO would wait
/// for a writer, and a device may have no end. Every rank reads for itself.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tooljoint {

/// Reason why a file cannot be read ("No such file or directory", "it is a folder", "it is no
/// regular file, but a FIFO"); "" if it can. Does not read from it.
std::string whyUnreadable(const std::string& path);

/// A regular file open for reading. Closes itself.
class InputFile {
 public:
  /// Throws FileError, "PATH cannot be read: REASON.", for the reasons of whyUnreadable().
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Size of the file when it was opened [bytes].
  std::uint64_t size() const { return size_; }

  /// The rest of the file. FileError if it is longer than `most` bytes (nothing is read then), or
  /// if reading fails.
  std::string all(std::uint64_t most);

  /// The next line without its line feed; false at the end. FileError for a line of more than
  /// `longest` bytes, or when reading fails.
  bool line(std::string& text, std::size_t longest);

 private:
  /// Fills the buffer; false at the end of the file.
  bool fill();

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::array<char, 65536> buffer_{};
  std::size_t at_ = 0, end_ = 0;
};

/// The text of a whole file of at most `most` bytes. Errors: those of InputFile.
std::string readInput(const std::string& path, std::uint64_t most);

}  // namespace tooljoint
