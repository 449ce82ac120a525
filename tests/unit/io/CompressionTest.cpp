// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Compressed time series: the same numbers in less space, the file of a killed process, and
/// damaged files.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "io/ResultsFile.hpp"
#include "io/ResultsReader.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace CompressionTest {

using namespace tooljoint;
namespace fs = std::filesystem;

constexpr std::size_t width = 60;

/// A row with a wave in its first half, and zeros, as of nodes without contact, in its second.
std::vector<double> row(std::size_t i) {
  std::vector<double> values(width, 0.0);
  for (std::size_t k = 0; k < width / 2; ++k)
    values[k] = 1e-3 * std::sin(0.01 * static_cast<double>(i) + 0.3 * static_cast<double>(k));
  return values;
}

std::vector<double> rows(std::size_t count) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto one = row(i);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

class Compression : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return scratch_ / name; }
  /// A file of two series with `count` rows, flushed every `interval` rows.
  void write(const std::string& name, int level, std::size_t count, std::size_t interval) {
    io::ResultsFile file(at(name), {}, io::ResultsOptions{level});
    auto& a = file.series("/a", {width / 6, 6}, "m", "A");
    auto& b = file.series("/b", {}, "s", "B");
    for (std::size_t i = 0; i < count; ++i) {
      a.append(row(i).data());
      b.append(static_cast<double>(i));
      if ((i + 1) % interval == 0) file.flush();
    }
    file.finish();
  }

  const test::Scratch scratch_;
};

TEST_F(Compression, EveryLevelKeepsTheNumbersAndALevelMakesTheFileSmaller) {
  constexpr std::size_t count = 2500;  // the last chunk of a series is not full
  const auto whole = rows(count);
  for (const int level : {0, 1, 9}) {
    const auto name = "level_" + std::to_string(level);
    write(name, level, count, 700);
    const io::ResultsReader reader(at(name));
    EXPECT_EQ(reader.shape("/a"), (std::vector<std::size_t>{count, width / 6, 6}));
    EXPECT_EQ(reader.numbers("/a"), whole) << level;
    EXPECT_EQ(reader.numbers("/b").back(), static_cast<double>(count - 1)) << level;
  }
  // half of the numbers are zeros; sign and exponent of the others change slowly
  EXPECT_LT(static_cast<double>(fs::file_size(at("level_1"))),
            0.5 * static_cast<double>(fs::file_size(at("level_0"))));
  EXPECT_LT(fs::file_size(at("level_9")), fs::file_size(at("level_1")));
}

/// Chunks that are incomplete at a flush are replaced by full ones of another size, which HDF5
/// stores elsewhere. A process killed between two flushes must still leave a valid file.
TEST_F(Compression, BetweenFlushesTheFileOnTheDiskHoldsWhatWasFlushed) {
  constexpr std::size_t interval = 350, flushes = 8;
  io::ResultsFile file(at("results.h5"), {}, io::ResultsOptions{1});
  auto& a = file.series("/a", {width}, "m", "A");
  auto& b = file.series("/b", {width}, "m", "B");
  const auto whole = rows(interval * (flushes + 1));
  for (std::size_t i = 0, flushed = 0; i < interval * (flushes + 1); ++i) {
    a.append(row(i).data());
    b.append(row(i).data());
    if ((i + 1) % interval == 0) {
      file.flush();
      flushed = i + 1;
    }
    if (flushed == 0 || (i + 1) % 50 != 0) continue;
    fs::copy_file(at("results.h5.part"), at("left.h5"), fs::copy_options::overwrite_existing);
    const io::ResultsReader left(at("left.h5"));
    const std::vector<double> wanted(whole.begin(),
                                     whole.begin() + static_cast<std::ptrdiff_t>(flushed * width));
    ASSERT_EQ(left.rows("/a", 0, flushed), wanted) << i;
    ASSERT_EQ(left.rows("/b", 0, flushed), wanted) << i;
  }
}

TEST_F(Compression, ChangedBytesOfASeriesAreFound) {
  write("whole.h5", 1, 2000, 5000);
  const auto size = fs::file_size(at("whole.h5"));
  int found = 0;
  for (int part = 1; part < 10; ++part) {
    fs::copy_file(at("whole.h5"), at("damaged.h5"), fs::copy_options::overwrite_existing);
    {
      std::fstream file(at("damaged.h5"), std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(static_cast<std::streamoff>(size * static_cast<std::size_t>(part) / 10));
      file.write("damaged!", 8);
    }
    try {
      const io::ResultsReader reader(at("damaged.h5"));
      EXPECT_EQ(reader.numbers("/a"), rows(2000)) << "wrong numbers instead of an error";
    } catch (const FileError&) {
      ++found;
    }
  }
  EXPECT_GE(found, 7);  // almost all of the file are chunks of /a, and zlib sums up their bytes
}

}  // namespace CompressionTest
