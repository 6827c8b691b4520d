// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/enriched_city_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "results/atomic_file.hpp"
#include "results/output_format.hpp"
#include "results/provenance.hpp"
#include "results/table/area_columns.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

/// Names and decimal numbers. What has no answer, or was not asked for, is not among them.
using CityAttributes = std::vector<std::pair<std::string, std::string>>;

void add_svf(CityAttributes& attributes, const std::string& name, std::optional<double> value) {
  if (value) attributes.emplace_back(name, svf_decimal(*value));
}

void add_area(CityAttributes& attributes, const std::string& name, double area_m2) {
  std::string text;
  append_millimetres(text, area_m2);
  attributes.emplace_back(name, std::move(text));
}

void add_area_columns(CityAttributes& attributes, const std::vector<AreaColumn>& columns) {
  for (const AreaColumn& column : columns) {
    if (std::isnan(column.value)) continue;
    if (column.form == NumberForm::rounded)
      add_area(attributes, column.name, column.value);
    else
      attributes.emplace_back(column.name, shortest_decimal(static_cast<float>(column.value)));
  }
}

void take_extreme(std::optional<double>& extreme, std::optional<double> value, bool (*is_better)(double, double)) {
  if (value && (!extreme || is_better(*value, *extreme))) extreme = value;
}

/// Adds the values of `next`; means are sums until `divide` has divided them.
void add(SurfaceMean& sum, const SurfaceMean& next) {
  sum.area_m2 += next.area_m2;
  sum.covered_area_m2 += next.covered_area_m2;
  take_extreme(sum.svf_min, next.svf_min, [](double a, double b) { return a < b; });
  take_extreme(sum.svf_max, next.svf_max, [](double a, double b) { return a > b; });
  if (next.svf_mean) sum.svf_mean = sum.svf_mean.value_or(0.0) + next.area_m2 * *next.svf_mean;
  if (sum.further_mean.empty()) sum.further_mean.resize(next.further_mean.size());
  for (std::size_t k = 0; k < next.further_mean.size(); ++k) sum.further_mean[k] += next.area_m2 * next.further_mean[k];
  if (!next.irradiation) return;
  if (!sum.irradiation) sum.irradiation.emplace();
  sum.irradiation->kwh += next.irradiation->kwh;
  if (const auto& above_m2 = next.irradiation->area_above_m2)
    sum.irradiation->area_above_m2 = sum.irradiation->area_above_m2.value_or(0.0) + *above_m2;
}

void divide(SurfaceMean& sum) {
  if (sum.svf_mean) *sum.svf_mean /= sum.area_m2;
  for (double& mean : sum.further_mean) mean /= sum.area_m2;
}

SurfaceMean merged(std::span<const SurfaceMean* const> surfaces) {
  // The mean of one is its own to the last digit
  if (surfaces.size() == 1) return *surfaces.front();
  SurfaceMean sum;
  for (const SurfaceMean* surface : surfaces) add(sum, *surface);
  divide(sum);
  return sum;
}

/// The names that attributes of surfaces, and those of buildings, may have.
std::vector<std::string> attribute_names_of_surfaces(const AnswerColumns& columns) {
  const std::string& q = columns.quantity;
  std::vector<std::string> names{q + "_mean", q + "_min", q + "_max", "svf_area_m2", "covered_area_m2"};
  for (const AreaColumn& column : area_columns_of(SurfaceMean{}, columns)) names.push_back(column.name);
  return names;
}

std::vector<std::string> attribute_names_of_buildings(const AnswerColumns& columns) {
  const std::string& q = columns.quantity;
  std::vector<std::string> names{q + "_roofs",   q + "_walls",           "roof_area_m2",
                                 "wall_area_m2", "covered_roof_area_m2", "covered_wall_area_m2"};
  for (const AreaColumn& column : area_columns_of(BuildingMean{}, columns)) names.push_back(column.name);
  return names;
}

/// The attributes of one surface of a city file that is made of these: means are weighted by area, areas are added. Where it is
/// one, the numbers are those of its row in the table of surfaces.
CityAttributes attributes_of(std::span<const SurfaceMean* const> surfaces, const AnswerColumns& columns) {
  const SurfaceMean mean = merged(surfaces);
  const std::vector<std::string> names = attribute_names_of_surfaces(columns);
  CityAttributes attributes;
  add_svf(attributes, names[0], mean.svf_mean);
  add_svf(attributes, names[1], mean.svf_min);
  add_svf(attributes, names[2], mean.svf_max);
  add_area(attributes, names[3], mean.area_m2);
  add_area(attributes, names[4], mean.covered_area_m2);
  add_area_columns(attributes, area_columns_of(mean, columns));
  return attributes;
}

/// The numbers of its row in the table of buildings. Areas of roofs (walls) are left out where no roof (wall) has a receiver.
CityAttributes attributes_of(const BuildingMean& building, const AnswerColumns& columns) {
  const std::vector<std::string> names = attribute_names_of_buildings(columns);
  CityAttributes attributes;
  add_svf(attributes, names[0], building.svf_roofs);
  add_svf(attributes, names[1], building.svf_walls);
  const BuildingAreas areas = areas_of(building);
  if (areas.roofs_m2) add_area(attributes, names[2], *areas.roofs_m2);
  if (areas.walls_m2) add_area(attributes, names[3], *areas.walls_m2);
  if (areas.covered_roofs_m2) add_area(attributes, names[4], *areas.covered_roofs_m2);
  if (areas.covered_walls_m2) add_area(attributes, names[5], *areas.covered_walls_m2);
  add_area_columns(attributes, area_columns_of(building, columns));
  return attributes;
}

/// The means of a part of a building that has these surfaces.
BuildingMean mean_of(std::span<const SurfaceMean* const> surfaces) {
  SurfaceMean roofs, walls;
  for (const SurfaceMean* surface : surfaces) add(surface->kind == SurfaceKind::roof ? roofs : walls, *surface);
  divide(roofs);
  divide(walls);
  BuildingMean mean;
  mean.roof_area_m2 = roofs.area_m2;
  mean.wall_area_m2 = walls.area_m2;
  mean.covered_roof_area_m2 = roofs.covered_area_m2;
  mean.covered_wall_area_m2 = walls.covered_area_m2;
  mean.svf_roofs = roofs.svf_mean;
  mean.svf_walls = walls.svf_mean;
  mean.further_roofs = std::move(roofs.further_mean);
  mean.further_walls = std::move(walls.further_mean);
  mean.roof_irradiation = roofs.irradiation;
  mean.wall_irradiation = walls.irradiation;
  return mean;
}

/// The first version of packages that says where surfaces come from.
constexpr std::uint32_t first_version_with_sources = 10;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

std::ifstream opened(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(why_unread(path));
  return file;
}

/// Up to so many bytes of a file.
std::string next_bytes(std::ifstream& file, std::uint64_t count) {
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(count, piece_bytes)), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

/// Whether the text has two bytes a character, so that no byte of an attribute would fit.
bool is_utf16(const std::filesystem::path& path) {
  std::ifstream file = opened(path);
  const std::string beginning = next_bytes(file, 2);
  return beginning == "\xff\xfe" || beginning == "\xfe\xff" || beginning.find('\0') != beginning.npos;
}

/// The means of a run by building.
class MeansByBuilding {
 public:
  explicit MeansByBuilding(const SurfaceMeans& means) {
    for (const SurfaceMean& surface : means.surfaces) surfaces_[surface.building].push_back(&surface);
    for (const BuildingMean& building : means.buildings)
      for (const std::uint32_t number : building.building_numbers) buildings_.emplace(number, &building);
  }
  [[nodiscard]] const std::vector<const SurfaceMean*>& surfaces_of(const BuildingMean& building) const {
    return surfaces_.at(building.building);
  }
  /// Null where the run has none.
  [[nodiscard]] const BuildingMean* find(std::uint32_t building) const {
    const auto found = buildings_.find(building);
    return found == buildings_.end() ? nullptr : found->second;
  }

 private:
  std::unordered_map<std::string_view, std::vector<const SurfaceMean*>> surfaces_;
  std::unordered_map<std::uint32_t, const BuildingMean*> buildings_;
};

std::string text_of(const CityAttributes& attributes, const AttributeForm& form) {
  std::string text = form.before_all;
  for (const auto& [name, value] : attributes) {
    if (text.size() > form.before_all.size()) text += form.between;
    text.append(form.before_name).append(name).append(form.before_value).append(value).append(form.behind_value);
  }
  return text + form.behind_all;
}

/// Collects texts to insert, building by building. Those that share an id have their rows together, and get none.
class Enriching {
 public:
  Enriching(const PackedCityFile& file, const SurfaceMeans& means, const AnswerColumns& columns)
      : file_(file), means_(means), columns_(columns) {}

  void add(std::uint32_t number, const BuildingOrigin& origin) {
    const BuildingMean* building = means_.find(number);
    if (building == nullptr) return;
    if (building->building_numbers.size() > 1) {
      ++repeated_buildings_;
      return;
    }
    ++buildings_;
    insert(origin.objects.front(), attributes_of(*building, columns_));
    SurfacesOf by_semantics, by_object;
    for (const SurfaceMean* surface : means_.surfaces_of(*building)) sort_in(*surface, origin, by_semantics, by_object);
    for (const auto& [row, surfaces] : by_semantics) insert(origin.semantics[row], attributes_of(surfaces, columns_));
    for (const auto& [object, surfaces] : by_object)
      if (object != 0) insert(origin.objects[object], attributes_of(mean_of(surfaces), columns_));
  }

  /// By their places.
  [[nodiscard]] const std::map<std::uint64_t, std::string>& insertions() const { return insertions_; }
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  using SurfacesOf = std::map<std::uint32_t, std::vector<const SurfaceMean*>>;

  /// A polygon that the file has twice may be of two semantic surfaces, and both get its values.
  void sort_in(const SurfaceMean& surface, const BuildingOrigin& origin, SurfacesOf& by_semantics, SurfacesOf& by_object) {
    const auto first = std::ranges::lower_bound(origin.surfaces, surface.surface, {}, &SurfaceOrigin::surface);
    const auto last = std::ranges::upper_bound(origin.surfaces, surface.surface, {}, &SurfaceOrigin::surface);
    by_object[first == last ? 0 : first->object].push_back(&surface);
    bool has_semantics = false;
    for (auto of = first; of != last; ++of) {
      if (!of->semantics) continue;
      has_semantics = true;
      std::vector<const SurfaceMean*>& surfaces = by_semantics[*of->semantics];
      if (surfaces.empty() || surfaces.back() != &surface) surfaces.push_back(&surface);
    }
    without_semantics_ += has_semantics ? 0 : 1;
  }

  void insert(const AttributePlace& place, const CityAttributes& attributes) {
    if (attributes.empty()) return;
    if (place.form == 0)
      ++without_place_;
    else
      insertions_[place.at] += text_of(attributes, file_.forms[place.form - 1]);
  }

  const PackedCityFile& file_;
  MeansByBuilding means_;
  const AnswerColumns& columns_;
  std::map<std::uint64_t, std::string> insertions_;
  std::size_t buildings_ = 0, repeated_buildings_ = 0, without_semantics_ = 0, without_place_ = 0;
};

/// "3 surfaces", "1 surface".
std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::vector<std::string> Enriching::notes() const {
  std::vector<std::string> notes;
  if (buildings_ == 0) notes.emplace_back("No building of the file gets values: it comes back as it was.");
  if (without_semantics_ > 0)
    notes.push_back(counted(without_semantics_, "surface") +
                    " with values have no semantics of their own in the file: only their buildings get values.");
  if (repeated_buildings_ > 0)
    notes.push_back(counted(repeated_buildings_, "building") +
                    (repeated_buildings_ == 1 ? " shares its id with others of the package, and gets no values."
                                              : " share their ids with others of the package, and get no values."));
  if (without_place_ > 0)
    notes.push_back(counted(without_place_, "object") + (without_place_ == 1
                                                             ? " has no place for attributes in the file, and gets no values."
                                                             : " have no place for attributes in the file, and get no values."));
  return notes;
}

/// Copies a file, with texts inserted.
void copy_with(const std::map<std::uint64_t, std::string>& insertions, std::ifstream file, std::ostream& out) {
  std::uint64_t done = 0;
  const auto copy_up_to = [&](std::uint64_t end) {
    while (done < end) {
      const std::string bytes = next_bytes(file, end - done);
      if (bytes.empty()) return;
      out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      done += bytes.size();
    }
  };
  for (const auto& [place, text] : insertions) {
    copy_up_to(place);
    out << text;
  }
  copy_up_to(std::numeric_limits<std::uint64_t>::max());
}

/// Whether a name stands in a text as that of an attribute may: within quotes, or between tags.
bool has_name(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    if (at == 0 || at + name.size() >= text.size()) continue;
    const char before = text[at - 1], behind = text[at + name.size()];
    if ((before == '"' && behind == '"') || (before == '\'' && behind == '\'') || (before == '>' && behind == '<')) return true;
  }
  return false;
}

}  // namespace

EnrichedCityFile::EnrichedCityFile(const Package& package, const std::string& package_name, std::filesystem::path city,
                                   AnswerColumns columns)
    : path_(std::move(city)), columns_(std::move(columns)), xxh3_(xxh3_of_file(path_)) {
  if (xxh3_.empty()) throw InputError(why_unread(path_));
  const PackageInventory inventory = inventory_of(package);
  if (std::ranges::none_of(inventory.inputs, [this](const PackedInput& input) { return is_this_file(input); }))
    throw InputError(path_.string() + " is not a file that " + package_name +
                     " was made of: its checksum is not in the manifest. Give the file as it was packed, or pack this one.");
  if (inventory.format_version < first_version_with_sources)
    throw InputError(package_name + " has format version " + std::to_string(inventory.format_version) +
                     ", which does not say where its surfaces are in " + path_.string() + ": pack the file again.");
  const std::vector<PackedCityFile> files = city_files_of(package);
  const auto packed = std::ranges::find_if(files, [this](const PackedCityFile& file) { return is_this_file(file.input); });
  if (packed == files.end() && is_utf16(path_))
    throw InputError(path_.string() + " is UTF-16: convert it to UTF-8 and pack it again");
  if (packed == files.end())
    throw InputError(path_.string() +
                     " has no places for attributes: only CityGML and CityJSON files come back with values. If it is an archive, "
                     "pack the file that is in it.");
  packed_ = *packed;
  require_free_names();
}

bool EnrichedCityFile::is_this_file(const PackedInput& input) const { return fmt::format("{:016x}", input.xxh3) == xxh3_; }

void EnrichedCityFile::require_free_names() const {
  std::vector<std::string> names = attribute_names_of_surfaces(columns_);
  for (std::string& name : attribute_names_of_buildings(columns_)) names.push_back(std::move(name));
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  std::ifstream file = opened(path_);
  std::string text;
  for (std::string piece = next_bytes(file, piece_bytes); !piece.empty(); piece = next_bytes(file, piece_bytes)) {
    // A name may begin in the piece before
    text.erase(0, text.size() - std::min(text.size(), longest + 1));
    text += piece;
    for (const std::string& name : names)
      if (has_name(text, name))
        throw InputError(path_.string() + " has the name " + name +
                         " already, as if it had values: give the file as it was before it had view factors.");
  }
}

void EnrichedCityFile::require_fitting(const std::filesystem::path& output) const {
  if (city_format_of(output) != packed_.format)
    throw OutputError(output, path_.string() + " is " + name_of(packed_.format) +
                                  ", and comes back as such: choose a name that ends in " + endings_of(packed_.format));
}

std::vector<std::string> EnrichedCityFile::write(const Package& package, const SurfaceMeans& means,
                                                 const std::filesystem::path& output) const {
  if (xxh3_of_file(path_) != xxh3_) throw InputError(path_.string() + " has changed since the run began: pack it again.");
  Enriching enriching(packed_, means, columns_);
  const std::vector<PackedCityFile> files = city_files_of(package);
  visit_origins(package, [&](std::uint32_t building, std::size_t file, const BuildingOrigin& origin) {
    if (is_this_file(files[file].input)) enriching.add(building, origin);
  });
  write_atomically(output, [&](std::ostream& out) { copy_with(enriching.insertions(), opened(path_), out); });
  return enriching.notes();
}

}  // namespace farlod
