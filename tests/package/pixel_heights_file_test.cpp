// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstddef>
#include <cstring>
#include <fstream>

#include "package/file_stamp.hpp"
#include "package/pixel_heights.hpp"
#include "tests/package/small_package.hpp"

namespace farlod {
namespace {

using package::heights_file;
using package::HeightsHeader;
using testing::AllOf;
using testing::HasSubstr;

/// The small package as the surface of a raster of 3 × 2 pixels, one of which has no height.
class SmallHeights : public testing::Test {
 protected:
  SmallHeights() {
    (void)write_pixel_heights(small.folder(), pixels, heights);
    whole = bytes_of(path());
  }
  [[nodiscard]] std::filesystem::path path() const { return small.folder() / heights_file; }
  [[nodiscard]] package::Manifest manifest_of_this() const {
    package::Manifest manifest = read_manifest(small.folder());
    manifest.pixels = pixels;
    manifest.pixels->heights = stamp_of(path());
    return manifest;
  }
  void write_manifest(const package::Manifest& manifest) const {
    std::ofstream(small.folder() / package::manifest_file) << manifest_text(manifest);
  }
  /// What a reader says of these bytes where the manifest names them as they are.
  [[nodiscard]] std::string damage_of(const Bytes& bytes) const {
    write_bytes(path(), bytes);
    return damage_met_by([&] { (void)PixelHeightsFile(PackageFolder(small.folder()), manifest_of_this()); });
  }
  template <class T>
  [[nodiscard]] std::string damage_with(std::size_t offset, T value) const {
    Bytes bytes = whole;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return damage_of(bytes);
  }
  [[nodiscard]] std::string damage_with_height(std::size_t pixel, float height_m) const {
    return damage_with(sizeof(HeightsHeader) + pixel * sizeof(float), height_m);
  }
  [[nodiscard]] std::string damage_with_joined(std::size_t pixel, std::uint8_t joined) const {
    return damage_with(sizeof(HeightsHeader) + heights.height_m.size() * sizeof(float) + pixel, joined);
  }

  SmallPackage small;
  const package::SurfacePixels pixels{{500'000.0, 5'700'000.0}, 0.5, 3, 2};
  const PixelHeights heights{{1.5F, not_a_number, 3.0F, 1.75F, 2.0F, -4.0F},
                             {JoinedPixels::north, 0, 0, JoinedPixels::east, 0, 0}};
  Bytes whole;
};

TEST_F(SmallHeights, ComeBack) {
  const PixelHeightsFile file(PackageFolder(small.folder()), manifest_of_this());
  EXPECT_THAT(file.height_m(), testing::Pointwise(testing::NanSensitiveFloatEq(), heights.height_m));
  EXPECT_THAT(file.joined(), testing::ElementsAreArray(heights.joined));
  file.let_go();
  EXPECT_EQ(file.height_m()[2], 3.0F);
  EXPECT_EQ(whole.size(), sizeof(HeightsHeader) + 6U * 5U);
}

TEST_F(SmallHeights, TheWriterTellsTheirStamp) {
  const std::filesystem::path other = small.folder() / "other";
  EXPECT_EQ(write_pixel_heights(other, pixels, heights), stamp_of(path()));
  EXPECT_EQ(bytes_of(other / heights_file), whole);
}

TEST_F(SmallHeights, ThePackageHandsThemOut) {
  write_manifest(manifest_of_this());
  const PackageReader package(small.folder());
  EXPECT_EQ(package.manifest().heights(), stamp_of(path()));
  ASSERT_NE(package.pixel_heights(), nullptr);
  EXPECT_THAT(package.pixel_heights()->height_m(), testing::Pointwise(testing::NanSensitiveFloatEq(), heights.height_m));
}

TEST_F(SmallHeights, APackageWhoseManifestNamesNoneHasNone) {
  EXPECT_EQ(PackageReader(small.folder()).pixel_heights(), nullptr) << "no pixels";
  package::Manifest manifest = manifest_of_this();
  manifest.pixels->heights.reset();
  write_manifest(manifest);
  const PackageReader package(small.folder());
  ASSERT_TRUE(package.manifest().pixels.has_value());
  EXPECT_EQ(package.pixel_heights(), nullptr) << "pixels alone";
}

TEST_F(SmallHeights, EachByteIsChecked) {
  const package::Manifest manifest = manifest_of_this();
  const auto damage = [&] { return damage_met_by([&] { (void)PixelHeightsFile(PackageFolder(small.folder()), manifest); }); };
  for (std::size_t n = 0; n < whole.size(); ++n) {
    Bytes bytes = whole;
    bytes[n] ^= std::byte{1};
    write_bytes(path(), bytes);
    EXPECT_THAT(damage(), AllOf(HasSubstr(path().string()), HasSubstr("its checksum is not the manifest's"))) << n;
  }
  write_bytes(path(), std::span(whole).first(whole.size() - 1));
  EXPECT_THAT(damage(), AllOf(HasSubstr(heights_file), HasSubstr("bytes, the manifest says")));
  std::filesystem::remove(path());
  EXPECT_THAT(damage(), HasSubstr(path().string()));
}

TEST_F(SmallHeights, AFileThatIsReplacedWhileItIsOpenIsTold) {
  write_manifest(manifest_of_this());
  const PackageReader package(small.folder());
  write_bytes(path(), whole);
  package.require_unchanged();
  (void)package.pixel_heights();
  package.require_unchanged();
  std::filesystem::remove(path());
  EXPECT_THAT(damage_met_by([&] { package.require_unchanged(); }), HasSubstr(heights_file));
}

TEST_F(SmallHeights, WhatBreaksARuleOfTheHeaderIsDamage) {
  EXPECT_EQ(damage_of(whole), "no damage");
  EXPECT_THAT(damage_with(0, 'X'), AllOf(HasSubstr(path().string()), HasSubstr("does not begin as heights.bin does")));
  EXPECT_THAT(damage_with(offsetof(HeightsHeader, version), std::uint32_t{0}), HasSubstr("its format version does not exist"));
  EXPECT_THROW((void)damage_with(offsetof(HeightsHeader, version), package::placed_heights_version + 1), PackageUnusable);
  for (const std::size_t offset : {offsetof(HeightsHeader, columns), offsetof(HeightsHeader, rows)})
    for (const std::uint32_t count : {0U, 1U, 6U, ~0U})
      EXPECT_THAT(damage_with(offset, count), HasSubstr("its pixels are not those of the manifest")) << count;
  EXPECT_THAT(damage_with(offsetof(HeightsHeader, file_bytes), std::uint64_t{3}), HasSubstr("its length is not"));
  EXPECT_EQ(damage_with(offsetof(HeightsHeader, reserved), std::uint32_t{7}), "no damage");
}

TEST_F(SmallHeights, AnotherLengthIsDamage) {
  for (std::size_t size = 0; size < whole.size() + 11; ++size) {
    if (size == whole.size()) continue;
    Bytes bytes = whole;
    bytes.resize(size);
    const std::uint64_t file_bytes = size;
    if (size >= sizeof(HeightsHeader))
      std::memcpy(bytes.data() + offsetof(HeightsHeader, file_bytes), &file_bytes, sizeof file_bytes);
    EXPECT_THAT(damage_of(bytes), HasSubstr(path().string())) << size << " bytes";
  }
}

TEST_F(SmallHeights, AHeightThatLiesNowhereOnEarthIsDamage) {
  for (const float height_m : {infinite, -infinite, 1.4e7F, -1.4e7F})
    EXPECT_THAT(damage_with_height(5, height_m), HasSubstr("a height lies nowhere on Earth")) << height_m;
  EXPECT_EQ(damage_with_height(5, package::farthest_in_tile_m), "no damage");
  EXPECT_EQ(damage_with_height(5, not_a_number), "no damage");
}

TEST_F(SmallHeights, APixelThatIsJoinedWithNoneIsDamage) {
  const auto is_told = AllOf(HasSubstr(path().string()), HasSubstr("a pixel is joined with none"));
  EXPECT_THAT(damage_with_joined(0, JoinedPixels::east), is_told) << "the other one has no height";
  EXPECT_THAT(damage_with_joined(1, JoinedPixels::east), is_told) << "it has no height";
  EXPECT_THAT(damage_with_joined(1, JoinedPixels::north), is_told) << "it has no height";
  EXPECT_THAT(damage_with_height(3, not_a_number), is_told) << "neither of two has a height";
  EXPECT_THAT(damage_with_joined(2, JoinedPixels::east), is_told) << "beyond the last column";
  EXPECT_THAT(damage_with_joined(5, JoinedPixels::east), is_told) << "beyond the last pixel";
  EXPECT_THAT(damage_with_joined(4, JoinedPixels::north), is_told) << "beyond the last row";
  EXPECT_EQ(damage_with_joined(2, JoinedPixels::north), "no damage");
  EXPECT_EQ(damage_with_joined(4, JoinedPixels::east), "no damage");
}

/// A raster of 3 × 3 pixels of 0.5 m in one cell, whose north-eastern pixel has no height; two squares are left out.
class HeightsWithSquares : public SmallHeights {
 protected:
  HeightsWithSquares() { write(PixelHeights(heights_with_squares)); }

  void write(const PixelHeights& heights_now) {
    (void)write_pixel_heights(small.folder(), pixels_with_squares, heights_now);
    whole = bytes_of(path());
  }
  [[nodiscard]] std::string damage(std::uint64_t squares = 2) const {
    package::Manifest manifest = read_manifest(small.folder());
    manifest.pixels = pixels_with_squares;
    manifest.pixels->heights = stamp_of(path());
    manifest.pixels->squares = squares;
    return damage_met_by([&] { (void)PixelHeightsFile(PackageFolder(small.folder()), manifest); });
  }
  [[nodiscard]] std::string damage_at(double x_m, double y_m, double step_m = 0.5, double cos = 1.0, double sin = 0.0) {
    PixelHeights moved = heights_with_squares;
    moved.in_grid = PixelsInGrid{x_m, y_m, step_m, cos, sin};
    write(moved);
    return damage();
  }

  const package::SurfacePixels pixels_with_squares{{500'000.0, 5'700'000.0}, 0.5, 3, 3};
  static constexpr std::uint8_t both = JoinedPixels::east | JoinedPixels::north, square = both | PixelSquares::left_out;
  const PixelHeights heights_with_squares{
      {1, 2, 3, 2, 3, 1, 4, 5, not_a_number},
      {square, both, JoinedPixels::north, square, JoinedPixels::north | JoinedPixels::east, 0, JoinedPixels::east, 0, 0},
      PixelsInGrid{4.25, 5.25, 0.5, 1.0, 0.0}};
};

TEST_F(HeightsWithSquares, SayWhereTheirPixelsLie) {
  EXPECT_EQ(damage(), "no damage");
  EXPECT_EQ(whole.size(), sizeof(HeightsHeader) + sizeof(PixelsInGrid) + 9U * 5U);
  package::Manifest manifest = read_manifest(small.folder());
  manifest.pixels = pixels_with_squares;
  manifest.pixels->heights = stamp_of(path());
  manifest.pixels->squares = 2;
  const PixelHeightsFile file(PackageFolder(small.folder()), manifest);
  ASSERT_TRUE(file.in_grid().has_value());
  EXPECT_EQ(file.in_grid()->centre_of(2, 1), (Point2d{5.25, 5.75}));
  EXPECT_EQ(file.height_m()[7], 5.0F);
}

TEST_F(HeightsWithSquares, OfAnotherNumberAreDamage) {
  for (const std::uint64_t squares : {0, 1, 3})
    EXPECT_THAT(damage(squares), HasSubstr("are not as many as the manifest says")) << squares;
}

TEST_F(HeightsWithSquares, ThatDoNotKnowTheirPlacesAreDamage) {
  PixelHeights unplaced = heights_with_squares;
  unplaced.in_grid.reset();
  write(unplaced);
  EXPECT_THAT(damage(), HasSubstr("it does not say where its pixels lie"));
}

TEST_F(HeightsWithSquares, ThatAreTornAreDamage) {
  for (const std::size_t pixel : {1, 2, 4, 5, 6, 7, 8}) {
    PixelHeights torn = heights_with_squares;
    torn.joined[pixel] |= PixelSquares::left_out;
    write(torn);
    EXPECT_THAT(damage(3), HasSubstr(pixel == 1 ? "no damage" : "is torn")) << pixel;
  }
}

TEST_F(HeightsWithSquares, ThatLieInNoCellOrInSeveralAreDamage) {
  const auto is_told = HasSubstr("lies in no cell, or in several");
  const double edge_m = read_manifest(small.folder()).grid.cell_edge_m;
  EXPECT_THAT(damage_at(edge_m - 0.25, 5.25), is_told) << "over a border";
  EXPECT_THAT(damage_at(edge_m - 0.5, 5.25), is_told) << "a side on a border";
  EXPECT_THAT(damage_at(0.0, 5.25), is_told) << "a side on a border";
  EXPECT_THAT(damage_at(4.25, -9.0), is_told) << "beyond the grid";
  EXPECT_EQ(damage_at(edge_m + 0.25, 5.25), "no damage");
}

TEST_F(HeightsWithSquares, ThatLieNowhereAreDamage) {
  const auto is_told = HasSubstr("its pixels lie nowhere");
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(damage_at(none, 5.25), is_told);
  EXPECT_THAT(damage_at(4.25, 1e12), is_told);
  EXPECT_THAT(damage_at(4.25, 5.25, 0.0), is_told);
  EXPECT_THAT(damage_at(4.25, 5.25, none), is_told);
  EXPECT_THAT(damage_at(4.25, 5.25, 0.5, 2.0), is_told);
  EXPECT_THAT(damage_at(4.25, 5.25, 0.5, none, 0.0), is_told);
}

}  // namespace
}  // namespace farlod
