// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "results/city/city_file.hpp"
#include "results/city/citygml_places.hpp"
#include "results/city/citygml_surfaces.hpp"

namespace farlod {

/// The city of a CityGML file: its text, and the surfaces that buildings refer to outside of themselves. Each walk over the
/// buildings parses the text again. All functions throw XmlTextError.
class CityGmlCity : public CityFile {
 public:
  explicit CityGmlCity(std::string text);

  [[nodiscard]] const std::string& text() const override { return text_; }
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] bool has_degrees() const override { return has_degrees_; }
  [[nodiscard]] const std::unordered_set<std::string>& repeated_ids() const override { return repeated_ids_; }
  void for_each_building(PackedLod lod, const std::function<void(const FileBuilding&)>& on) const override;
  [[nodiscard]] std::string text_of(const CityAttributes& attributes, std::size_t form) const override;

 private:
  std::string text_;
  CityGmlSurfaces foreign_;
  std::size_t foreign_points_ = 0;
  std::vector<GenericAttributeForm> forms_;
  std::unordered_set<std::string> repeated_ids_;
  bool has_degrees_ = true;
};

}  // namespace farlod
