// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "package/sources_layout.hpp"
#include "reading.hpp"

namespace farlod::ingest::test {

/// "0+2"
inline std::string sum_of(const std::set<std::uint32_t>& numbers) {
  std::string text;
  for (const std::uint32_t number : numbers) text += (text.empty() ? "" : "+") + std::to_string(number);
  return text;
}

inline IngestSettings in_lod(int lod) {
  IngestSettings settings;
  settings.lod.exactly = lod;
  return settings;
}

inline std::string attribute_text(const AttributeForm& form, const std::string& name, const std::string& value) {
  return form.before_all + form.before_name + name + form.before_value + value + form.behind_value + form.behind_all;
}

/// The text of a file with an attribute at each place that its reader tells: a building has its `id`, any other object the
/// numbers of its `surfaces`, and so has each semantic surface of them.
inline std::string marked(const std::filesystem::path& file, const IngestSettings& settings = {}) {
  const Reading reading = read_file(file, settings);
  std::map<std::uint64_t, std::string, std::greater<>> marks;
  const std::optional<PlacedFile>& placed = reading.source.placed;
  const auto mark = [&](const AttributePlace& place, const std::string& name, const std::string& value) {
    if (place.form != 0) marks[place.at] += attribute_text(placed->forms.at(place.form - 1), name, value);
  };
  for (const Building& building : reading.city().buildings()) {
    const auto origin = package::origin_from(reading.city().origin_of(building));
    if (!placed || !origin) {
      ADD_FAILURE() << "the reader tells no places of " << building.id;
      continue;
    }
    std::map<std::uint32_t, std::set<std::uint32_t>> of_objects, of_semantics;
    for (const SurfaceOrigin& surface : origin->surfaces) {
      of_objects[surface.object].insert(surface.surface);
      if (surface.semantics) of_semantics[*surface.semantics].insert(surface.surface);
    }
    mark(origin->objects.front(), "id", building.id);
    for (const auto& [object, surfaces] : of_objects)
      if (object != 0) mark(origin->objects[object], "surfaces", sum_of(surfaces));
    for (const auto& [row, surfaces] : of_semantics) mark(origin->semantics[row], "surfaces", sum_of(surfaces));
  }
  std::string text = scenes::text_of(file);
  for (const auto& [at, inserted] : marks) text.insert(at, inserted);
  return text;
}

inline std::string marked_text(const std::string& name, const std::string& text, const IngestSettings& settings = {}) {
  return marked(write_file(name, text), settings);
}

}  // namespace farlod::ingest::test
