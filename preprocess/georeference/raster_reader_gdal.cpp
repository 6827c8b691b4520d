// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "georeference/crs.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/raster_reader.hpp"
#include "georeference/resolved_source.hpp"
#include "plausibility/stand_ins.hpp"

namespace farlod::georeference {
namespace {

using plausibility::HeightsOf;

GDALDatasetUniquePtr open_raster(const TerrainFile& file) {
  return open_height_raster(
      file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path,
      "is not a raster of heights that can be read: give a GeoTIFF, an ESRI ASCII grid or another format of GDAL; a relief "
      "of CityGML or CityJSON goes among the inputs");
}

bool is_north_up(const GeoTransform& t) { return t[1] > 0.0 && t[2] == 0.0 && t[4] == 0.0 && t[5] < 0.0; }

/// Half-open ranges of columns and rows.
struct RasterWindow {
  int column = 0, row = 0, column_end = 0, row_end = 0;

  [[nodiscard]] bool is_empty() const { return column >= column_end || row >= row_end; }
  [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(column_end - column); }
  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(row_end - row); }
};

/// The pixels, of `count`, whose centres lie between `low` and `high`, and one more at each end. Both are counted in pixels from
/// the edge of the first pixel.
std::pair<int, int> pixels_around(double low, double high, int count) {
  const double begin = std::clamp(std::floor(low - 0.5) - 1.0, 0.0, static_cast<double>(count));
  const double end = std::clamp(std::ceil(high - 0.5) + 2.0, 0.0, static_cast<double>(count));
  return {static_cast<int>(begin), static_cast<int>(end)};
}

RasterWindow window_of(GDALDataset& dataset, const GeoTransform& t, const std::optional<Box2d>& wanted) {
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  if (!wanted) return {0, 0, columns, rows};
  const auto [column, column_end] = pixels_around((wanted->low.x - t[0]) / t[1], (wanted->high.x - t[0]) / t[1], columns);
  const auto [row, row_end] = pixels_around((wanted->high.y - t[3]) / t[5], (wanted->low.y - t[3]) / t[5], rows);
  return {column, row, column_end, row_end};
}

/// Converts the numbers of a band to heights in metres.
struct HeightScale {
  double scale = 1.0, offset = 0.0;

  [[nodiscard]] float metres(double value) const { return static_cast<float>(scale * value + offset); }
  [[nodiscard]] double number(float height_m) const { return (static_cast<double>(height_m) - offset) / scale; }
};

/// Where the pixels of a raster are, in the output CRS. Places within it are counted in pixels from the corner of the first one.
struct PixelFrame {
  Point2d corner, column_step, row_step;

  explicit PixelFrame(const GeoTransform& t) : corner{t[0], t[3]}, column_step{t[1], t[4]}, row_step{t[2], t[5]} {}

  [[nodiscard]] Point2d place(double column, double row) const { return corner + column * column_step + row * row_step; }
  [[nodiscard]] Point2d pixels_at(Point2d p) const {
    const double determinant = column_step.x * row_step.y - column_step.y * row_step.x;
    const Point2d d = p - corner;
    return {(d.x * row_step.y - d.y * row_step.x) / determinant, (column_step.x * d.y - column_step.y * d.x) / determinant};
  }
  [[nodiscard]] bool is_made_of_squares() const {
    // Sides that differ by less than a thousandth are meant to be equal
    constexpr double tolerance = 1e-3;
    const double a = norm(column_step), b = norm(row_step);
    return std::abs(a - b) <= tolerance * a && std::abs(dot(column_step, row_step)) <= tolerance * a * b;
  }
};

/// A raster in the output CRS.
struct Raster {
  std::filesystem::path path;
  GDALDatasetUniquePtr file, warped;  ///< `warped` is empty when the file is used as it is
  HeightScale scale = {};
  std::string note = {};  ///< what was done to it, for the user

  [[nodiscard]] GDALDataset& dataset() const { return warped ? *warped : *file; }
  [[nodiscard]] std::optional<float> height_m(double number) const {
    const float height = scale.metres(number);
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
  }
  [[nodiscard]] PixelFrame frame() const { return PixelFrame(geo_transform_of(dataset(), path)); }
};

/// Finds the CRS of a raster that is open, and the scale of its heights.
Crs take_crs(Raster& raster, const std::string& fallback_crs, const Crs& output) {
  const std::string own_wkt = wkt_of(raster.file->GetSpatialRef());
  const bool unnamed = own_wkt.empty() && fallback_crs.empty();
  Crs crs = unnamed ? output : crs_of_input(raster.path.string(), own_wkt, fallback_crs).crs;
  GDALRasterBand& band = *raster.file->GetRasterBand(1);
  const double unit_m = named_unit_m(band).value_or(crs.height_unit_m());
  raster.scale = {unit_m * band.GetScale(), unit_m * band.GetOffset()};
  return crs;
}

/// A number that stands for no data, and the first of its pixels in the CRS of the file.
struct StandInOfFile {
  double number = 0.0;
  Point2d place;
};

/// `where` begins the detail.
void report_stand_in(const Raster& raster, const Crs& own, const StandInOfFile& found, const std::string& where, Report& report) {
  std::ostringstream text;
  text.precision(9);
  text << where << found.number << " is no height here, and counts as no data; gdal_edit.py -a_nodata " << found.number
       << " declares it";
  Problem problem{ProblemCode::undeclared_no_data, raster.path.string(), "band 1", std::move(text).str(),
                  Point3d{found.place.x, found.place.y, 0.0}};
  ProblemLocator(own, FileAxes{}, found.place).locate(problem);
  report.add(std::move(problem));
}

/// Pixels are computed when they are read.
void warp(Raster& raster, const WarpWay& way, const Crs& output) {
  raster.warped = warped_raster(*raster.file, way);
  if (!raster.warped) refuse_raster(raster.path, "cannot be brought into " + output.name());
}

/// Masked pixels are empty; nothing when the file is cut short.
std::optional<TerrainRaster> read_window(const Raster& raster, const GeoTransform& t, const RasterWindow& w, Point2d origin) {
  TerrainRaster terrain;
  terrain.columns = w.columns();
  terrain.rows = w.rows();
  terrain.step_m = {t[1], -t[5]};
  // The first row of a file is in the north, that of a terrain in the south
  terrain.first = Point2d{t[0] + (w.column + 0.5) * t[1], t[3] + (w.row_end - 0.5) * t[5]} - origin;
  terrain.height_m.reserve(terrain.columns * terrain.rows);
  std::vector<double> values(w.columns());
  for (int row = w.row_end - 1; row >= w.row; --row) {
    if (!read_pixels(*raster.dataset().GetRasterBand(1), w.column, row, values)) return std::nullopt;
    for (const double value : values) terrain.height_m.push_back(raster.height_m(value));
  }
  return terrain;
}

/// What stands for no data, by a sample of the raster that is spread over all of it. Empty where the raster declares it itself.
std::optional<StandInOfFile> sampled_stand_in(const Raster& raster, HeightsOf of) {
  constexpr int most = 512;
  GDALRasterBand& band = *raster.file->GetRasterBand(1);
  int is_declared = 0;
  (void)band.GetNoDataValue(&is_declared);
  if (is_declared != 0) return std::nullopt;
  const int columns = std::min(band.GetXSize(), most), rows = std::min(band.GetYSize(), most);
  std::vector<double> numbers(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), numbers.data(), columns, rows, GDT_Float64, 0, 0, nullptr) !=
      CE_None)
    return std::nullopt;
  std::vector<std::optional<float>> heights_m;
  for (const double number : numbers) heights_m.push_back(raster.height_m(number));
  const auto found = plausibility::take_out_stand_ins(heights_m, of);
  if (found.empty()) return std::nullopt;
  const std::size_t first = found.front().first, row = first / static_cast<std::size_t>(columns),
                    column = first % static_cast<std::size_t>(columns);
  return StandInOfFile{numbers[found.front().first],
                       raster.frame().place((static_cast<double>(column) + 0.5) * band.GetXSize() / columns,
                                            (static_cast<double>(row) + 0.5) * band.GetYSize() / rows)};
}

/// North up. Stand-ins for no data must not become heights between them and their neighbours.
Raster make_ready(const TerrainFile& file, const std::string& fallback_crs, const Crs& output, HeightsOf of, Report& report) {
  Raster raster{file.path, open_raster(file), nullptr};
  const Crs crs = take_crs(raster, fallback_crs, output);
  const PixelFrame frame = raster.frame();
  const Point2d middle{0.5 * raster.file->GetRasterXSize(), 0.5 * raster.file->GetRasterYSize()};
  report_place(file.path.string(), crs, frame.place(middle.x, middle.y), frame.place(middle.x + 1.0, middle.y), report);
  if (!crs.equals(output) || !is_north_up(geo_transform_of(*raster.file, file.path))) {
    WarpWay way{crs.wkt(), output.wkt()};
    if (const auto found = sampled_stand_in(raster, of)) {
      way.no_data = found->number;
      report_stand_in(raster, crs, *found, "", report);
    }
    warp(raster, way, output);
  }
  return raster;
}

/// Empties what is left of heights that no place has. Where the raster was resampled, all was told before.
void require_heights(TerrainRaster& terrain, const Raster& raster, HeightsOf of, const Crs& output, Point2d origin_m,
                     Report& report) {
  const std::size_t all = terrain.height_m.size();
  for (const plausibility::StandIn& found : plausibility::take_out_stand_ins(terrain.height_m, of)) {
    if (raster.warped) continue;
    const Point2d place = terrain.node(found.first % terrain.columns, found.first / terrain.columns) + origin_m;
    report_stand_in(raster, output, {raster.scale.number(found.height_m), place},
                    std::to_string(found.pixels) + " of " + std::to_string(all) + " pixels here: ", report);
  }
}

}  // namespace

TerrainExtent read_terrain_extent(const TerrainFile& file) {
  const GdalErrors quiet;
  const GDALDatasetUniquePtr dataset = open_raster(file);
  const GeoTransform t = geo_transform_of(*dataset, file.path);
  TerrainExtent extent{wkt_of(dataset->GetSpatialRef()), {}};
  for (const double column : {0.0, static_cast<double>(dataset->GetRasterXSize())})
    for (const double row : {0.0, static_cast<double>(dataset->GetRasterYSize())})
      extent.box.add({t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]});
  return extent;
}

Georeference georeference_of_terrain(const TerrainFile& file, const GeoreferenceSettings& settings) {
  const TerrainExtent extent = read_terrain_extent(file);
  const Crs input = crs_of_input(file.path.string(), extent.crs_wkt, settings.crs).crs;
  const Point2d centre = 0.5 * (extent.box.low + extent.box.high);
  const Crs output = choose_output_crs(input, centre, settings.out_crs);
  const auto place = input.equals(output) ? centre : CrsTransformation(input, output, centre).apply(centre);
  if (!place) throw InputError(file.path.string() + ": its centre has no place in " + output.name() + ": check its CRS");
  return georeference_around(*place, output);
}

TerrainRaster read_terrain(const TerrainFile& file, const std::string& fallback_crs, const Georeference& georeference,
                           std::optional<Box2d> wanted_city, Report& report) {
  const GdalErrors quiet;
  const HeightsOf of = wanted_city ? HeightsOf::ground : HeightsOf::surfaces;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const Raster ready = make_ready(file, fallback_crs, *output, of, report);
  const GeoTransform t = geo_transform_of(ready.dataset(), file.path);
  if (wanted_city) *wanted_city = {wanted_city->low + georeference.origin_m, wanted_city->high + georeference.origin_m};
  const RasterWindow window = window_of(ready.dataset(), t, wanted_city);
  if (window.is_empty())
    throw InputError(
        file.path.string() +
        ": does not cover the city: check its CRS, which was taken to be that of --crs or the output if it says none");
  auto terrain = read_window(ready, t, window, georeference.origin_m);
  if (!terrain) refuse_raster(file.path, "cannot be read to its end");
  require_heights(*terrain, ready, of, *output, georeference.origin_m, report);
  return std::move(*terrain);
}

namespace {

constexpr float no_data = std::numeric_limits<float>::quiet_NaN();

std::string text_of(double length_m) {
  std::ostringstream text;
  text.precision(5);
  text << length_m;
  return std::move(text).str();
}

void bring_into_squares(Raster& raster, const Crs& own, const Crs& output) {
  const PixelFrame frame = raster.frame();
  WarpWay way{own.wkt(), output.wkt(), "near"};
  if (own.equals(output)) {
    way.step = std::min(norm(frame.column_step), norm(frame.row_step));
    const double columns = raster.file->GetRasterXSize(), rows = raster.file->GetRasterYSize();
    way.extent.emplace();
    for (const double column : {0.0, columns})
      for (const double row : {0.0, rows}) way.extent->add(frame.place(column, row));
  }
  warp(raster, way, output);
  const std::string why = own.equals(output) ? "its pixels are no squares" : "it is in " + own.name();
  raster.note = raster.path.string() + ": since " + why + ", it is read in squares of " +
                text_of(norm(raster.frame().column_step)) + " m, each with the height of the nearest pixel";
}

Raster open(const std::filesystem::path& path) {
  return {path,
          open_height_raster(GdalReach::local_files, path,
                             "is not a raster of the heights of crowns that can be read: give a GeoTIFF, an ESRI ASCII grid or "
                             "another format of GDAL"),
          nullptr};
}

Raster make_ready(const std::filesystem::path& path, const std::string& fallback_crs, const Crs& output) {
  Raster raster = open(path);
  const Crs crs = take_crs(raster, fallback_crs, output);
  if (!crs.equals(output) || !raster.frame().is_made_of_squares()) bring_into_squares(raster, crs, output);
  return raster;
}

/// The pixels that a rectangle meets, and one more at each side.
RasterWindow window_of(const Raster& raster, const Box2d& wanted) {
  const PixelFrame frame = raster.frame();
  Box2d box;
  for (const Point2d corner :
       {wanted.low, Point2d{wanted.high.x, wanted.low.y}, wanted.high, Point2d{wanted.low.x, wanted.high.y}})
    box.add(frame.pixels_at(corner));
  const auto within = [](double pixel, int count) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(count)));
  };
  const int columns = raster.dataset().GetRasterXSize(), rows = raster.dataset().GetRasterYSize();
  return {within(std::floor(box.low.x) - 1.0, columns), within(std::floor(box.low.y) - 1.0, rows),
          within(std::ceil(box.high.x) + 1.0, columns), within(std::ceil(box.high.y) + 1.0, rows)};
}

PagedArray<float> read_heights(const Raster& raster, const RasterWindow& w, const std::stop_token& stop) {
  PagedArray<float> heights;
  std::vector<double> values(w.columns());
  GDALRasterBand& band = *raster.dataset().GetRasterBand(1);
  for (int row = w.row; row < w.row_end; ++row) {
    throw_if_cancelled(stop);
    if (!read_pixels(band, w.column, row, values)) refuse_raster(raster.path, "cannot be read to its end");
    for (const double value : values) heights.push_back(std::isfinite(value) ? raster.scale.metres(value) : no_data);
  }
  return heights;
}

bool lie_alike(const Raster& a, const Raster& b) {
  const PixelFrame fa = a.frame(), fb = b.frame();
  const double tolerance_m = 1e-3 * norm(fa.column_step);
  const auto is_near = [&](Point2d p, Point2d q) { return norm(p - q) <= tolerance_m; };
  const double columns = a.dataset().GetRasterXSize(), rows = a.dataset().GetRasterYSize();
  return a.dataset().GetRasterXSize() == b.dataset().GetRasterXSize() &&
         a.dataset().GetRasterYSize() == b.dataset().GetRasterYSize() && is_near(fa.corner, fb.corner) &&
         is_near(fa.place(columns, rows), fb.place(columns, rows)) && is_near(fa.place(columns, 0.0), fb.place(columns, 0.0));
}

/// The trunks below each cell that has data: those of the pixel at its centre.
PagedArray<float> trunks_below(const CanopyRaster& canopy, const Raster& trunks, const Box2d& wanted, Point2d origin_m,
                               const std::stop_token& stop) {
  const RasterWindow w = window_of(trunks, wanted);
  const PagedArray<float> heights = w.is_empty() ? PagedArray<float>() : read_heights(trunks, w, stop);
  const PixelFrame frame = trunks.frame();
  PagedArray<float> below;
  for (std::size_t row = 0; row < canopy.rows; ++row)
    for (std::size_t column = 0; column < canopy.columns; ++column) {
      const Point2d pixel = frame.pixels_at(canopy.centre(column, row) + origin_m) - Point2d{double(w.column), double(w.row)};
      const bool is_within = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < static_cast<double>(w.columns()) &&
                             pixel.y < static_cast<double>(w.rows()) && !w.is_empty();
      below.push_back(is_within ? heights[static_cast<std::size_t>(pixel.y) * w.columns() + static_cast<std::size_t>(pixel.x)]
                                : no_data);
    }
  return below;
}

CanopyRaster read_tops(const Raster& tops, const Box2d& wanted, Point2d origin_m, const std::stop_token& stop) {
  const RasterWindow w = window_of(tops, wanted);
  if (w.is_empty())
    throw InputError(
        tops.path.string() +
        ": does not meet the city: check its CRS, which was taken to be that of --crs or the output if it says none");
  const PixelFrame frame = tops.frame();
  CanopyRaster canopy;
  canopy.source = tops.path.string();
  canopy.first = frame.place(w.column + 0.5, w.row + 0.5) - origin_m;
  canopy.column_step = frame.column_step;
  canopy.row_step = frame.row_step;
  canopy.columns = w.columns();
  canopy.rows = w.rows();
  canopy.top_m = read_heights(tops, w, stop);
  return canopy;
}

}  // namespace

void require_canopy(const CanopyFiles& files) {
  const GdalErrors quiet;
  (void)open(files.tops).frame();
  if (files.trunks) (void)open(*files.trunks).frame();
}

std::pair<CanopyRaster, std::vector<std::string>> read_canopy(const CanopyFiles& files, const std::string& fallback_crs,
                                                              const Georeference& georeference, const Box2d& wanted_city,
                                                              const std::stop_token& stop) {
  const GdalErrors quiet;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const Point2d origin_m = georeference.origin_m;
  const Box2d wanted{wanted_city.low + origin_m, wanted_city.high + origin_m};
  const Raster tops = make_ready(files.tops, fallback_crs, *output);
  CanopyRaster canopy = read_tops(tops, wanted, origin_m, stop);
  std::vector<std::string> notes;
  if (!tops.note.empty()) notes.push_back(tops.note);
  if (!files.trunks) return {std::move(canopy), std::move(notes)};
  const Raster trunks = make_ready(*files.trunks, fallback_crs, *output);
  if (!trunks.note.empty()) notes.push_back(trunks.note);
  if (!lie_alike(tops, trunks))
    notes.push_back(files.trunks->string() + " has another extent or resolution than " + files.tops.string() +
                    ": below each cell of that, the height of the nearest trunk is taken");
  canopy.trunk_m = trunks_below(canopy, trunks, wanted, origin_m, stop);
  return {std::move(canopy), std::move(notes)};
}

}  // namespace farlod::georeference
