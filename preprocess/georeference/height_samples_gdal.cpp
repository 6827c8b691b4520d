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
#include "georeference/crs.hpp"
#include "georeference/height_shift.hpp"
#include "georeference/placed_raster_gdal.hpp"
#include "georeference/raster_stand_ins_gdal.hpp"
#include "georeference/resolved_source.hpp"

namespace farlod::georeference {

struct HeightSamples::Impl {
  PlacedRaster raster;
  std::optional<CrsTransformation> to_output = {}, from_output = {};  ///< none where the raster is in the output CRS
  Point2d origin_m = {};
  std::vector<double> stand_ins = {};  ///< numbers that could be heights, but are none here

  /// NaN where it is none.
  [[nodiscard]] float height_m(float number) const {
    const float height = raster.scale.metres(number);
    const bool is_one = may_be_elevation(height) && std::find(stand_ins.begin(), stand_ins.end(), number) == stand_ins.end();
    return is_one ? height : std::numeric_limits<float>::quiet_NaN();
  }
  [[nodiscard]] GDALRasterBand& band() const { return *raster.dataset().GetRasterBand(1); }
};

namespace {

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
                             Report& report) {
  const GdalErrors quiet;
  impl_ = std::make_unique<Impl>(
      Impl{{file.path, open_height_raster(file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path,
                                          "is not a raster of heights that can be read; of a folder, give each file",
                                          {file.layer, false})}});
  PlacedRaster& raster = impl_->raster;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const Crs crs = raster.take_crs(fallback_crs, *output);
  const PixelFrame frame = raster.frame();
  const double column = 0.5 * raster.columns(), row = 0.5 * raster.rows();
  report_place(file.path.string(), crs, frame.place(column, row), frame.place(column + 1.0, row), report);
  for (const StandInOfFile& found : sampled_stand_ins(raster, plausibility::HeightsOf::ground))
    impl_->stand_ins.push_back(found.number);
  impl_->origin_m = georeference.origin_m;
  Point2d city = georeference.origin_m;
  if (!crs.equals(*output)) {
    impl_->to_output.emplace(crs, *output, frame.place(column, row));
    impl_->from_output.emplace(*output, crs, georeference.origin_m);
    city = impl_->from_output->apply(city).value_or(frame.place(column, row));
  }
  // Geoids tilt by less than a tenth of a millimetre a metre, so that the shift at the city is that of its mountains
  const auto shift = height_shift_for(file.path.string(), crs, georeference.heights_wkt, city, report);
  if (shift && shift->is_known()) raster.scale.offset += shift->at(city).value_or(0.0);
}
HeightSamples::HeightSamples(HeightSamples&&) noexcept = default;
HeightSamples::~HeightSamples() = default;

std::int64_t HeightSamples::columns() const { return impl_->raster.columns(); }
std::int64_t HeightSamples::rows() const { return impl_->raster.rows(); }

std::optional<double> HeightSamples::read(const PixelLattice& l, std::span<float> height_m) const {
  const GdalErrors quiet;
  std::ranges::fill(height_m, std::numeric_limits<float>::quiet_NaN());
  const int first = static_cast<int>(l.step / 2), columns = nodes_within(l.column, l, this->columns()),
            rows = nodes_within(l.row, l, this->rows());
  if (columns == 0 || rows == 0) return std::nullopt;
  std::vector<float> numbers(height_m.size()), mask(height_m.size());
  if (!read_square(impl_->band(), l, first, columns, rows, numbers, false) ||
      !read_square(impl_->band(), l, first, columns, rows, mask, true))
    refuse_raster(impl_->raster.path, "cannot be read to its end");
  forget_old_blocks();
  std::optional<double> stand_in;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
    for (std::size_t n = row * l.nodes; n < row * l.nodes + static_cast<std::size_t>(columns); ++n) {
      if (mask[n] == 0.0F || !std::isfinite(numbers[n])) continue;
      height_m[n] = impl_->height_m(numbers[n]);
      if (std::isnan(height_m[n])) stand_in = numbers[n];
    }
  return stand_in;
}

void HeightSamples::move_to_city(std::span<Point3d> points) const {
  const PixelFrame frame = impl_->raster.frame();
  for (Point3d& p : points) {
    const Point2d place = frame.place(p.x + 0.5, p.y + 0.5);
    p = {place.x, place.y, p.z};
  }
  if (impl_->to_output) impl_->to_output->apply(points);
  for (Point3d& p : points) p = {p.x - impl_->origin_m.x, p.y - impl_->origin_m.y, p.z};
}

void HeightSamples::move_to_pixels(std::span<Point3d> points) const {
  for (Point3d& p : points) p = {p.x + impl_->origin_m.x, p.y + impl_->origin_m.y, p.z};
  if (impl_->from_output) impl_->from_output->apply(points);
  const PixelFrame frame = impl_->raster.frame();
  for (Point3d& p : points) {
    const Point2d pixel = frame.pixels_at(horizontal(p));
    p = {pixel.x - 0.5, pixel.y - 0.5, p.z};
  }
}

}  // namespace farlod::georeference
