// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/written_run.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#ifdef FARLOD_WITH_GDAL
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
  return {quantity_name(options.evaluation.weight), options.evaluation.bounds ? BoundsColumns::yes : BoundsColumns::no};
}

RasterFrame frame_of(const RasterPlan& plan, const SvfOptions& options, const PackageDescription& package, std::size_t threads) {
  return {plan.north_west_m,
          plan.step_m,
          plan.columns,
          plan.rows,
          options.evaluation.bounds ? RasterBands::svf_and_bounds : RasterBands::svf,
          quantity_name(options.evaluation.weight),
          package.crs_wkt,
          package.epsg,
          threads};
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

/// Points as the library takes them, with their names.
struct NamedPoints {
  std::vector<std::string> ids;
  std::vector<double> x_m, y_m, z_m;  ///< no height is NaN

  explicit NamedPoints(std::vector<RequestedPoint> points) {
    for (RequestedPoint& p : points) {
      ids.push_back(std::move(p.id));
      x_m.push_back(p.x);
      y_m.push_back(p.y);
      z_m.push_back(p.z.value_or(std::nan("")));
    }
  }
};

void move_to_package_crs(NamedPoints& named, const std::string& crs, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  std::vector<Point2d> points;
  for (std::size_t n = 0; n < named.ids.size(); ++n) points.push_back({named.x_m[n], named.y_m[n]});
  points = to_projected(points, crs, package.crs_wkt);
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

NamedPoints read_points(const SvfOptions& options, const PackageDescription& package) {
  NamedPoints named(options.source == ReceiverSource::at ? std::vector{options.at} : read_points_csv(options.points_file));
  if (!options.points_crs.empty()) move_to_package_crs(named, options.points_crs, package);
  return named;
}

std::optional<double> known(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }
std::optional<double> known(const std::vector<float>& values, std::size_t n) {
  return values.empty() ? std::nullopt : known(static_cast<double>(values[n]));
}

PointRows rows_of(const NamedPoints& named, const PointAnswers& answers) {
  return {named.ids.size(), [&](std::size_t n) {
            return PointRow{named.ids[n],          {named.x_m[n], named.y_m[n]}, known(answers.height_m[n]),
                            known(answers.svf, n), known(answers.low, n),        known(answers.high, n)};
          }};
}

/// What is wrong with a point of a file is wrong with an input, and no mistake of ours.
PointAnswers evaluate_named(const Package& package, const NamedPoints& named, const SvfOptions& options, const RunSettings& run) {
  try {
    return evaluate_points(package, {named.x_m, named.y_m, named.z_m}, options.placing, options.evaluation, run);
  } catch (const InvalidPoint& error) {
    throw PointsError("point " + named.ids[error.index()] +
                      " lies nowhere on Earth: check its coordinates, and its CRS (--points-crs)");
  }
}

}  // namespace

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

WrittenRun write_raster(const Package& package, const SvfOptions& options, RunSettings run) {
  const RasterPlan plan = plan_raster(package, options.grid_step_m, options.bbox_projected);
  const RasterFrame frame = frame_of(plan, options, package.description(), run.threads);
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
  const NamedPoints named = read_points(options, package.description());
  // A point with its id; the library counts its answers
  run.caller_bytes = named.ids.size() * (sizeof(std::string) + 3 * sizeof(double));
  const PointAnswers answers = evaluate_named(package, named, options, run);
  WrittenRun written{answers.summary, {options.output}};
  written.write_s =
      seconds_of([&] { options.format->write_points(rows_of(named, answers), answer_columns(options), options.output); });
  return written;
}

WrittenRun write_surfaces(const Package& package, const SvfOptions& options, const RunSettings& run) {
  const auto writer = options.format->surface_tables_writer(answer_columns(options), options.output);
  const SurfaceMeans means = evaluate_surfaces(
      package, options.surfaces, options.evaluation,
      [&](std::size_t cell, std::span<const SurfacePoint> points) { writer->write_part(cell, points); }, run);
  WrittenRun written{means.summary};
  written.write_s = seconds_of([&] { written.files = writer->commit(means.surfaces, means.buildings); });
  return written;
}

}  // namespace farlod
