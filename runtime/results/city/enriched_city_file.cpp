// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/enriched_city_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "results/city/surface_attributes.hpp"

namespace farlod {
namespace {

/// Slivers have no normal worth the name, and a polygon that is bent has more area than its plan. All others match.
constexpr double least_share_of_matches = 0.95;
/// The package's projection stretches lengths by a few thousandths at most.
constexpr double relative_area_tolerance = 0.02, area_tolerance_m2 = 0.05, steepness_tolerance = 0.02;
constexpr double metres_per_foot = 0.3048;

/// The means of a run by building.
class MeansByBuilding {
 public:
  explicit MeansByBuilding(const SurfaceMeans& means) {
    for (const SurfaceMean& surface : means.surfaces) surfaces_[surface.building].push_back(&surface);
    for (const BuildingMean& building : means.buildings) buildings_.emplace(building.building, &building);
  }
  [[nodiscard]] const std::vector<const SurfaceMean*>& surfaces_of(const std::string& building) const {
    static const std::vector<const SurfaceMean*> none;
    const auto found = surfaces_.find(building);
    return found == surfaces_.end() ? none : found->second;
  }
  [[nodiscard]] const BuildingMean* mean_of_building(const std::string& building) const {
    const auto found = buildings_.find(building);
    return found == buildings_.end() ? nullptr : found->second;
  }

 private:
  std::unordered_map<std::string_view, std::vector<const SurfaceMean*>> surfaces_;
  std::unordered_map<std::string_view, const BuildingMean*> buildings_;
};

/// Texts to insert, by their places.
using Insertions = std::map<std::size_t, std::string>;

/// What becomes of a file, if its package was made of one level of detail.
struct Enrichment {
  Insertions insertions;
  std::size_t surfaces = 0, matching = 0, without_semantics = 0, without_place = 0;
  std::size_t buildings = 0, repeated_buildings = 0, other_buildings = 0;
  [[nodiscard]] bool fits() const {
    return static_cast<double>(matching) >= least_share_of_matches * static_cast<double>(surfaces);
  }
};

class Enriching {
 public:
  Enriching(const CityFile& city, const SurfaceMeans& means, const AnswerColumns& columns, EnrichedExtent extent)
      : city_(city), means_(means), columns_(columns), extent_(extent), has_degrees_(city.has_degrees()) {}

  [[nodiscard]] Enrichment of(PackedLod lod) {
    result_ = {};
    city_.for_each_building(lod, [this](const FileBuilding& building) { add(building); });
    return std::move(result_);
  }

 private:
  /// The surfaces of a building of the run, each with its polygons in the file.
  using FoundSurfaces = std::vector<std::pair<const SurfaceMean*, std::vector<const NumberedPolygon*>>>;

  void add(const FileBuilding& building) {
    const std::vector<const SurfaceMean*>& surfaces = means_.surfaces_of(building.id);
    if (surfaces.empty()) return;
    // The run has one row for all that have this id
    if (city_.repeated_ids().contains(building.id)) {
      ++result_.repeated_buildings;
      return;
    }
    const FoundSurfaces found = found_surfaces(building, surfaces);
    const auto matching = static_cast<std::size_t>(
        std::ranges::count_if(found, [&](const auto& entry) { return matches(*entry.first, *entry.second.front(), building); }));
    result_.surfaces += surfaces.size();
    result_.matching += matching;
    if (2 * matching < surfaces.size())
      ++result_.other_buildings;
    else
      enrich(building, found);
  }

  static FoundSurfaces found_surfaces(const FileBuilding& building, const std::vector<const SurfaceMean*>& surfaces) {
    std::unordered_map<std::uint32_t, std::vector<const NumberedPolygon*>> polygons;
    for (const NumberedPolygon& polygon : building.polygons) polygons[polygon.number].push_back(&polygon);
    FoundSurfaces found;
    for (const SurfaceMean* surface : surfaces)
      if (const auto same = polygons.find(surface->surface); same != polygons.end()) found.emplace_back(surface, same->second);
    return found;
  }

  void enrich(const FileBuilding& building, const FoundSurfaces& found) {
    ++result_.buildings;
    std::map<std::size_t, std::vector<const SurfaceMean*>> by_semantics, by_object;
    for (const auto& [surface, polygons] : found) {
      by_object[polygons.front()->object].push_back(surface);
      add_semantics(*surface, polygons, by_semantics);
    }
    for (const auto& [row, rows] : by_semantics) insert(building.semantics[row].place, attributes_of(rows, columns_));
    add_to_objects(building, by_object);
  }

  /// A polygon that the file has twice has two semantic surfaces, and both get its values.
  void add_semantics(const SurfaceMean& surface, const std::vector<const NumberedPolygon*>& polygons,
                     std::map<std::size_t, std::vector<const SurfaceMean*>>& by_semantics) {
    std::set<std::size_t> rows;
    for (const NumberedPolygon* polygon : polygons)
      if (polygon->semantics) rows.insert(*polygon->semantics);
    for (const std::size_t row : rows) by_semantics[row].push_back(&surface);
    result_.without_semantics += rows.empty() ? 1 : 0;
  }

  void add_to_objects(const FileBuilding& building, const std::map<std::size_t, std::vector<const SurfaceMean*>>& by_object) {
    if (const BuildingMean* mean = means_.mean_of_building(building.id))
      insert(building.objects.front(), attributes_of(*mean, columns_));
    for (const auto& [object, rows] : by_object)
      if (object != 0) insert(building.objects[object], attributes_of(mean_of(rows), columns_));
  }

  void insert(const std::optional<AttributePlace>& place, const CityAttributes& attributes) {
    if (attributes.empty()) return;
    if (place)
      result_.insertions[place->at] += city_.text_of(attributes, place->form);
    else
      ++result_.without_place;
  }

  [[nodiscard]] bool matches(const SurfaceMean& surface, const NumberedPolygon& polygon, const FileBuilding& building) const {
    const SurfaceKind kind = polygon.semantics ? building.semantics[*polygon.semantics].kind : SurfaceKind::unknown;
    if (kind != SurfaceKind::unknown && kind != surface.kind) return false;
    if (has_degrees_) return true;
    return std::abs(std::abs(cos(surface.tilt)) - polygon.steepness) <= steepness_tolerance &&
           (has_area(surface, polygon.area) || has_area(surface, polygon.area * metres_per_foot * metres_per_foot));
  }

  [[nodiscard]] bool has_area(const SurfaceMean& surface, double area_m2) const {
    const double found_m2 = surface.area_m2 + surface.covered_area_m2;
    const double tolerance_m2 = relative_area_tolerance * area_m2 + area_tolerance_m2;
    return found_m2 <= area_m2 + tolerance_m2 &&
           (extent_ == EnrichedExtent::part_of_the_city || found_m2 >= area_m2 - tolerance_m2);
  }

  const CityFile& city_;
  MeansByBuilding means_;
  const AnswerColumns& columns_;
  EnrichedExtent extent_;
  bool has_degrees_;
  Enrichment result_;
};

/// "3 surfaces", "1 surface".
std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::vector<std::string> notes_of(const Enrichment& enrichment) {
  std::vector<std::string> notes;
  if (enrichment.buildings == 0) notes.emplace_back("No building of the file gets values: it comes back as it was.");
  if (enrichment.without_semantics > 0)
    notes.push_back(counted(enrichment.without_semantics, "surface") +
                    " with values have no semantics of their own in the file: only their buildings get values.");
  if (enrichment.repeated_buildings > 0)
    notes.push_back(counted(enrichment.repeated_buildings, "building") +
                    " share their ids with others of the file, and get no values.");
  if (enrichment.other_buildings > 0)
    notes.push_back(counted(enrichment.other_buildings, "building") + (enrichment.other_buildings == 1 ? " has" : " have") +
                    " other surfaces in the package than in this file, and no values: is the same id in another file, too?");
  if (enrichment.without_place > 0)
    notes.push_back(counted(enrichment.without_place, "object") +
                    " have no place for attributes in the file, and get no values.");
  return notes;
}

void write_with(const std::string& text, const Insertions& insertions, std::ostream& out) {
  std::size_t done = 0;
  for (const auto& [place, inserted] : insertions) {
    out.write(text.data() + done, static_cast<std::streamsize>(place - done));
    out << inserted;
    done = place;
  }
  out.write(text.data() + done, static_cast<std::streamsize>(text.size() - done));
}

void require_none_of(const std::vector<std::string>& taken, const std::vector<std::string>& names, const FileBuilding& building,
                     const std::filesystem::path& path) {
  for (const std::string& name : names)
    if (std::ranges::count(taken, name) > 0)
      throw InputError(path.string() + ": the building " + building.id + " has the attribute " + name +
                       " already. Give the file as it was before it had view factors.");
}

void require_free_names(const CityFile& city, const AnswerColumns& columns, const std::filesystem::path& path) {
  const std::vector<std::string> of_surfaces = attribute_names_of_surfaces(columns);
  const std::vector<std::string> of_buildings = attribute_names_of_buildings(columns);
  city.for_each_building({}, [&](const FileBuilding& building) {
    require_none_of(building.names_of_objects, of_buildings, building, path);
    require_none_of(building.names_of_surfaces, of_surfaces, building, path);
  });
}

}  // namespace

EnrichedCityFile::EnrichedCityFile(const std::filesystem::path& city, AnswerColumns columns)
    : path_(city), columns_(std::move(columns)), city_(read_city(city)) {
  telling_file(path_, [this] { require_free_names(*city_.file, columns_, path_); });
}

void EnrichedCityFile::require_fitting(const std::filesystem::path& output) const {
  if (city_format_of(output) != city_.format)
    throw OutputError(output, path_.string() + " is " + name_of(city_.format) +
                                  ", and comes back as such: choose a name that ends in " + endings_of(city_.format));
}

std::vector<std::string> EnrichedCityFile::write(const SurfaceMeans& means, EnrichedExtent extent,
                                                 const std::filesystem::path& output) const {
  Enriching enriching(*city_.file, means, columns_, extent);
  for (const PackedLod lod : {PackedLod(), PackedLod(3), PackedLod(2), PackedLod(1)}) {
    Enrichment enrichment;
    telling_file(path_, [&] { enrichment = enriching.of(lod); });
    if (!enrichment.fits()) continue;
    write_atomically(output, [&](std::ostream& out) { write_with(city_.file->text(), enrichment.insertions, out); });
    return notes_of(enrichment);
  }
  throw InputError(
      "The surfaces of the package cannot be found again in " + path_.string() +
      " by their numbers, tilts and areas. A package of LoD 0 (--lod 0) has other surfaces than its file: write CSV.");
}

}  // namespace farlod
