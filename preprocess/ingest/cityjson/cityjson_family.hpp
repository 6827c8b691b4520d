// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ingest/cityjson/cityjson_objects.hpp"

namespace farlod::ingest {

enum class ObjectRole { none, building, part, installation, element, relief };

[[nodiscard]] inline ObjectRole role_of(std::string_view type) {
  if (type == "TINRelief") return ObjectRole::relief;
  if (type == "OtherConstruction") return ObjectRole::building;
  for (const std::string_view kind : {"Building", "Bridge", "Tunnel"}) {
    if (!type.starts_with(kind)) continue;
    const std::string_view rest = type.substr(kind.size());
    if (rest.empty()) return ObjectRole::building;
    if (rest == "Part") return ObjectRole::part;
    if (rest == "Installation") return ObjectRole::installation;
    // CityJSON 1.0 says ConstructionElement
    if (rest == "ConstructiveElement" || rest == "ConstructionElement") return ObjectRole::element;
  }
  return ObjectRole::none;
}

[[nodiscard]] inline bool hides_the_sky(const CityJsonObject& object) {
  const ObjectRole role = role_of(object.type);
  return role != ObjectRole::none && role != ObjectRole::relief;
}

/// The hierarchy of objects, which files give in `children`, in `parents`, or in both.
class CityJsonFamily {
 public:
  explicit CityJsonFamily(const std::vector<CityJsonObject>& objects)
      : objects_(objects), children_(objects.size()), has_parent_(objects.size()) {
    for (std::size_t k = 0; k < objects.size(); ++k) row_of_.try_emplace(objects[k].id, k);
    for (std::size_t k = 0; k < objects.size(); ++k) {
      for (const std::string& child : objects[k].children) link(k, find(child));
      for (const std::string& parent : objects[k].parents)
        if (const auto row = find(parent)) link(*row, k);
    }
  }

  std::optional<std::size_t> find(const std::string& id) const {
    const auto found = row_of_.find(id);
    return found == row_of_.end() ? std::nullopt : std::optional(found->second);
  }
  const std::set<std::size_t>& children_of(std::size_t k) const { return children_[k]; }
  bool has_parent(std::size_t k) const { return has_parent_[k]; }

 private:
  void link(std::size_t parent, std::optional<std::size_t> child) {
    // Only objects that hide the sky are parents here: a building in a CityObjectGroup has no parent
    if (!child || *child == parent || !hides_the_sky(objects_[parent])) return;
    children_[parent].insert(*child);
    has_parent_[*child] = true;
  }

  const std::vector<CityJsonObject>& objects_;
  std::unordered_map<std::string, std::size_t> row_of_;
  std::vector<std::set<std::size_t>> children_;
  std::vector<bool> has_parent_;
};

}  // namespace farlod::ingest
