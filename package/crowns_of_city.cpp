// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/crowns_of_city.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <system_error>
#include <tuple>
#include <vector>

#include "base/durable_file.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"

namespace farlod {
namespace {

/// In 65536ths of a right angle: turned by a right angle, a square is what it was.
std::uint16_t steps_of_turn(double turn_rad) {
  constexpr double right_angle_rad = std::numbers::pi / 2.0, steps = 65536.0;
  const double turned_rad = std::fmod(std::fmod(turn_rad, right_angle_rad) + right_angle_rad, right_angle_rad);
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(std::lround(turned_rad / right_angle_rad * steps)) & 0xFFFFU);
}

/// −0 is 0, so that equal crowns have equal bytes.
float without_sign_of_0(double coordinate_m) { return static_cast<float>(coordinate_m) + 0.0F; }

auto key_of(const CrownsOfCity::OwnedCrown& c) {
  return std::tuple(c.cell, c.crown.y_m, c.crown.x_m, c.crown.bottom_m, c.crown.top_m, c.crown.half_width_m, c.crown.shape,
                    c.crown.foliage, c.crown.turn);
}

}  // namespace

void CrownsOfCity::add(Point2d axis_grid, double bottom_m, double top_m, double half_width_m, CrownShape shape, Foliage foliage,
                       double turn_rad_grid) {
  FARLOD_EXPECTS(std::isfinite(bottom_m) && std::isfinite(top_m) && std::isfinite(half_width_m) && std::isfinite(turn_rad_grid));
  FARLOD_EXPECTS(std::isfinite(axis_grid.x) && std::isfinite(axis_grid.y) && bottom_m < top_m && half_width_m > 0.0);
  const double low_m = bottom_m - height_origin_m_, high_m = top_m - height_origin_m_;
  if (!holds(grid_, axis_grid) || std::max({-low_m, high_m, half_width_m}) > package::farthest_crown_m) {
    ++outside_;
    return;
  }
  const Cell cell = grid_.cell_of(axis_grid);
  const Point2d p_cell = axis_grid - grid_.corner_of(cell);
  Crown crown{without_sign_of_0(p_cell.x),
              without_sign_of_0(p_cell.y),
              without_sign_of_0(low_m),
              without_sign_of_0(high_m),
              std::max(static_cast<float>(half_width_m), std::numeric_limits<float>::min()),
              shape,
              foliage,
              shape == CrownShape::prism ? steps_of_turn(turn_rad_grid) : std::uint16_t{0}};
  // Thinner than a float can tell: as thin as it can
  if (!(crown.bottom_m < crown.top_m)) crown.top_m = std::nextafter(crown.bottom_m, std::numeric_limits<float>::infinity());
  crowns_.push_back({grid_.cells.index_of(cell), crown});
  is_in_order_ = false;
}

const PagedArray<CrownsOfCity::OwnedCrown>& CrownsOfCity::in_order() {
  if (!is_in_order_)
    std::sort(crowns_.begin(), crowns_.end(), [](const OwnedCrown& a, const OwnedCrown& b) { return key_of(a) < key_of(b); });
  is_in_order_ = true;
  return crowns_;
}

namespace fs = std::filesystem;
namespace {

using Crowns = PagedArray<CrownsOfCity::OwnedCrown>;

std::vector<package::CrownCellRecord> cells_of(const Crowns& crowns, const CellRange& cells) {
  std::vector<package::CrownCellRecord> records;
  for (std::size_t n = 0; n < crowns.size(); ++n) {
    const Crown& crown = crowns[n].crown;
    if (n == 0 || crowns[n].cell != crowns[n - 1].cell) {
      const Cell cell = cells.cell_at(crowns[n].cell);
      records.push_back({cell.i, cell.j, n, 0, crown.bottom_m, crown.top_m, 0});
    }
    package::CrownCellRecord& record = records.back();
    ++record.crown_count;
    record.z_low_m = std::min(record.z_low_m, crown.bottom_m);
    record.z_high_m = std::max(record.z_high_m, crown.top_m);
  }
  return records;
}

package::CrownsHeader header_of(const Crowns& crowns, std::size_t cell_count) {
  package::CrownsHeader header{};
  header.magic = package::crowns_magic;
  header.version = package::crowns_version;
  header.cell_count = cell_count;
  header.crown_count = crowns.size();
  header.file_bytes = package::crowns_file_bytes(cell_count, crowns.size());
  for (const auto& owned : crowns) header.largest_half_width_m = std::max(header.largest_half_width_m, owned.crown.half_width_m);
  return header;
}

void write(const fs::path& path, const Crowns& crowns, const CellRange& cells) {
  const std::vector<package::CrownCellRecord> records = cells_of(crowns, cells);
  const package::CrownsHeader header = header_of(crowns, records.size());
  std::ofstream file(path, std::ios::binary);
  const auto put = [&file](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(*first)));
  };
  put(&header, 1);
  put(records.data(), records.size());
  for (const auto& owned : crowns) put(&owned.crown, 1);
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

std::optional<package::CanopyFile> write_canopy(const fs::path& folder, CrownsOfCity& crowns) {
  if (crowns.empty()) return std::nullopt;
  const Crowns& in_order = crowns.in_order();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + " cannot be written: " + error.message());
  package::CanopyFile canopy;
  for (const auto& owned : in_order) ++canopy.crowns_of_shape[static_cast<std::size_t>(owned.crown.shape)];
  write_durably(folder / package::crowns_file, [&](const fs::path& part) {
    write(part, in_order, crowns.grid().cells);
    canopy.stamp = stamp_of(part);
  });
  in_order.let_go();
  return canopy;
}

}  // namespace farlod
