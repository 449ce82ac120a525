// SPDX-License-Identifier: BSD-3-Clause
#include "common/InputFile.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/Error.hpp"

namespace tooljoint {
namespace InputFileTest {

namespace fs = std::filesystem;

class InputFiles : public ::testing::Test {
 protected:
  InputFiles() : folder_("input_files_" + std::to_string(getpid())) {
    fs::create_directory(folder_);
  }
  ~InputFiles() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  static std::string refusal(const std::string& path) {
    try {
      readInput(path, 1000);
    } catch (const FileError& error) {
      return error.what();
    }
    return "was read";
  }

  std::string folder_;
};

TEST_F(InputFiles, AreReadWhole) {
  const std::string text("a\0b\r\nc", 6);
  EXPECT_EQ(readInput(write("text", text), 6), text);
  EXPECT_EQ(readInput(write("empty", ""), 0), "");
  const std::string longer(200000, 'x');  // more than a buffer
  EXPECT_EQ(readInput(write("longer", longer), 200000), longer);
}

TEST_F(InputFiles, AreReadLineByLine) {
  const std::string second(100000, 'y');
  InputFile file(write("lines", "first\n" + second + "\n\nlast"));
  std::string line;
  EXPECT_TRUE(file.line(line, 200000));
  EXPECT_EQ(line, "first");
  EXPECT_TRUE(file.line(line, 200000));
  EXPECT_EQ(line, second);
  EXPECT_TRUE(file.line(line, 200000));
  EXPECT_EQ(line, "");
  EXPECT_TRUE(file.line(line, 200000));
  EXPECT_EQ(line, "last");
  EXPECT_FALSE(file.line(line, 200000));
}

TEST_F(InputFiles, ALineWithoutEndIsRefusedWhileItIsRead) {
  const std::string path = write("zeros", "");
  fs::resize_file(path, 1ULL << 40U);  // a terabyte of zeros that takes no room
  InputFile file(path);
  std::string line;
  EXPECT_THROW(file.line(line, 1024), FileError);
  EXPECT_LE(line.size(), 1024U);
  EXPECT_EQ(refusal(path), path + " is larger than 1000 bytes, the limit for a file of this kind.");
}

// Without the check the program would wait forever for a FIFO, and read /dev/zero until the memory
// is full.
TEST_F(InputFiles, OnlyRegularFilesAreOpened) {
  const std::string pipe = folder_ + "/pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), pipe + " cannot be read: it is no regular file, but a FIFO.");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero cannot be read: it is no regular file, but a device.");
  EXPECT_EQ(refusal("/dev/tty"), "/dev/tty cannot be read: it is no regular file, but a device.");
  EXPECT_EQ(refusal(folder_), folder_ + " cannot be read: it is a folder.");
  EXPECT_EQ(refusal(folder_ + "/none"),
            folder_ + "/none cannot be read: No such file or directory.");
  EXPECT_EQ(whyUnreadable(write("good", "x")), "");
}

}  // namespace InputFileTest
}  // namespace tooljoint
