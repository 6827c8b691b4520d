// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/npz_file.hpp"

#include <cpl_vsi.h>
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "farlod/error.hpp"
#include "results/raster/zip_file.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// A value for each place of an array.
std::uint8_t value_at(std::size_t row, std::size_t n) { return (row * 31 + n * n) % 7 < 2 ? 1 : 0; }

NpzArray numbered(const std::string& name, std::size_t rows, std::size_t columns) {
  return {name,
          rows,
          columns,
          153,
          [](std::size_t, std::size_t) {},
          [](std::size_t row, std::span<std::uint8_t> values) {
            for (std::size_t n = 0; n < values.size(); ++n) values[n] = value_at(row, n);
          }};
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A member as another reader of ZIP files sees it.
std::string member_of(const std::filesystem::path& path, const std::string& member) {
  VSILFILE* const file = VSIFOpenL(("/vsizip/{" + path.string() + "}/" + member).c_str(), "rb");
  EXPECT_NE(file, nullptr) << member;
  if (file == nullptr) return {};
  std::string bytes(4 << 20, '\0');
  bytes.resize(VSIFReadL(bytes.data(), 1, bytes.size(), file));
  VSIFCloseL(file);
  return bytes;
}

class NpzFileTest : public testing::Test {
 protected:
  /// Of two arrays, of which one takes several pieces.
  std::filesystem::path written(const std::string& name, std::size_t threads) const {
    const std::filesystem::path path = folder.path() / name;
    NpzFile file(path, path, threads);
    file.add(numbered("shadowmat", 37, 400));
    file.add(numbered("vbshmat", 2, 3));
    file.close();
    return path;
  }
  scenes::TemporaryFolder folder;
};

TEST_F(NpzFileTest, HasTheArraysAfterTheirHeaders) {
  const std::filesystem::path path = written("a.npz", 2);
  const std::string small = member_of(path, "vbshmat.npy"), large = member_of(path, "shadowmat.npy");
  const std::size_t header = small.find('\n') + 1;
  EXPECT_EQ(header % 64, 0U);
  EXPECT_EQ(small.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(static_cast<std::size_t>(static_cast<unsigned char>(small[8])), header - 10);
  EXPECT_THAT(small, testing::HasSubstr("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 153), }"));
  ASSERT_EQ(small.size(), header + 2 * 3 * 153);
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t n = 0; n < 3 * 153; ++n)
      ASSERT_EQ(small[header + row * 3 * 153 + n], static_cast<char>(value_at(row, n))) << row << ' ' << n;
  EXPECT_THAT(large, testing::HasSubstr("'shape': (37, 400, 153)"));
  const std::size_t large_header = large.find('\n') + 1, row_bytes = 400 * 153;
  ASSERT_EQ(large.size(), large_header + 37 * row_bytes);
  for (std::size_t row = 0; row < 37; ++row)
    for (std::size_t n = 0; n < row_bytes; ++n)
      ASSERT_EQ(large[large_header + row * row_bytes + n], static_cast<char>(value_at(row, n)));
}

TEST_F(NpzFileTest, IsTheSameForAnyNumberOfThreads) {
  const std::string one = bytes_of(written("one.npz", 1));
  EXPECT_GT(one.size(), 1000U);
  EXPECT_EQ(one, bytes_of(written("three.npz", 3)));
  EXPECT_EQ(one, bytes_of(written("many.npz", 16)));
}

TEST_F(NpzFileTest, AndOtherZipFilesHaveMembersOfTheFirstDayThatTheyCanName) {
  const std::filesystem::path whole = folder.path() / "whole.tif", path = folder.path() / "a.zip";
  const std::string bytes = bytes_of(written("large.npz", 1)) + std::string(2 << 20, 'x');
  std::ofstream(whole, std::ios::binary) << bytes;
  ZipFile file(path, path);
  file.add(whole);
  file.add(whole);
  file.close();
  EXPECT_EQ(member_of(path, "whole.tif"), bytes);
  // Method, time and day of the first member, and of both in the directory
  const std::string stored_on_1_january_1980("\0\0\0\0\x21\0", 6), zip = bytes_of(path);
  EXPECT_EQ(zip.substr(8, 6), stored_on_1_january_1980);
  std::size_t entries = 0;
  for (std::size_t place = zip.find("PK\x01\x02", zip.size() - 400); place != std::string::npos; ++entries) {
    EXPECT_EQ(zip.substr(place + 10, 6), stored_on_1_january_1980);
    place = zip.find("PK\x01\x02", place + 1);
  }
  EXPECT_EQ(entries, 2U);
}

TEST_F(NpzFileTest, ADiskThatRefusesIsTold) {
  EXPECT_THROW(NpzFile(folder.path() / "nowhere" / "a.npz", "result.solweig", 1), OutputError);
}

}  // namespace
}  // namespace farlod
