// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "farlod/error.hpp"
#include "tests/library/library_calls.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

using testing::HasSubstr;

/// Files of a package are mapped: once checked, they may change under a program that has it open.
class ChangedPackage : public testing::Test {
 protected:
  void SetUp() override { raster.call(arguments_); }

  /// The first file of this name in the package.
  [[nodiscard]] std::filesystem::path file(const std::string& name) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sample_.folder()))
      if (entry.path().filename() == name) return entry.path();
    ADD_FAILURE() << "no " << name;
    return {};
  }
  void expect_refused(const std::string& name) {
    for (const Named& named :
         {points_into, points, tiles, raster, window, surfaces, cell_contents, geometry, far_view, outlines, heights})
      try {
        named.call(arguments_);
        ADD_FAILURE() << named.name << " answers";
      } catch (const PackageDamaged& error) {
        EXPECT_THAT(error.what(), HasSubstr(name)) << named.name;
        EXPECT_THAT(error.what(), HasSubstr("open the package again")) << named.name;
      }
  }

  PackedSample sample_;
  Arguments arguments_{sample_.folder()};
};

TEST_F(ChangedPackage, AsItWasAnswers) { EXPECT_NO_THROW(raster.call(arguments_)); }

TEST_F(ChangedPackage, WithAShorterFileIsRefused) {
  // A mapping of what is beyond a file's end would end the process
  std::filesystem::resize_file(file("tiles.bin"), 100);
  expect_refused("tiles.bin");
  EXPECT_FALSE(check_package(arguments_.package).damage.empty());
}

TEST_F(ChangedPackage, WithAFarMapWrittenAgainIsRefused) {
  const auto far_map = file("far.exr");
  std::filesystem::last_write_time(far_map, std::filesystem::last_write_time(far_map) + std::chrono::seconds(5));
  expect_refused("far.exr");
}

TEST_F(ChangedPackage, WithAnotherManifestIsRefused) {
  // As when it was packed again: another file under the same name
  const auto manifest = file("manifest.json");
  std::filesystem::copy_file(manifest, manifest.string() + ".new");
  std::filesystem::rename(manifest.string() + ".new", manifest);
  expect_refused("manifest.json");
}

TEST_F(ChangedPackage, WithoutAFileIsRefused) {
  std::filesystem::remove(file("tiles.bin"));
  expect_refused("tiles.bin");
}

TEST_F(ChangedPackage, OpenedAgainAnswers) {
  const auto far_map = file("far.exr");
  std::filesystem::last_write_time(far_map, std::filesystem::last_write_time(far_map) + std::chrono::seconds(5));
  arguments_.package = Package(sample_.folder());
  EXPECT_NO_THROW(raster.call(arguments_));
}

}  // namespace
}  // namespace farlod::library
