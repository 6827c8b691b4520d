// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "app/package_facts.hpp"
#include "farlod/problem.hpp"

namespace farlod {
namespace {

/// Lines with a name on their left, which those that follow leave out.
class AlignedText {
 public:
  void add(std::string_view name, const std::string& fact) { text_ += fmt::format("{:<14}{}\n", name, fact); }
  void go_on(const std::string& fact) { add("", fact); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string bytes_text(std::uint64_t bytes) {
  constexpr double kib = 1024.0, mib = kib * kib;
  const auto size = static_cast<double>(bytes);
  if (size < kib) return fmt::format("{} bytes", bytes);
  return size < mib ? fmt::format("{:.1f} KiB", size / kib) : fmt::format("{:.1f} MiB", size / mib);
}

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string text_of(const Box2d& box) {
  const auto& [low, high] = box;
  return fmt::format("{:.1f}, {:.1f} to {:.1f}, {:.1f} ({:.0f} m × {:.0f} m)", low.x, low.y, high.x, high.y, high.x - low.x,
                     high.y - low.y);
}

void add_place(const PackageDescription& d, AlignedText& text) {
  text.add("CRS", crs_text(d));
  if (d.buildings_projected) text.add("Buildings", text_of(*d.buildings_projected));
  text.add("Extent", text_of(d.outline_projected) + ", all cells");
  text.add(d.buildings > 0 ? "Streets" : "Axes",
           fmt::format("bearing {:.2f}° from true north, {:.2f}° from grid north (convergence {:+.2f}°)",
                       (d.grid_bearing + d.convergence).degrees(), d.grid_bearing.degrees(), d.convergence.degrees()));
}

void add_grid(const PackageFacts& facts, AlignedText& text) {
  const PackageDescription& d = facts.description;
  const CellRectangle& c = facts.inventory.cells;
  text.add("Grid", fmt::format("{} × {} cells of {:g} m: i from {} to {}, j from {} to {}", d.columns, d.rows, d.cell_edge_m,
                               c.i_begin, c.i_end - 1, c.j_begin, c.j_end - 1));
  text.go_on(fmt::format("neighbourhoods of {0} × {0} cells (N = {0})", d.neighborhood));
  text.go_on(fmt::format("{} of {} × {} cells at the most", counted(facts.inventory.blocks, "block", "blocks"),
                         facts.inventory.block_edge, facts.inventory.block_edge));
}

/// A surface model has no buildings, which is no lack.
void add_city(const PackageFacts& facts, AlignedText& text) {
  const PackageDescription& d = facts.description;
  if (facts.pixels && d.buildings == 0)
    text.add("City", fmt::format("a surface model of {} × {} pixels of {:g} m, {} triangles; buildings are a part of it",
                                 facts.pixels->columns, facts.pixels->rows, facts.pixels->step_m, d.triangles));
  else
    text.add("City", fmt::format("{} buildings, {} polygons, {} triangles", d.buildings, d.polygons, d.triangles));
}

void add_far_maps(const PackageFacts& facts, AlignedText& text) {
  const PackageDescription& d = facts.description;
  if (d.has_rough_surface && d.cells_with_far_map == 0) {
    text.add("Far maps", "none, and none is missing: rays march over the pixels");
    text.add("On disk", fmt::format("tiles {}", bytes_text(facts.inventory.tile_bytes)));
    return;
  }
  const PackageInventory& i = facts.inventory;
  const auto cells = static_cast<std::uint64_t>(d.columns * d.rows);
  const std::string where = d.cells_with_far_map == cells ? fmt::format("in all {} cells", cells)
                                                          : fmt::format("in {} of {} cells", d.cells_with_far_map, cells);
  text.add("Far maps", fmt::format("kind {}, {}", d.far_map_kind, where));
  if (i.azimuth_bins > 0)
    text.go_on(fmt::format("{} azimuth bins, {} × {} squares, {}, tolerance {:g}", i.azimuth_bins, i.squares_per_edge,
                           i.squares_per_edge, counted(i.layers, "layer", "layers"), i.tolerance));
  else
    text.go_on(fmt::format("four sides of {} columns and {} rows", i.side_columns, i.rows));
  text.add("On disk", fmt::format("tiles {}, far maps {}", bytes_text(i.tile_bytes), bytes_text(i.far_map_bytes)));
}

void add_crowns(const PackedCrowns& c, AlignedText& text) {
  if (c.all() == 0) return;
  text.add("Trees",
           fmt::format("{} ({}, {}, {}), {}", counted(c.all(), "crown", "crowns"), counted(c.spheroids, "spheroid", "spheroids"),
                       counted(c.cylinders, "cylinder", "cylinders"), counted(c.prisms, "prism", "prisms"), bytes_text(c.bytes)));
}

std::string problem_text(int code, std::uint64_t count) {
  const auto found =
      std::ranges::find_if(problem_descriptions, [&](const ProblemDescription& p) { return static_cast<int>(p.code) == code; });
  // A later release may know more of them
  if (found == problem_descriptions.end()) return fmt::format("{} × {}", count, code);
  return fmt::format("{} × {} {}: {} ({})", count, code, found->slug, found->summary, name_of(found->effect));
}

void add_origin(const PackageInventory& i, AlignedText& text) {
  text.add("Settings", i.assign == "clip" ? "buildings are cut at the borders of cells (clip)"
                                          : "each building is whole, in one cell (whole)");
  std::string_view name = "Inputs";
  for (const PackedInput& input : i.inputs) {
    text.add(name, fmt::format("{}, {} bytes, XXH3 {:016x}", input.name, input.bytes, input.xxh3));
    name = "";
  }
  name = "Problems";
  if (i.problems.empty()) text.add(name, "none");
  for (const auto& [code, count] : i.problems) {
    text.add(name, problem_text(code, count));
    name = "";
  }
}

void add_check(const PackageCheck& check, AlignedText& text) {
  text.add("Check", fmt::format("{} read, {}", counted(check.files, "file", "files"), bytes_text(check.bytes)));
  text.go_on(
      fmt::format("{} and {} are right", counted(check.cells, "tile", "tiles"), counted(check.far_maps, "far map", "far maps")));
  if (check.crowns > 0) text.go_on(fmt::format("{} right", counted(check.crowns, "crown is", "crowns are")));
  text.go_on(check.damage.empty() ? "the package is whole"
                                  : counted(check.damage.size(), "damage was found", "damages were found"));
}

void add_cell(const CellContents& c, AlignedText& text) {
  const auto& corners = c.corners_projected;
  text.add("Cell", fmt::format("{},{}", c.cell.i, c.cell.j));
  text.add("  corners", fmt::format("{:.1f}, {:.1f}; {:.1f}, {:.1f}; {:.1f}, {:.1f}; {:.1f}, {:.1f}", corners[0].x, corners[0].y,
                                    corners[1].x, corners[1].y, corners[2].x, corners[2].y, corners[3].x, corners[3].y));
  text.add("  tile", fmt::format("{} triangles, {} vertices, {}, {}", c.triangles, c.vertices,
                                 counted(c.buildings, "building", "buildings"), bytes_text(c.tile_bytes)));
  if (c.low_m && c.high_m) text.add("  heights", fmt::format("{:.2f} m to {:.2f} m", *c.low_m, *c.high_m));
  text.add("  edges",
           fmt::format("{} grounded, {} of overhangs, {} of undersides", c.grounded_edges, c.overhang_edges, c.underside_edges));
  text.add("  far map", c.has_far_map ? fmt::format("{}, {}", bytes_text(c.far_map_bytes),
                                                    counted(c.explicit_edges, "explicit edge", "explicit edges"))
                                      : std::string("none"));
  std::string_view name = "  near";
  for (const NeighborCell& near : c.near_cells) {
    text.add(name, fmt::format("{},{}: {} triangles", near.cell.i, near.cell.j, near.triangles));
    name = "";
  }
}

}  // namespace

std::string crs_text(const PackageDescription& d) {
  return d.epsg ? fmt::format("{} (EPSG:{})", d.crs_name, *d.epsg) : d.crs_name;
}

std::string facts_text(const PackageFacts& facts) {
  AlignedText text;
  const PackageDescription& d = facts.description;
  text.add("Package",
           fmt::format("{}, format version {}, written by {}", facts.package, facts.inventory.format_version, d.software));
  add_place(d, text);
  add_grid(facts, text);
  add_city(facts, text);
  add_crowns(facts.inventory.crowns, text);
  add_far_maps(facts, text);
  add_origin(facts.inventory, text);
  if (facts.check) add_check(*facts.check, text);
  if (facts.cell) add_cell(*facts.cell, text);
  return text.text();
}

std::string damage_text(const PackageDamage& damage) {
  return damage.cell ? fmt::format("cell {},{}: {}", damage.cell->i, damage.cell->j, damage.what) : damage.what;
}

}  // namespace farlod
