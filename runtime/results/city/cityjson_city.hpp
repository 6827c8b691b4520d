// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>

#include "results/city/city_file.hpp"
#include "results/city/cityjson_text.hpp"

namespace farlod {

/// The city of a CityJSON file, or of a CityJSONSeq. A polygon that an earlier geometry of the building has already has the
/// number of that one. All functions throw JsonCursorError.
class CityJsonCity : public CityFile {
 public:
  explicit CityJsonCity(std::string text);

  /// Whether features follow the first text, one a line.
  [[nodiscard]] bool is_sequence() const { return is_sequence_; }
  [[nodiscard]] const std::string& text() const override { return text_; }
  [[nodiscard]] std::size_t bytes() const override { return text_.size() + first_->bytes(); }
  [[nodiscard]] bool has_degrees() const override { return has_degrees_; }
  [[nodiscard]] const std::unordered_set<std::string>& repeated_ids() const override { return repeated_ids_; }
  void for_each_building(PackedLod lod, const std::function<void(const FileBuilding&)>& on) const override;
  [[nodiscard]] std::string text_of(const CityAttributes& attributes, std::size_t form) const override;

 private:
  /// Calls `on` for each JSON text. A line that is no feature is none in the package either.
  void for_each_text(const std::function<void(const CityJsonText&)>& on) const;

  std::string text_;
  std::optional<const CityJsonText> first_;
  std::unordered_set<std::string> repeated_ids_;
  bool has_degrees_ = true, is_sequence_ = false;
};

}  // namespace farlod
