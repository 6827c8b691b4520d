// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"
#include "ingest/footprints/feature_tags.hpp"
#include "ingest/footprints/footprint_reader.hpp"

// Private to the wrappers of GDAL: it names its classes.
class OGRFeature;
class OGRGeometry;
class OGRLayer;

namespace farlod::ingest {

/// Enough features to find out what the columns of a table hold, and whether features are bodies.
inline constexpr int most_features_to_sample = 100;

/// The fields of a layer. Tags that stand together in one column (tag_collections) are fields, too: the known ones, behind the
/// columns, where no column has their name.
class FeatureTable {
 public:
  explicit FeatureTable(OGRLayer& layer);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const BuildingTags& tags() const { return *tags_; }

  /// The fields of one feature, which must outlive them, as the table must.
  class Row {
   public:
    Row(const FeatureTable& table, const OGRFeature& feature);
    [[nodiscard]] FieldValue value(std::size_t field) const;
    [[nodiscard]] std::optional<std::string> tag(std::string_view name) const;
    [[nodiscard]] FeatureRole role() const;
    /// The id of the building that a part is of, where the table tells it.
    [[nodiscard]] std::optional<std::string> owner() const {
      return role() == FeatureRole::part ? tag("building_id") : std::nullopt;
    }

   private:
    const FeatureTable& table_;
    const OGRFeature& feature_;
    Tags collected_;

    [[nodiscard]] std::optional<std::string> collected(std::string_view name) const;
  };

 private:
  [[nodiscard]] std::optional<std::size_t> column_of(std::string_view tag) const;

  std::vector<std::string> names_;
  std::size_t columns_ = 0;
  mutable std::map<std::string, std::optional<std::size_t>, std::less<>> column_of_tag_;  ///< of those that were asked for
  std::vector<int> collections_;
  std::optional<BuildingTags> tags_;
};

/// The parts of buildings that a layer has, to find out which outlines they stand for.
class PartsOfLayer {
 public:
  /// Reads the layer once, if it may have parts.
  PartsOfLayer(OGRLayer& layer, const FeatureTable& table);

  /// Whether parts cover most of an area in the plan. Where some stand on others, their plan counts once.
  [[nodiscard]] bool fill(const OGRGeometry& outline) const;

 private:
  struct Part {
    Point2d inside;  ///< a point in it
    double area = 0.0;
    std::shared_ptr<const OGRGeometry> geometry;
  };
  std::vector<Part> parts_;  ///< by the x of their points
};

}  // namespace farlod::ingest
