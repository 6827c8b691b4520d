// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/mesh/mesh_classes.hpp"

#include <algorithm>
#include <array>

#include "base/lower_case.hpp"

namespace farlod::ingest {
namespace {

using namespace std::string_view_literals;

constexpr std::array known_ground_names{"terrain"sv,  "ground"sv, "relief"sv,  "tinrelief"sv, "dtm"sv,       "dem"sv,
                                        "landuse"sv,  "road"sv,   "roads"sv,   "water"sv,     "waterbody"sv, "transportation"sv,
                                        "grass"sv,    "street"sv, "streets"sv, "sidewalk"sv,  "pavement"sv,  "gelände"sv,
                                        "gelaende"sv, "wasser"sv, "straße"sv,  "strasse"sv,   "boden"sv};
/// Words that say of what kind a geometry is, beside the name of what it shows: Terrain_mesh, water surface.
constexpr std::array words_of_geometry{"mesh"sv, "surface"sv, "surfaces"sv, "plane"sv,
                                       "tin"sv,  "model"sv,   "polygons"sv, "layer"sv};
constexpr std::array other_names{"tree"sv,       "trees"sv,         "forest"sv,
                                 "vegetation"sv, "plantcover"sv,    "solitaryvegetationobject"sv,
                                 "furniture"sv,  "cityfurniture"sv, "separation"sv};

/// Bytes beyond ASCII are letters of other scripts, in UTF-8.
bool is_letter_of_a_name(char c) { return ('a' <= c && c <= 'z') || (c & 0x80) != 0; }

/// The first word of a name of which nothing else is a word but one of a geometry: numbers and signs may follow.
std::string only_word_of(std::string_view name) {
  const std::string lower = lower_case(name);
  const auto end = std::find_if_not(lower.begin(), lower.end(), is_letter_of_a_name);
  const auto second = std::find_if(end, lower.end(), is_letter_of_a_name);
  const auto behind = std::find_if_not(second, lower.end(), is_letter_of_a_name);
  const bool is_alone =
      second == lower.end() || std::ranges::find(words_of_geometry, std::string(second, behind)) != words_of_geometry.end();
  return is_alone && std::none_of(behind, lower.end(), is_letter_of_a_name) ? std::string(lower.begin(), end) : "";
}

/// Whether a name is that of a user, behind which numbers and signs may follow. The user's may have several words.
bool is_called(std::string_view name, const std::string& by_user) {
  const std::string lower = lower_case(name), wanted = lower_case(by_user);
  return lower.starts_with(wanted) &&
         std::none_of(lower.begin() + static_cast<std::ptrdiff_t>(wanted.size()), lower.end(), is_letter_of_a_name);
}

std::vector<MeshClass> classes_of(const std::vector<std::string>& names, std::span<const std::string> ground_names) {
  std::vector<MeshClass> classes;
  for (const std::string& name : names) classes.push_back(class_of_name(name, ground_names));
  return classes;
}

}  // namespace

MeshClass class_of_name(std::string_view name, std::span<const std::string> ground_names) {
  const std::string word = only_word_of(name);
  const auto is_called_so = [&](const std::string& by_user) { return is_called(name, by_user); };
  if (std::ranges::find(known_ground_names, word) != known_ground_names.end() || std::ranges::any_of(ground_names, is_called_so))
    return MeshClass::ground;
  return std::ranges::find(other_names, word) != other_names.end() ? MeshClass::other : MeshClass::building;
}

std::vector<std::string> met_names(const Mesh& mesh, std::span<const std::string> ground_names) {
  std::vector<std::string> met;
  for (const std::string& wanted : ground_names) {
    const auto is_met = [&](const std::string& name) { return is_called(name, wanted); };
    if (std::ranges::any_of(mesh.objects, is_met) || std::ranges::any_of(mesh.groups, is_met) ||
        std::ranges::any_of(mesh.materials, is_met))
      met.push_back(wanted);
  }
  return met;
}

MeshClasses::MeshClasses(const Mesh& mesh, std::span<const std::string> ground_names)
    : mesh_(mesh),
      objects_(classes_of(mesh.objects, ground_names)),
      groups_(classes_of(mesh.groups, ground_names)),
      materials_(classes_of(mesh.materials, ground_names)) {}

MeshClass MeshClasses::of(const MeshFace& face) const {
  if (objects_[face.object] != MeshClass::building) return objects_[face.object];
  if (groups_[face.group] != MeshClass::building) return groups_[face.group];
  return materials_[face.material];
}

std::string MeshClasses::name_of(const MeshFace& face) const {
  const bool is_object = objects_[face.object] != MeshClass::building, is_group = groups_[face.group] != MeshClass::building;
  const std::string& name = is_object  ? mesh_.objects[face.object]
                            : is_group ? mesh_.groups[face.group]
                                       : mesh_.materials[face.material];
  const std::string word = only_word_of(name);
  return word.empty() ? name : word;
}

}  // namespace farlod::ingest
