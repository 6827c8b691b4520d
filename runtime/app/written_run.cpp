// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/written_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "app/result_provenance.hpp"
#include "contract/lower_case.hpp"
#include "farlod/error.hpp"
#include "farlod/hemisphere.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "points/point_reader.hpp"
#include "results/picture/sky_picture.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/point_reader_gdal.hpp"
#include "results/reproject_gdal.hpp"
#endif

namespace farlod {
namespace {

/// Calls `work`, and returns its seconds.
template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

AnswerColumns answer_columns(const SvfOptions& options) {
  return {quantity_name(options.evaluation.weight), options.evaluation.bounds ? BoundsColumns::yes : BoundsColumns::no,
          columns_of(options.evaluation.further)};
}

std::vector<Band> bands_of_run(const SvfOptions& options) {
  std::vector<Band> bands = svf_bands(quantity_name(options.evaluation.weight),
                                      options.evaluation.bounds ? RasterBands::svf_and_bounds : RasterBands::svf);
  for (const std::string& column : columns_of(options.evaluation.further)) bands.push_back(further_band(column));
  return bands;
}

RasterFrame frame_of(const RasterPlan& plan, const SvfOptions& options, const Package& package, std::size_t threads) {
  return {plan.north_west_m,
          plan.step_m,
          plan.columns,
          plan.rows,
          bands_of_run(options),
          package.description().crs_wkt,
          package.description().epsg,
          threads,
          provenance_of(options),
          &package};
}

TableFrame frame_of(const AnswerColumns& columns, const SvfOptions& options, const PackageDescription& package) {
  return {columns, package.crs_wkt, package.epsg, package.convergence, provenance_of(options)};
}

/// The files of a raster, which are written tile by tile while its cells are evaluated.
class RasterFiles {
 public:
  void add(const OutputFormat& format, const RasterFrame& frame, const std::filesystem::path& path) {
    writers_.push_back(format.raster_writer(frame, path));
    paths_.push_back(path);
    bytes_ += format.raster_writer_bytes(frame);
  }
  void write(const RasterTile& tile) const {
    for (const auto& writer : writers_) writer->write(tile);
  }
  [[nodiscard]] const std::vector<std::filesystem::path>& commit() const {
    for (const auto& writer : writers_) writer->commit();
    return paths_;
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::vector<std::unique_ptr<RasterWriter>> writers_;
  std::vector<std::filesystem::path> paths_;
  std::uint64_t bytes_ = 0;
};

/// Points as the library takes them, and what is written of them besides.
struct NamedPoints {
  std::vector<std::string> ids;
  std::vector<double> x_m, y_m, z_m;  ///< no height is NaN
  std::vector<Angle> azimuth, tilt;   ///< empty where the file has none; no normal is NaN
  Attributes attributes;
  std::vector<std::string> notes;
  std::size_t skipped_features = 0;

  explicit NamedPoints(RequestedPoints requested)
      : attributes(std::move(requested.attributes)),
        notes(std::move(requested.notes)),
        skipped_features(requested.skipped_features) {
    for (RequestedPoint& p : requested.points) {
      ids.push_back(std::move(p.id));
      x_m.push_back(p.x);
      y_m.push_back(p.y);
      z_m.push_back(p.z.value_or(std::nan("")));
      if (!requested.has_normals) continue;
      const RequestedNormal normal = p.normal.value_or(RequestedNormal{std::nan(""), std::nan("")});
      azimuth.push_back(Angle::degrees(normal.azimuth_deg));
      tilt.push_back(Angle::degrees(normal.tilt_deg));
    }
  }
  /// Leaves out the points outside of a region.
  void keep(const Region& region) {
    std::vector<std::size_t> kept;
    for (std::size_t n = 0; n < ids.size(); ++n)
      if (region.contains({x_m[n], y_m[n]})) kept.push_back(n);
    if (kept.size() == ids.size()) return;
    const std::size_t outside = ids.size() - kept.size();
    const auto choose = [&kept](auto& values) {
      if (values.empty()) return;
      for (std::size_t k = 0; k < kept.size(); ++k)
        if (kept[k] != k) values[k] = std::move(values[kept[k]]);
      values.resize(kept.size());
    };
    choose(ids);
    choose(x_m);
    choose(y_m);
    choose(z_m);
    choose(azimuth);
    choose(tilt);
    attributes = attributes.rows(kept);
    notes.push_back(std::to_string(outside) + (outside == 1 ? " point lies outside of the mask or box, and was left out."
                                                            : " points lie outside of the mask or box, and were left out."));
  }
  [[nodiscard]] bool has_normals() const { return !tilt.empty(); }
  [[nodiscard]] Points points() const { return {x_m, y_m, z_m, azimuth, tilt}; }
  /// What it holds for each point, more or less: short ids lie within their string.
  [[nodiscard]] std::size_t bytes() const {
    return ids.size() * (sizeof(std::string) + (has_normals() ? 5 : 3) * sizeof(double)) + attributes.bytes();
  }
};

void move_to_package_crs(NamedPoints& named, const std::string& crs, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  std::vector<Point2d> points;
  for (std::size_t n = 0; n < named.ids.size(); ++n) points.push_back({named.x_m[n], named.y_m[n]});
  points = reprojected(points, crs, package.crs_wkt);
  for (std::size_t n = 0; n < points.size(); ++n) {
    named.x_m[n] = points[n].x;
    named.y_m[n] = points[n].y;
  }
#else
  throw PointsError("--points-crs " + crs +
                    " needs GDAL, which this farlod-svf was built without: give the points in the CRS of the "
                    "package (" +
                    package.crs_name + "), of which there are " + std::to_string(named.ids.size()) + ".");
#endif
}

/// The CRS that the user names wins: many a GeoJSON is in another one than it must be.
std::string crs_of(const RequestedPoints& read, const SvfOptions& options, std::vector<std::string>& notes) {
  const std::string file = options.points_file.string();
  std::string own = read.crs_wkt.value_or("");
  if (!options.points_crs.empty()) {
    if (!own.empty())
      notes.push_back("The points of " + file + " were taken to be in " + options.points_crs +
                      " (--points-crs), whatever it says itself.");
    return options.points_crs;
  }
  if (read.crs_wkt && own.empty())
    notes.push_back(file + " says no CRS: its points were taken to be in that of the package (--points-crs names another).");
  return own;
}

RequestedPoints read_points(const std::filesystem::path& file, const std::string& layer) {
#ifdef FARLOD_WITH_GDAL
  if (is_vector_file(file)) return read_points_gdal(file, layer);
#else
  if (const std::string ending = lower_case(file.extension().string());
      ending == ".gpkg" || ending == ".geojson" || ending == ".shp" || ending == ".fgb")
    throw PointsError(file.string() + " needs GDAL, which this farlod-svf was built without: give the points as CSV.");
#endif
  if (!layer.empty()) throw PointsError(file.string() + " is a table: it has no layers (--points-layer)");
  return read_points_csv(file);
}

RequestedPoints read_lines(const SvfOptions& options, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  return read_lines_gdal(options.points_file, options.points_layer,
                         {options.surfaces.spacing_m, options.points_crs, package.crs_wkt});
#else
  throw PointsError(options.points_file.string() + " needs GDAL, which this farlod-svf was built without: give points of " +
                    package.crs_name + " as CSV (--points).");
#endif
}

NamedPoints requested_points(const SvfOptions& options, const PackageDescription& package) {
  if (options.source == ReceiverSource::at) {
    RequestedPoints one;
    one.points = {options.at};
    return NamedPoints(std::move(one));
  }
  if (options.source == ReceiverSource::lines) return NamedPoints(read_lines(options, package));
  RequestedPoints read = read_points(options.points_file, options.points_layer);
  const std::string crs = crs_of(read, options, read.notes);
  NamedPoints named(std::move(read));
  if (!crs.empty()) move_to_package_crs(named, crs, package);
  return named;
}

bool has_column(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::any_of(names, [&](const std::string& n) { return lower_case(n) == lower_case(name); });
}

/// An attribute that is called like one of our columns comes back under another name: a measured `svf` beside the computed one.
void rename_attributes_that_clash(NamedPoints& named, const AnswerColumns& columns) {
  const std::vector<std::string> own = own_columns_of_points(named.has_normals(), columns);
  for (std::size_t k = 0; k < named.attributes.names().size(); ++k) {
    const std::string name = named.attributes.names()[k];
    if (!has_column(own, name)) continue;
    std::string free = name + "_input";
    while (has_column(own, free) || has_column(named.attributes.names(), free)) free += "_input";
    named.attributes.rename(k, free);
    named.notes.push_back("The field \"" + name + "\" of the points comes back as \"" + free +
                          "\": a column of the output has its name.");
  }
}

std::optional<double> known(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }
std::optional<double> known(const std::vector<float>& values, std::size_t n) {
  return values.empty() ? std::nullopt : known(static_cast<double>(values[n]));
}

std::optional<double> known_degrees(const std::vector<Angle>& angles, std::size_t n) {
  return angles.empty() ? std::nullopt : known(angles[n].degrees());
}

PointRows rows_of(const NamedPoints& named, const PointAnswers& answers) {
  const auto row = [&](std::size_t n) {
    const std::size_t columns = answers.further.size() / named.ids.size();
    return PointRow{named.ids[n],
                    {named.x_m[n], named.y_m[n]},
                    known(answers.height_m[n]),
                    known(answers.svf, n),
                    known(answers.low, n),
                    known(answers.high, n),
                    known_degrees(named.azimuth, n),
                    known_degrees(named.tilt, n),
                    std::span(answers.further).subspan(n * columns, columns)};
  };
  return {named.ids.size(), row, &named.attributes, named.has_normals()};
}

/// What is wrong with a point of a file is wrong with an input, and no mistake of ours.
PointAnswers evaluate_named(const Package& package, const NamedPoints& named, const SvfOptions& options, const RunSettings& run) {
  try {
    return evaluate_points(package, named.points(), options.placing, options.evaluation, run);
  } catch (const InvalidPoint& error) {
    throw PointsError("point " + named.ids[error.index()] +
                      " lies nowhere on Earth: check its coordinates, and its CRS (--points-crs)");
  }
}

}  // namespace

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

/// Of a raster: a mask needs no pixels around it.
std::optional<Box2d> extent_of(const SvfOptions& options) {
  if (options.bbox_projected || options.evaluation.region == nullptr) return options.bbox_projected;
  return options.evaluation.region->outline();
}

WrittenRun write_raster(const Package& package, const SvfOptions& options, RunSettings run) {
  const RasterPlan plan = plan_raster(package, options.grid_step_m, extent_of(options));
  const RasterFrame frame = frame_of(plan, options, package, run.threads);
  RasterFiles files;
  files.add(*options.format, frame, options.output);
  if (options.preview_format != nullptr) files.add(*options.preview_format, frame, options.preview_file);
  run.caller_bytes = files.bytes();
  WrittenRun written;
  written.summary = evaluate_raster(
      package, plan, options.placing, options.evaluation, [&files](const RasterTile& tile) { files.write(tile); }, run);
  written.write_s = seconds_of([&] { written.files = files.commit(); });
  return written;
}

WrittenRun write_points(const Package& package, const SvfOptions& options, RunSettings run) {
  const AnswerColumns columns = answer_columns(options);
  NamedPoints named = requested_points(options, package.description());
  if (options.evaluation.region) named.keep(*options.evaluation.region);
  rename_attributes_that_clash(named, columns);
  run.caller_bytes = named.bytes();  // the library counts its answers
  const PointAnswers answers = evaluate_named(package, named, options, run);
  WrittenRun written{answers.summary, {options.output}};
  written.notes = named.notes;
  written.skipped_features = named.skipped_features;
  const TableFrame frame = frame_of(columns, options, package.description());
  written.write_s = seconds_of([&] { options.format->write_points(rows_of(named, answers), frame, options.output); });
  return written;
}

WrittenRun write_sky(const Package& package, const SvfOptions& options, const RunSettings& run) {
  const Point2d place{options.at.x, options.at.y};
  const std::string coordinates = fmt::format("{:.2f}, {:.2f}", place.x, place.y);
  const auto hemisphere = look_up(package, place, options.at.z, options.placing, options.evaluation, run);
  if (!hemisphere)
    throw InputError("There is no sky to draw at " + coordinates +
                     ": the place lies inside a building, below the ground, or where there is no ground. Choose another.");
  const PackageDescription& city = package.description();
  const std::string crs = city.epsg ? "EPSG:" + std::to_string(*city.epsg) : city.crs_name;
  const SkyCaption caption{quantity_name(options.evaluation.weight),
                           fmt::format("{} ({}), {:.2f} m above sea level", coordinates, crs, hemisphere->height_m)};
  WrittenRun written{hemisphere->summary, {options.output}};
  written.write_s = seconds_of([&] { write_drawing(draw_sky(*hemisphere, options.projection, caption), options.output); });
  return written;
}

/// The further values of receivers on surfaces, row by row; NaN where there is no answer.
std::vector<float> further_of(std::span<const SurfacePoint> points, const AnswerColumns& columns) {
  std::vector<float> values;
  for (const SurfacePoint& p : points) {
    values.insert(values.end(), p.further.begin(), p.further.end());
    if (p.further.empty()) values.resize(values.size() + columns.further.size(), std::numeric_limits<float>::quiet_NaN());
  }
  return values;
}

WrittenRun write_surfaces(const Package& package, const SvfOptions& options, const RunSettings& run) {
  const AnswerColumns columns = answer_columns(options);
  const auto writer = options.format->surface_tables_writer(frame_of(columns, options, package.description()), options.output);
  const SurfaceMeans means = evaluate_surfaces(
      package, options.surfaces, options.evaluation,
      [&](std::size_t cell, std::span<const SurfacePoint> points) {
        writer->write_part(cell, points, further_of(points, columns));
      },
      run);
  WrittenRun written{means.summary};
  written.write_s = seconds_of([&] { written.files = writer->commit(means.surfaces, means.buildings); });
  return written;
}

}  // namespace farlod
