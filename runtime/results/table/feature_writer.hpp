// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

enum class FieldType { text, whole, real };

/// A column of a layer.
struct FeatureField {
  std::string name;
  FieldType type = FieldType::text;
};

/// A table whose rows may have a place, as GIS programs know them.
struct FeatureLayer {
  std::string name, description;
  std::vector<FeatureField> fields;
  bool has_places = true;  ///< whether rows are points, or have no geometry
};

/// A value of the type of its field; the first alternative where the row has none.
using FieldValue = std::variant<std::monostate, std::string_view, std::int64_t, double>;

/// A row of a layer.
struct FeatureRow {
  Point2d p_projected;
  std::optional<double> height_m;
  std::vector<FieldValue> values;  ///< as many as FeatureLayer::fields
};

/// Writes layers to files of a vector format. All functions throw OutputError.
class FeatureWriter {
 public:
  FeatureWriter() = default;
  virtual ~FeatureWriter() = default;
  FeatureWriter(const FeatureWriter&) = delete;
  FeatureWriter& operator=(const FeatureWriter&) = delete;

  /// The features that follow are of this layer. Called again only for a format that has several in a file.
  virtual void begin(const FeatureLayer& layer) = 0;
  virtual void add(const FeatureRow& row) = 0;
  /// The file appears now, and not before.
  virtual void commit() = 0;
};

}  // namespace farlod
