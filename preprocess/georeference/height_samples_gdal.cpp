// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/height_samples.hpp"

#include <gdal.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/crs.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/resolved_source.hpp"

namespace farlod::georeference {

struct HeightSamples::Impl {
  std::filesystem::path path;
  GDALDatasetUniquePtr dataset;
  GeoTransform transform{};
  double scale = 1.0, offset = 0.0;
  std::optional<CrsTransformation> to_output, from_output;  ///< none where the raster is in the output CRS
  Point2d origin_m;

  [[nodiscard]] GDALRasterBand& band() const { return *dataset->GetRasterBand(1); }
};

namespace {

Point2d place_of(const GeoTransform& t, double column, double row) {
  return {t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]};
}

/// Reads every `step`-th pixel: GDAL takes the one in the middle of each square of them, from an overview where there is one.
bool read_square(GDALRasterBand& band, const PixelLattice& l, int first, int columns, int rows, std::vector<float>& values,
                 bool mask) {
  GDALRasterIOExtraArg nearest;
  INIT_RASTERIO_EXTRA_ARG(nearest);
  const int step = static_cast<int>(l.step);
  GDALRasterBand& read = mask ? *band.GetMaskBand() : band;
  return read.RasterIO(GF_Read, static_cast<int>(l.column) - first, static_cast<int>(l.row) - first, columns * step, rows * step,
                       values.data(), columns, rows, GDT_Float32, 0, static_cast<GSpacing>(sizeof(float)) * l.nodes,
                       &nearest) == CE_None;
}

/// How many nodes of a lattice a raster has along a side.
int nodes_within(std::int64_t begin, const PixelLattice& l, std::int64_t count) {
  const std::int64_t step = l.step, last = count - begin + step / 2;
  return static_cast<int>(std::clamp<std::int64_t>(last / step, 0, l.nodes));
}

}  // namespace

HeightSamples::HeightSamples(const TerrainFile& file, const std::string& fallback_crs, const Georeference& georeference,
                             Report& report)
    : impl_(std::make_unique<Impl>()) {
  const GdalErrors quiet;
  Impl& s = *impl_;
  s.path = file.path;
  s.origin_m = georeference.origin_m;
  s.dataset = open_height_raster(file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path,
                                 "is not a raster of heights that can be read");
  s.transform = geo_transform_of(*s.dataset, file.path);
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const std::string own_wkt = wkt_of(s.dataset->GetSpatialRef());
  const bool unnamed = own_wkt.empty() && fallback_crs.empty();
  const Crs crs = unnamed ? *output : crs_of_input(file.path.string(), own_wkt, fallback_crs).crs;
  const double unit_m = named_unit_m(s.band()).value_or(crs.height_unit_m());
  s.scale = unit_m * s.band().GetScale();
  s.offset = unit_m * s.band().GetOffset();
  const Point2d middle = place_of(s.transform, 0.5 * s.dataset->GetRasterXSize(), 0.5 * s.dataset->GetRasterYSize());
  report_place(file.path.string(), crs, middle, middle + Point2d{s.transform[1], s.transform[4]}, report);
  if (crs.equals(*output)) return;
  s.to_output.emplace(crs, *output, middle);
  s.from_output.emplace(*output, crs, georeference.origin_m);
}
HeightSamples::HeightSamples(HeightSamples&&) noexcept = default;
HeightSamples::~HeightSamples() = default;

std::int64_t HeightSamples::columns() const { return impl_->dataset->GetRasterXSize(); }
std::int64_t HeightSamples::rows() const { return impl_->dataset->GetRasterYSize(); }

std::optional<double> HeightSamples::read(const PixelLattice& l, std::span<float> height_m) const {
  const GdalErrors quiet;
  std::ranges::fill(height_m, std::numeric_limits<float>::quiet_NaN());
  const int first = static_cast<int>(l.step / 2), columns = nodes_within(l.column, l, this->columns()),
            rows = nodes_within(l.row, l, this->rows());
  if (columns == 0 || rows == 0) return std::nullopt;
  std::vector<float> numbers(height_m.size()), mask(height_m.size());
  if (!read_square(impl_->band(), l, first, columns, rows, numbers, false) ||
      !read_square(impl_->band(), l, first, columns, rows, mask, true))
    refuse_raster(impl_->path, "cannot be read to its end");
  std::optional<double> stand_in;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
    for (std::size_t n = row * l.nodes; n < row * l.nodes + static_cast<std::size_t>(columns); ++n) {
      if (mask[n] == 0.0F || !std::isfinite(numbers[n])) continue;
      const double height = impl_->scale * numbers[n] + impl_->offset;
      if (may_be_elevation(height))
        height_m[n] = static_cast<float>(height);
      else
        stand_in = numbers[n];
    }
  return stand_in;
}

void HeightSamples::move_to_city(std::span<Point3d> points) const {
  for (Point3d& p : points) {
    const Point2d place = place_of(impl_->transform, p.x + 0.5, p.y + 0.5);
    p = {place.x, place.y, p.z};
  }
  if (impl_->to_output) impl_->to_output->apply(points);
  for (Point3d& p : points) p = {p.x - impl_->origin_m.x, p.y - impl_->origin_m.y, p.z};
}

void HeightSamples::move_to_pixels(std::span<Point3d> points) const {
  for (Point3d& p : points) p = {p.x + impl_->origin_m.x, p.y + impl_->origin_m.y, p.z};
  if (impl_->from_output) impl_->from_output->apply(points);
  const GeoTransform& t = impl_->transform;
  const double determinant = t[1] * t[5] - t[2] * t[4];
  for (Point3d& p : points) {
    const double dx = p.x - t[0], dy = p.y - t[3];
    p = {(dx * t[5] - dy * t[2]) / determinant - 0.5, (dy * t[1] - dx * t[4]) / determinant - 0.5, p.z};
  }
}

}  // namespace farlod::georeference
