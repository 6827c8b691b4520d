// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/matrix_npz.hpp"

#include <cpl_vsi.h>
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// Two surfaces of one cell's ground: the first sees half of the second, the second a little of the first.
ViewFactorMatrix two_surfaces() {
  ViewFactorMatrix matrix;
  matrix.surfaces = 2;
  matrix.ground = {{{-1, 3}, {500'010.5, 5'400'020.0}}};
  matrix.area_m2 = {10.0, 40.0};
  matrix.row_end = {2, 5};
  matrix.columns = {1, 4, 0, 2, 4};
  matrix.values = {0.5F, 0.5F, 0.125F, 0.375F, 0.5F};
  return matrix;
}

std::vector<SurfaceMean> their_means() {
  std::vector<SurfaceMean> means(2);
  means[0].building = "a";
  means[0].surface = 7;
  means[1].building = "Straße 1";
  means[1].surface = 0;
  return means;
}

class MatrixNpz : public testing::Test {
 protected:
  MatrixNpz() { write_matrix_npz(two_surfaces(), their_means(), path, 2); }
  /// What NumPy reads of an array's header, and its bytes.
  void expect_array(const std::string& name, const std::string& type, const std::string& shape,
                    const std::string& expected) const {
    VSILFILE* const file = VSIFOpenL(("/vsizip/{" + path.string() + "}/" + name + ".npy").c_str(), "rb");
    ASSERT_NE(file, nullptr) << name;
    std::string bytes(1 << 16, '\0');
    bytes.resize(VSIFReadL(bytes.data(), 1, bytes.size(), file));
    VSIFCloseL(file);
    EXPECT_THAT(bytes, testing::HasSubstr("{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }")) << name;
    EXPECT_EQ(bytes.substr(bytes.find('\n') + 1), expected) << name;
  }
  scenes::TemporaryFolder folder;
  std::filesystem::path path = folder.file("m.npz");
};

template <class Number>
std::string bytes_of_numbers(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

TEST_F(MatrixNpz, HasTheArraysThatSciPyReads) {
  expect_array("format", "|S3", "()", "csr");
  expect_array("shape", "<i8", "(2,)", bytes_of_numbers<std::int64_t>({2, 8}));
  expect_array("indptr", "<i8", "(3,)", bytes_of_numbers<std::int64_t>({0, 2, 5}));
  expect_array("indices", "<i4", "(5,)", bytes_of_numbers<std::int32_t>({1, 4, 0, 2, 4}));
  expect_array("data", "<f4", "(5,)", bytes_of_numbers<float>({0.5F, 0.5F, 0.125F, 0.375F, 0.5F}));
}

TEST_F(MatrixNpz, SaysWhatRowsAndColumnsAre) {
  expect_array("building", "|S9", "(2,)", std::string("a\0\0\0\0\0\0\0\0Straße 1", 18));
  expect_array("surface", "<u4", "(2,)", bytes_of_numbers<std::uint32_t>({7, 0}));
  expect_array("area_m2", "<f8", "(2,)", bytes_of_numbers<double>({10.0, 40.0}));
  expect_array("ground_centres_m", "<f8", "(1, 2)", bytes_of_numbers<double>({500'010.5, 5'400'020.0}));
  EXPECT_THAT(names_after_surfaces(two_surfaces()),
              testing::ElementsAre("ground_-1_3", "ground_beyond", "sky", "crown", "other", "dropped"));
}

TEST_F(MatrixNpz, IsTheSameForAnyNumberOfThreads) {
  write_matrix_npz(two_surfaces(), their_means(), folder.file("one.npz"), 1);
  EXPECT_EQ(scenes::text_of(folder.file("one.npz")), scenes::text_of(path));
}

TEST_F(MatrixNpz, ADiskThatRefusesIsTold) {
  EXPECT_THROW(write_matrix_npz(two_surfaces(), their_means(), folder.file("nowhere") / "m.npz", 1), OutputError);
}

}  // namespace
}  // namespace farlod
