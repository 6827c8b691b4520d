// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/energyplus_idf.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "base/expects.hpp"
#include "farlod/version.hpp"
#include "results/atomic_file.hpp"

namespace farlod {
namespace {

/// What EnergyPlus knows of the view of a surface: a column of ours, and the name of a surrounding surface. The first two have
/// fields of their own.
struct SeenPart {
  std::string_view column, name;
};
constexpr std::size_t seen_parts = 9, first_surrounding = 2;
constexpr std::array<SeenPart, seen_parts> parts_of_view{{{"view_sky", "Sky"},
                                                          {"view_ground", "Ground"},
                                                          {"view_roof", "Roofs"},
                                                          {"view_wall_n", "Walls North"},
                                                          {"view_wall_e", "Walls East"},
                                                          {"view_wall_s", "Walls South"},
                                                          {"view_wall_w", "Walls West"},
                                                          {"view_crown", "Crowns"},
                                                          {"view_other", "Other"}}};

/// Where the parts are among the columns.
std::array<std::size_t, seen_parts> places_of_parts(std::span<const std::string> columns) {
  std::array<std::size_t, seen_parts> places{};
  for (std::size_t n = 0; n < seen_parts; ++n) {
    const auto found = std::ranges::find(columns, parts_of_view[n].column);
    FARLOD_EXPECTS(found != columns.end());
    places[n] = static_cast<std::size_t>(found - columns.begin());
  }
  return places;
}

/// Commas and semicolons end a field, and an exclamation mark begins a comment.
std::string name_in_idf(const SurfaceMean& surface) {
  std::string name = surface.id.empty() ? fmt::format("{}_{}", surface.building, surface.surface) : surface.id;
  const auto ends_field = [](char c) { return c == ',' || c == ';' || c == '!' || static_cast<unsigned char>(c) < 0x20; };
  std::ranges::replace_if(name, ends_field, '_');
  return name;
}

/// A surface of EnergyPlus, of one or more rows.
struct IdfSurface {
  std::string name;
  double area_m2 = 0.0;
  std::array<double, seen_parts> seen_m2{};  ///< area times view factor
};

std::vector<IdfSurface> idf_surfaces(std::span<const SurfaceMean> surfaces, std::span<const std::string> columns) {
  const auto places = places_of_parts(columns);
  std::vector<IdfSurface> result;
  std::map<std::string, std::size_t, std::less<>> numbers;
  for (const SurfaceMean& mean : surfaces) {
    if (mean.further_mean.empty() || !(mean.area_m2 > 0.0)) continue;
    const auto [at, is_new] = numbers.emplace(name_in_idf(mean), result.size());
    if (is_new) result.push_back({at->first});
    IdfSurface& surface = result[at->second];
    surface.area_m2 += mean.area_m2;
    for (std::size_t n = 0; n < seen_parts; ++n) surface.seen_m2[n] += mean.area_m2 * mean.further_mean[places[n]];
  }
  return result;
}

/// View factors in millionths, whose sum is less than a million: the largest one gives what is too much.
std::array<std::int64_t, seen_parts> millionths_of(const IdfSurface& surface) {
  constexpr std::int64_t most = 999'999;
  std::array<std::int64_t, seen_parts> parts{};
  for (std::size_t n = 0; n < seen_parts; ++n) parts[n] = std::llround(surface.seen_m2[n] / surface.area_m2 * 1e6);
  const std::int64_t sum = std::accumulate(parts.begin(), parts.end(), std::int64_t{0});
  if (sum > most) *std::ranges::max_element(parts) -= sum - most;
  return parts;
}

void append_field(std::string& text, std::string_view value, std::string_view meaning, char end = ',') {
  text += fmt::format("  {:<40} !- {}\n", fmt::format("{}{}", value, end), meaning);
}

std::string factor_text(std::int64_t millionths) { return fmt::format("{:.6f}", static_cast<double>(millionths) / 1e6); }

void append_surrounding(std::string& text, const std::array<std::int64_t, seen_parts>& parts) {
  std::vector<std::size_t> surrounding;
  for (std::size_t n = first_surrounding; n < seen_parts; ++n)
    if (parts[n] > 0) surrounding.push_back(n);
  // EnergyPlus wants one at least
  if (surrounding.empty()) surrounding.push_back(seen_parts - 1);
  for (std::size_t k = 0; k < surrounding.size(); ++k) {
    const std::string field = fmt::format("Surrounding Surface {} ", k + 1);
    const std::string name = fmt::format("Far-LoD {}", parts_of_view[surrounding[k]].name);
    append_field(text, name, field + "Name");
    append_field(text, factor_text(parts[surrounding[k]]), field + "View Factor");
    append_field(text, name + " Temperature", field + "Temperature Schedule Name", k + 1 == surrounding.size() ? ';' : ',');
  }
}

void append_surface(std::string& text, const IdfSurface& surface) {
  const std::string object = "Far-LoD " + surface.name;
  text += "\nSurfaceProperty:LocalEnvironment,\n";
  append_field(text, object, "Name");
  append_field(text, surface.name, "Exterior Surface Name");
  append_field(text, "", "Sunlit Fraction Schedule Name");
  append_field(text, object, "Surrounding Surfaces Object Name", ';');
  const auto parts = millionths_of(surface);
  text += "\nSurfaceProperty:SurroundingSurfaces,\n";
  append_field(text, object, "Name");
  append_field(text, factor_text(parts[0]), "Sky View Factor");
  append_field(text, "", "Sky Temperature Schedule Name");
  append_field(text, factor_text(parts[1]), "Ground View Factor");
  append_field(text, "", "Ground Temperature Schedule Name");
  append_surrounding(text, parts);
}

}  // namespace

void write_energyplus_idf(std::span<const SurfaceMean> surfaces, std::span<const std::string> columns,
                          const std::filesystem::path& path) {
  std::string text = fmt::format(
      "! What surfaces see, by Far-LoD {}, to stand behind a model of EnergyPlus. Its exterior surfaces have these\n"
      "! names, and it defines the schedules of temperatures (Far-LoD ... Temperature), in degrees Celsius.\n",
      software_version);
  for (const IdfSurface& surface : idf_surfaces(surfaces, columns)) append_surface(text, surface);
  write_atomically(path, [&](std::ostream& out) { out << text; });
}

}  // namespace farlod
