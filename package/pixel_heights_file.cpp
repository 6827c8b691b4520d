// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {

using package::HeightsHeader;

bool package::is_rough(const SurfacePixels& p, std::uint64_t triangles) {
  // With fewer triangles for each pixel, edges are drawn sooner: blocks on level ground have 0.2, natural relief 2, surveys of
  // towns by lasers 2 to 3, of woods 8
  constexpr double least_triangles_per_pixel = 0.5;
  // More are too many to be counted by a march
  constexpr std::uint32_t most_along = std::uint32_t{1} << 28;
  if (std::max(p.columns, p.rows) > most_along) return false;
  const double pixels = static_cast<double>(p.columns) * p.rows;
  return static_cast<double>(triangles) >= least_triangles_per_pixel * pixels;
}

bool package::has_rough_surface(const Manifest& m) {
  if (!m.heights() || !m.pixels->walls || m.far_terrain) return false;
  return is_rough(*m.pixels, m.triangles);
}

std::optional<Cell> PixelsInGrid::cell_around(std::size_t column, std::size_t row, const Grid& grid) const {
  const Point2d p_grid = centre_of(column, row);
  const Cell cell = grid.cell_of(p_grid);
  const Point2d p_cell = p_grid - grid.corner_of(cell);
  const auto x = static_cast<float>(p_cell.x), y = static_cast<float>(p_cell.y), edge = static_cast<float>(grid.cell_edge_m);
  const bool is_within = x > 0.0F && y > 0.0F && x < edge && y < edge;
  return is_within && grid.cells.contains(cell) ? std::optional(cell) : std::nullopt;
}

PixelHeightsFile::PixelHeightsFile(const PackageFolder& folder, const package::Manifest& manifest)
    : name_(folder.file(package::heights_file).name), file_(folder.plain_file(package::heights_file)) {
  const package::SurfacePixels& pixels = *manifest.pixels;
  check_stamp(folder.file(package::heights_file), file_, *pixels.heights);
  const std::span<const std::byte> bytes = file_.bytes();
  require(bytes.size() >= sizeof(HeightsHeader), "it has no header");
  const auto& header = *reinterpret_cast<const HeightsHeader*>(bytes.data());
  require(header.magic == package::heights_magic, "it does not begin as heights.bin does");
  require_readable_version(name_, header.version, package::heights_version, package::placed_heights_version);
  const std::uint64_t count = std::uint64_t{header.columns} * header.rows;
  require(header.columns == pixels.columns && header.rows == pixels.rows, "its pixels are not those of the manifest");
  const std::size_t before =
      sizeof(HeightsHeader) + (header.version == package::placed_heights_version ? sizeof(PixelsInGrid) : 0);
  require(bytes.size() >= before && header.file_bytes == bytes.size() && (bytes.size() - before) / 5 == count &&
              (bytes.size() - before) % 5 == 0,
          "its length is not that of its pixels");
  read_places(header.version, pixels);
  const std::byte* const heights = bytes.data() + before;
  height_m_ = {reinterpret_cast<const float*>(heights), count};
  joined_ = {reinterpret_cast<const std::uint8_t*>(heights + height_m_.size_bytes()), count};
  check_pixels(pixels);
  if (pixels.squares) check_squares(pixels, manifest.grid);
}

void PixelHeightsFile::read_places(std::uint32_t version, const package::SurfacePixels& pixels) {
  require(!pixels.squares || version == package::placed_heights_version, "it does not say where its pixels lie");
  if (version != package::placed_heights_version) return;
  std::memcpy(&in_grid_.emplace(), file_.bytes().data() + sizeof(HeightsHeader), sizeof(PixelsInGrid));
  const PixelsInGrid& g = *in_grid_;
  constexpr double farthest_m = 1e9, rounding = 1e-9;
  require(std::abs(g.first_x_m) <= farthest_m && std::abs(g.first_y_m) <= farthest_m && g.step_m >= 1e-3 && g.step_m <= 1e6 &&
              std::abs(g.cos * g.cos + g.sin * g.sin - 1.0) <= rounding,
          "its pixels lie nowhere");
}

void PixelHeightsFile::check_pixels(const package::SurfacePixels& pixels) const {
  const auto has_height = [&](std::size_t n) { return !std::isnan(height_m_[n]); };
  for (std::size_t row = 0, n = 0; row < pixels.rows; ++row)
    for (std::size_t column = 0; column < pixels.columns; ++column, ++n) {
      require(!has_height(n) || std::abs(height_m_[n]) <= package::farthest_in_tile_m, "a height lies nowhere on Earth");
      const bool east = (joined_[n] & JoinedPixels::east) != 0, north = (joined_[n] & JoinedPixels::north) != 0;
      require(!east || (column + 1 < pixels.columns && has_height(n) && has_height(n + 1)), "a pixel is joined with none");
      require(!north || (row + 1 < pixels.rows && has_height(n) && has_height(n + pixels.columns)),
              "a pixel is joined with none");
    }
}

void PixelHeightsFile::check_squares(const package::SurfacePixels& pixels, const Grid& grid) const {
  const auto cells_of_row = [&](std::size_t row) {
    std::vector<std::optional<Cell>> cells(pixels.columns);
    for (std::size_t column = 0; column < cells.size(); ++column) cells[column] = in_grid_->cell_around(column, row, grid);
    return cells;
  };
  std::uint64_t count = 0;
  std::vector<std::optional<Cell>> south = cells_of_row(0);
  for (std::size_t row = 0; row < pixels.rows; ++row) {
    std::vector<std::optional<Cell>> north = cells_of_row(row + 1);
    for (std::size_t column = 0, n = row * pixels.columns; column < pixels.columns; ++column, ++n) {
      if ((joined_[n] & PixelSquares::left_out) == 0) continue;
      ++count;
      require(is_whole_square(column, row, pixels), "a square that no tile has is torn");
      const std::optional<Cell>& cell = south[column];
      require(cell && south[column + 1] == cell && north[column] == cell && north[column + 1] == cell,
              "a square that no tile has lies in no cell, or in several");
    }
    south = std::move(north);
  }
  require(count == *pixels.squares, "its squares that no tile has are not as many as the manifest says");
}

/// Pixels are joined with such that exist.
bool PixelHeightsFile::is_whole_square(std::size_t column, std::size_t row, const package::SurfacePixels& pixels) const {
  const std::size_t n = row * pixels.columns + column;
  constexpr std::uint8_t both = JoinedPixels::east | JoinedPixels::north;
  return column + 1 < pixels.columns && row + 1 < pixels.rows && (joined_[n] & both) == both &&
         (joined_[n + 1] & JoinedPixels::north) != 0 && (joined_[n + pixels.columns] & JoinedPixels::east) != 0;
}

}  // namespace farlod
