// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/crowns_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "farlod/error.hpp"
#include "package/file_stamp.hpp"

namespace farlod {
namespace {

using package::CrownCellRecord;
using package::CrownsHeader;

constexpr std::uint64_t most_crowns = std::uint64_t{1} << 36;

/// So many are in memory while all are checked: some MiB.
constexpr std::uint64_t crowns_between = std::uint64_t{1} << 19;

/// Not of a number that is none.
bool is_on_earth(float coordinate_m) { return std::abs(coordinate_m) <= package::farthest_crown_m; }

bool comes_before(const CrownCellRecord& a, Cell b) { return std::pair(a.j, a.i) < std::pair(b.j, b.i); }

/// The first rule that a crown breaks; null where it breaks none.
const char* breach_of(const Crown& c, float cell_edge_m) {
  if (!(c.x_m >= 0.0F && c.x_m <= cell_edge_m && c.y_m >= 0.0F && c.y_m <= cell_edge_m))
    return "a crown lies outside of its cell";
  if (!is_on_earth(c.bottom_m) || !is_on_earth(c.top_m)) return "a crown lies nowhere on Earth";
  if (!(c.bottom_m < c.top_m)) return "a crown's bottom is not below its top";
  if (!(c.half_width_m > 0.0F) || !is_on_earth(c.half_width_m)) return "a crown's half width is impossible";
  if (static_cast<std::size_t>(c.shape) >= crown_shape_count) return "a crown is of a shape that does not exist";
  if (c.foliage > Foliage::deciduous) return "a crown is of a foliage that does not exist";
  if (c.turn != 0 && c.shape != CrownShape::prism) return "a crown is turned that is round";
  return nullptr;
}

}  // namespace

CrownsFile::CrownsFile(const PackageFolder& folder, const package::Manifest& manifest)
    : name_(folder.file(package::crowns_file).name), file_(folder.plain_file(package::crowns_file)) {
  check_stamp(folder.file(package::crowns_file), file_, manifest.canopy->stamp);
  check_header();
  check_cells(manifest.grid);
  check_crowns(manifest);
  let_go();
}

std::span<const Crown> CrownsFile::crowns_of(Cell cell) const {
  const auto from = cells_from(cell);
  const bool is_there = !from.empty() && Cell{from.front().i, from.front().j} == cell;
  return is_there ? crowns_of(from.front()) : std::span<const Crown>{};
}

std::span<const CrownCellRecord> CrownsFile::cells_from(Cell first) const {
  return {std::lower_bound(cells_.begin(), cells_.end(), first, comes_before), cells_.end()};
}

void CrownsFile::check_header() {
  const std::span<const std::byte> bytes = file_.bytes();
  require(bytes.size() >= sizeof(CrownsHeader), "it has no header");
  const CrownsHeader& h = header();
  require(h.magic == package::crowns_magic, "it does not begin as crowns.bin does");
  require_readable_version(name_, h.version, package::crowns_version, package::crowns_version);
  require(h.cell_count > 0 && h.cell_count <= h.crown_count && h.crown_count <= most_crowns,
          "its numbers of crowns are impossible");
  require(h.file_bytes == bytes.size() && package::crowns_file_bytes(h.cell_count, h.crown_count) == bytes.size(),
          "its length is not that of its crowns");
  const std::byte* const cells = bytes.data() + sizeof(CrownsHeader);
  cells_ = {reinterpret_cast<const CrownCellRecord*>(cells), h.cell_count};
  crowns_ = {reinterpret_cast<const Crown*>(cells + cells_.size_bytes()), h.crown_count};
}

void CrownsFile::check_cells(const Grid& grid) const {
  std::uint64_t crowns = 0;
  for (std::size_t n = 0; n < cells_.size(); ++n) {
    const CrownCellRecord& c = cells_[n];
    require(grid.cells.contains({c.i, c.j}), "a cell does not exist");
    require(n == 0 || comes_before(cells_[n - 1], {c.i, c.j}), "its cells are not in order");
    require(c.first_crown == crowns && c.crown_count > 0, "the crowns of its cells are not in order");
    crowns += c.crown_count;
  }
  require(crowns == crowns_.size(), "it holds another number of crowns than its cells own");
}

void CrownsFile::check_crowns(const package::Manifest& manifest) const {
  const auto cell_edge_m = static_cast<float>(manifest.grid.cell_edge_m);
  std::array<std::uint64_t, crown_shape_count> of_shape{};
  float half_width_m = 0.0F;
  std::uint64_t let_go_at = crowns_between;
  for (const CrownCellRecord& cell : cells_) {
    if (cell.first_crown >= let_go_at) {
      let_go();
      let_go_at = cell.first_crown + crowns_between;
    }
    float low_m = std::numeric_limits<float>::infinity(), high_m = -low_m;
    for (const Crown& crown : crowns_of(cell)) {
      const char* const breach = breach_of(crown, cell_edge_m);
      require(breach == nullptr, breach);
      ++of_shape[static_cast<std::size_t>(crown.shape)];
      low_m = std::min(low_m, crown.bottom_m);
      high_m = std::max(high_m, crown.top_m);
      half_width_m = std::max(half_width_m, crown.half_width_m);
    }
    require(cell.z_low_m == low_m && cell.z_high_m == high_m, "a cell's heights are not those of its crowns");
  }
  require(largest_half_width_m() == half_width_m, "its largest half width is not that of its crowns");
  require(of_shape == manifest.canopy->crowns_of_shape, "it does not have the crowns that the manifest counts");
}

}  // namespace farlod
