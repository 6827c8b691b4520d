// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/obj/obj_classes.hpp"

#include <algorithm>
#include <array>

#include "base/lower_case.hpp"

namespace farlod::ingest {
namespace {

using namespace std::string_view_literals;

constexpr std::array ground_names{"terrain"sv, "ground"sv, "relief"sv, "tinrelief"sv, "dtm"sv,       "dem"sv,
                                  "landuse"sv, "road"sv,   "roads"sv,  "water"sv,     "waterbody"sv, "transportation"sv};
constexpr std::array other_names{"tree"sv,       "trees"sv,         "forest"sv,
                                 "vegetation"sv, "plantcover"sv,    "solitaryvegetationobject"sv,
                                 "furniture"sv,  "cityfurniture"sv, "separation"sv};

/// The first word of a name of which nothing else is a word: numbers and signs may follow.
std::string only_word_of(std::string_view name) {
  const std::string lower = lower_case(std::string(name));
  const auto is_letter = [](char c) { return 'a' <= c && c <= 'z'; };
  const auto end = std::find_if_not(lower.begin(), lower.end(), is_letter);
  return std::any_of(end, lower.end(), is_letter) ? "" : std::string(lower.begin(), end);
}

std::vector<ObjClass> classes_of(const std::vector<std::string>& names) {
  std::vector<ObjClass> classes;
  for (const std::string& name : names) classes.push_back(class_of_name(name));
  return classes;
}

}  // namespace

ObjClass class_of_name(std::string_view name) {
  const std::string word = only_word_of(name);
  if (std::ranges::find(ground_names, word) != ground_names.end()) return ObjClass::ground;
  return std::ranges::find(other_names, word) != other_names.end() ? ObjClass::other : ObjClass::building;
}

ObjClasses::ObjClasses(const ObjMesh& mesh)
    : mesh_(mesh), objects_(classes_of(mesh.objects)), groups_(classes_of(mesh.groups)), materials_(classes_of(mesh.materials)) {}

ObjClass ObjClasses::of(const ObjFace& face) const {
  if (objects_[face.object] != ObjClass::building) return objects_[face.object];
  if (groups_[face.group] != ObjClass::building) return groups_[face.group];
  return materials_[face.material];
}

std::string ObjClasses::name_of(const ObjFace& face) const {
  if (objects_[face.object] != ObjClass::building) return only_word_of(mesh_.objects[face.object]);
  if (groups_[face.group] != ObjClass::building) return only_word_of(mesh_.groups[face.group]);
  return only_word_of(mesh_.materials[face.material]);
}

}  // namespace farlod::ingest
