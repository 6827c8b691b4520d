// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "farlod/inspection.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

enum class FieldType { text, whole, real };

/// A column of a layer.
struct FeatureField {
  std::string name;
  FieldType type = FieldType::text;
};

/// What the rows of a layer are. Areas are polygons in the plan, one in each row; multiple areas, some in each row.
enum class LayerGeometry : std::uint8_t { none, points, polygons, areas, multiple_areas };

/// Whether its polygons are in the plan.
[[nodiscard]] constexpr bool is_level(LayerGeometry geometry) {
  return geometry == LayerGeometry::areas || geometry == LayerGeometry::multiple_areas;
}

/// A table whose rows may have a place, as GIS programs know them.
struct FeatureLayer {
  std::string name, description;
  std::vector<FeatureField> fields;
  LayerGeometry geometry = LayerGeometry::points;
};

/// A value of the type of its field; the first alternative where the row has none.
using FieldValue = std::variant<std::monostate, std::string_view, std::int64_t, double>;

/// A row of a layer.
struct FeatureRow {
  Point2d p_projected;                        ///< of a point; NaN: it has no geometry
  std::optional<double> height_m;             ///< likewise
  std::vector<FieldValue> values;             ///< as many as FeatureLayer::fields
  std::vector<SurfacePolygon> polygons = {};  ///< of an area one, whose heights do not count
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

/// Writes layers by GDAL, in the CRS of the frame:
///   (1) Coordinates are rounded to the millimetre, and places have three. z of a point is NaN where the height is not known.
///       Polygons are those of a MultiPolygon Z, areas are polygons of two coordinates, and multiple areas a MultiPolygon.
///   (2) Fields are text, 64-bit integers or doubles, and null where a feature has no value.
///   (3) The same features give the same bytes. What a file calls its date is 1 January 1970, or OGR_CURRENT_DATE where the
///       environment has it.
[[nodiscard]] std::unique_ptr<FeatureWriter> geopackage_writer(const TableFrame& frame, const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<FeatureWriter> flatgeobuf_writer(const TableFrame& frame, const std::filesystem::path& path);

/// Writes one layer as GeoJSON (RFC 7946):
///   (1) Coordinates are longitude and latitude in WGS 84 with eight digits after the point, which is a millimetre. The third is
///       the height as the package has it; there is none where it is not known. Without a CRS, coordinates stay as they are.
///       Polygons and multiple areas are those of a MultiPolygon; without geometry, it is null.
///   (2) Properties are all fields of the layer; null where a feature has no value.
///   (3) The frame's provenance is a member of the collection, which readers that do not know it skip.
[[nodiscard]] std::unique_ptr<FeatureWriter> geojson_writer(const TableFrame& frame, const std::filesystem::path& path);

/// Writes a layer of points to a netCDF-4 file after the CF conventions, version 1.8, as a discrete sampling geometry of the
/// feature type `point`: a variable for each field along the dimension `point`, with the coordinates `x_m`, `y_m` and `z_m`, and
/// `crs` as the grid mapping. Texts are rows of characters in UTF-8. Areas are points at FeatureRow::p_projected, without height.
/// Holds some thousand rows, however many there are.
[[nodiscard]] std::unique_ptr<FeatureWriter> netcdf_point_writer(const TableFrame& frame, const std::filesystem::path& path);

}  // namespace farlod
