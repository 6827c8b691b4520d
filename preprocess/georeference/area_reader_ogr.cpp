// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <ogrsf_frmts.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/expects.hpp"
#include "base/point_columns.hpp"
#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/area_reader.hpp"
#include "georeference/input_crs.hpp"

namespace farlod::georeference {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what, GdalErrors& messages) {
  throw InputError(file.string() + what + " (" + messages.last() + ").");
}

/// Whether somebody means X0,Y0,X1,Y1, and writes it otherwise.
bool is_box_in_words(const std::string& text) {
  return text.find_first_not_of("0123456789.,;- ") == text.npos && text.find_first_of(",; ") != text.npos;
}

GDALDatasetUniquePtr open(const std::filesystem::path& file, GdalErrors& messages) {
  std::error_code unread;
  if (!std::filesystem::exists(file, unread) && !is_box_in_words(file.string())) throw InputError(why_unread(file));
  GDALDatasetUniquePtr dataset = open_vector_file_or_table(file);
  if (!dataset)
    fail(file, " cannot be read as an area: give X0,Y0,X1,Y1, a vector file that GDAL reads, or a table of points", messages);
  return dataset;
}

Area::Line line_of(const OGRSimpleCurve& curve) {
  Area::Line line;
  for (int k = 0; k < curve.getNumPoints(); ++k) line.push_back({curve.getX(k), curve.getY(k)});
  return line;
}

/// Adds what a geometry without arcs is made of.
void add(const OGRGeometry& geometry, Area& area) {
  if (geometry.IsEmpty() != 0) return;
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint) {
    area.points.push_back({geometry.toPoint()->getX(), geometry.toPoint()->getY()});
  } else if (type == wkbLineString) {
    area.lines.push_back(line_of(*geometry.toLineString()));
  } else if (OGR_GT_IsSubClassOf(type, wkbPolygon) != 0) {
    Area::Polygon& polygon = area.polygons.emplace_back();
    for (const OGRLinearRing* ring : *geometry.toPolygon()) polygon.push_back(line_of(*ring));
  } else if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
    const OGRPolyhedralSurface& surface = *geometry.toPolyhedralSurface();
    for (int n = 0; n < surface.getNumGeometries(); ++n) add(*surface.getGeometryRef(n), area);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
    for (const OGRGeometry* member : *geometry.toGeometryCollection()) add(*member, area);
  }
}

Area shapes_of(OGRLayer& layer) {
  Area area;
  for (Feature feature(layer.GetNextFeature()); feature; feature.reset(layer.GetNextFeature())) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr) continue;
    const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
    if (straight) add(*straight, area);
  }
  return area;
}

std::string_view trimmed_field(std::string_view field) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!field.empty() && blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && blank(field.back())) field.remove_suffix(1);
  return field;
}

double number_in(std::string_view field, const Feature& feature, const std::filesystem::path& file) {
  std::string_view digits = trimmed_field(field);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    throw InputError(file.string() + ": point " + std::to_string(feature->GetFID()) + ": \"" + std::string(field) +
                     "\" is not a number; write it like 1234.5");
  return value;
}

/// GDAL's names for the columns of a table without a header row.
bool has_header(const OGRFeatureDefn& fields) {
  return fields.GetFieldCount() < 1 || std::string_view(fields.GetFieldDefn(0)->GetNameRef()) != "field_1";
}

Area points_of(OGRLayer& table, const std::filesystem::path& file) {
  const OGRFeatureDefn& fields = *table.GetLayerDefn();
  const auto refuse = [&](const std::string& what) { throw InputError(file.string() + ": " + what); };
  const std::vector<std::string> names = field_names(table);
  std::optional<std::size_t> x = 0, y = 1;
  if (has_header(fields)) {
    x = point_columns::find_column(names, point_columns::x_names, refuse);
    y = point_columns::find_column(names, point_columns::y_names, refuse);
  }
  if (!x || !y || *y >= names.size())
    throw InputError(file.string() + ": no column is named x and y (or easting and northing, or lon and lat), of " +
                     point_columns::listed(names) + "; name them in the first row");
  Area area;
  for (Feature feature(table.GetNextFeature()); feature; feature.reset(table.GetNextFeature()))
    area.points.push_back({number_in(feature->GetFieldAsString(static_cast<int>(*x)), feature, file),
                           number_in(feature->GetFieldAsString(static_cast<int>(*y)), feature, file)});
  return area;
}

void require_numbers(Area& area, const std::filesystem::path& file) {
  area.for_each_point([&](const Point2d& p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) throw InputError(file.string() + " has a coordinate that is not a number.");
  });
}

/// Brings coordinates from the CRS of a part to that of the package.
void transform(Area& area, const std::string& own_wkt, const Crs& output, const std::string& name) {
  if (own_wkt.empty() || area.shape_count() == 0) return;
  const auto own = find_crs(own_wkt);
  if (!own) throw InputError(name + " is in a CRS that is not known: give it in " + output.name());
  if (own->crs.equals(output)) return;
  const Box2d outline = outline_of(area);
  const CrsTransformation transformation(own->crs, output, 0.5 * (outline.low + outline.high));
  area.for_each_point([&](Point2d& p) {
    const auto moved = transformation.apply(p);
    if (!moved || !std::isfinite(moved->x) || !std::isfinite(moved->y))
      throw InputError(name + " has a point, " + std::to_string(p.x) + "," + std::to_string(p.y) + " in " + own->crs.name() +
                       ", that has no place in " + output.name() +
                       ": check its CRS; ogr2ogr -a_srs EPSG:n NEW.gpkg OLD names another one, also where a GeoJSON names none");
    p = *moved;
  });
}

void append(Area& area, const Area& more) {
  area.points.insert(area.points.end(), more.points.begin(), more.points.end());
  area.lines.insert(area.lines.end(), more.lines.begin(), more.lines.end());
  area.polygons.insert(area.polygons.end(), more.polygons.begin(), more.polygons.end());
}

}  // namespace

RequestedArea read_area(const std::filesystem::path& file) {
  GdalErrors messages;
  const GDALDatasetUniquePtr dataset = open(file, messages);
  RequestedArea area{"The area in " + file.string(), {}};
  std::size_t shapes = 0;
  for (OGRLayer* layer : dataset->GetLayers()) {
    area.parts.push_back(is_table(file) ? RequestedArea::Part{points_of(*layer, file), {}}
                                        : RequestedArea::Part{shapes_of(*layer), wkt_of(layer->GetSpatialRef())});
    require_numbers(area.parts.back().shapes, file);
    shapes += area.parts.back().shapes.shape_count();
  }
  if (messages.any()) fail(file, " cannot be read to its end", messages);
  if (shapes == 0) throw InputError(file.string() + " holds no points, lines or polygons: it is no area.");
  return area;
}

Area located(const RequestedArea& area, const Georeference& georeference) {
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  Area all;
  for (const RequestedArea::Part& part : area.parts) {
    Area shapes = part.shapes;
    transform(shapes, part.crs_wkt, *output, area.name);
    append(all, shapes);
  }
  all.for_each_point([&](Point2d& p) { p = p - georeference.origin_m; });
  return all;
}

}  // namespace farlod::georeference
