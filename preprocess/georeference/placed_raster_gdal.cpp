// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/placed_raster_gdal.hpp"

#include <fmt/core.h>
#include <gdal_priv.h>

#include <sstream>

#include "farlod/error.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/height_shift.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/place_on_earth.hpp"

namespace farlod::georeference {

Point2d PixelFrame::pixels_at(Point2d p) const {
  const double determinant = column_step.x * row_step.y - column_step.y * row_step.x;
  const Point2d d = p - corner;
  return {(d.x * row_step.y - d.y * row_step.x) / determinant, (column_step.x * d.y - column_step.y * d.x) / determinant};
}

bool PixelFrame::is_made_of_squares() const {
  // Sides that differ by less than a thousandth are meant to be equal
  constexpr double tolerance = 1e-3;
  const double a = norm(column_step), b = norm(row_step);
  return std::abs(a - b) <= tolerance * a && std::abs(dot(column_step, row_step)) <= tolerance * a * b;
}

int PlacedRaster::columns() const { return dataset().GetRasterXSize(); }
int PlacedRaster::rows() const { return dataset().GetRasterYSize(); }

PixelFrame PlacedRaster::frame() const {
  const GeoTransform t = geo_transform_of(dataset(), path);
  return {{t[0], t[3]}, {t[1], t[4]}, {t[2], t[5]}};
}

Box2d PlacedRaster::extent() const {
  const GeoTransform t = geo_transform_of(*file, path);
  Box2d box;
  for (const double column : {0.0, static_cast<double>(file->GetRasterXSize())})
    for (const double row : {0.0, static_cast<double>(file->GetRasterYSize())})
      box.add({t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]});
  return box;
}

Crs PlacedRaster::take_crs(const std::string& fallback_crs, const Crs& output) {
  const std::string own_wkt = crs_in_place.value_or(wkt_of(file->GetSpatialRef()));
  is_in_crs_of_city = own_wkt.empty() && fallback_crs.empty();
  Crs crs = is_in_crs_of_city ? output : crs_of_input(path.string(), own_wkt, fallback_crs).crs;
  whose_crs = crs_in_place        ? "that of --crs"
              : find_crs(own_wkt) ? "its own CRS"
              : is_in_crs_of_city ? "that of the city, since the file names none"
                                  : "that of --crs, since the file names none that is known";
  GDALRasterBand& band = *file->GetRasterBand(1);
  const double unit_m = named_unit_m(band).value_or(crs.height_unit_m());
  scale = {unit_m * band.GetScale(), unit_m * band.GetOffset()};
  own = crs;
  return crs;
}

void PlacedRaster::warp(const WarpWay& way, const Crs& output) {
  warped = warped_raster(unwarped(), way);
  if (!warped) refuse_raster(path, "cannot be brought into " + output.name());
}

namespace {

std::string text_of(const Box2d& box, const Crs& crs) {
  const int digits = crs.is_projected() ? 0 : 5;
  return fmt::format("from {:.{}f}, {:.{}f} to {:.{}f}, {:.{}f} in {}", box.low.x, digits, box.low.y, digits, box.high.x, digits,
                     box.high.y, digits, crs.name());
}

/// Where the city lies in the raster with its latitude and longitude exchanged; else what may be wrong with a CRS.
std::string reason_of_elsewhere(const PlacedRaster& raster, const Crs& output, const Box2d& wanted) {
  const auto city = output.lon_lat_deg(0.5 * (wanted.low + wanted.high));
  const Box2d own = raster.extent();
  Box2d box_deg;
  for (const Point2d corner : {own.low, own.high, Point2d{own.low.x, own.high.y}, Point2d{own.high.x, own.low.y}})
    if (const auto place = raster.own->lon_lat_deg(corner)) box_deg.add(*place);
  if (city && box_deg.contains({city->y, city->x}))
    return "It lies where the city is with latitude and longitude exchanged, at " + degrees_text({city->y, city->x}) +
           " instead of " + degrees_text(*city) + ": are they exchanged in its files?";
  return "Is one of the two CRSs wrong (--crs is for files that name none), or is the file of another place?";
}

}  // namespace

void refuse_elsewhere(const std::string& name, const PlacedRaster& raster, const Crs& output, const Box2d& wanted) {
  std::string there;
  if (raster.warped) {
    Box2d box;
    const PixelFrame frame = raster.frame();
    for (const Point2d corner : {frame.place(0.0, 0.0), frame.place(raster.columns(), raster.rows())}) box.add(corner);
    there = ", which is " + text_of(box, output);
  }
  throw InputError(fmt::format("{} does not meet the city: it lies {} ({}){}; the city with its cells lies {}. {}", name,
                               text_of(raster.extent(), *raster.own), raster.whose_crs, there, text_of(wanted, output),
                               reason_of_elsewhere(raster, output, wanted)));
}

std::optional<std::string> note_of_unit(const PlacedRaster& raster) {
  if (named_unit_m(*raster.file->GetRasterBand(1))) return std::nullopt;
  return note_of_height_unit(raster.path.string(), *raster.own, "gdal_edit.py -units m FILE says so");
}

std::string length_text(double length_m) {
  std::ostringstream text;
  text.precision(5);
  text << length_m;
  return std::move(text).str();
}

}  // namespace farlod::georeference
