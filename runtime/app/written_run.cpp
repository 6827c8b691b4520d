// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/written_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "app/answered_points.hpp"
#include "app/named_points.hpp"
#include "app/picture_options.hpp"
#include "app/result_key.hpp"
#include "app/run_histogram.hpp"
#include "console/machine_limit.hpp"
#include "console/progress.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/table/energyplus_idf.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

AnswerColumns answer_columns(const SvfOptions& options) {
  return {quantity_name(options.evaluation.weight), options.evaluation.bounds ? BoundsColumns::yes : BoundsColumns::no,
          column_descriptions_of(options.evaluation.further),
          options.surfaces.irradiation_threshold_kwh_m2 ? ThresholdColumns::yes : ThresholdColumns::no};
}

std::vector<Band> bands_of_run(const SvfOptions& options) {
  std::vector<Band> bands = svf_bands(quantity_name(options.evaluation.weight),
                                      options.evaluation.bounds ? RasterBands::svf_and_bounds : RasterBands::svf);
  const std::vector<ColumnDescription> further = column_descriptions_of(options.evaluation.further);
  bands.insert(bands.end(), further.begin(), further.end());
  return bands;
}

/// Why pixels were not asked for, as the legend of a picture says it.
std::string words_of_left_out(const SvfOptions& options) {
  const auto& within_m = options.evaluation.within_m;
  if (!within_m) return options.mask_file.empty() ? "" : "outside of the mask";
  return options.mask_file.empty() ? fmt::format("not within {:g} m", *within_m) : "not asked for";
}

/// The building whose view a band is.
std::string landmark_of(const SvfOptions& options, const Band& band) {
  const bool is_of_building = band.name == "view_building" || band.name == "sees_building";
  return is_of_building ? options.evaluation.further.seen_building.value_or("") : "";
}

RasterFrame frame_of(const RasterPlan& plan, const SvfOptions& options, const Package& package, std::size_t threads) {
  std::vector<Band> bands = bands_of_run(options);
  const std::size_t drawn = drawn_band_of(options, bands);
  std::string conditions = conditions_of(options, bands[drawn].name), landmark = landmark_of(options, bands[drawn]);
  return {plan.north_west_m,
          plan.step_m,
          plan.columns,
          plan.rows,
          std::move(bands),
          package.description().crs_wkt,
          package.description().epsg,
          threads,
          provenance_of(options, package.description()),
          &package,
          drawn,
          std::move(conditions),
          words_of_left_out(options),
          std::move(landmark)};
}

TableFrame frame_of(const AnswerColumns& columns, const SvfOptions& options, const Package& package) {
  const PackageDescription& city = package.description();
  return {columns, city.crs_wkt, city.epsg, city.convergence, provenance_of(options, city), &package};
}

bool draws_errors(const SvfOptions& options) { return options.verify_format != nullptr && options.verify_format->is_picture; }

/// What is verified, and what a map of errors shows.
RasterFrame with_svf_drawn(RasterFrame frame) {
  frame.drawn_band = 0;
  frame.conditions = {};
  frame.landmark = {};
  return frame;
}

/// Larger rasters are averaged.
constexpr auto most_pixels_of_picture = static_cast<double>(longest_preview_edge * longest_preview_edge);

/// The bytes of a table of receivers, with their places.
double bytes_of_table(const OutputFormat& format, const AnswerColumns& columns, std::size_t further_columns, double rows) {
  constexpr std::size_t svf = 1, bounds = 2;
  const std::size_t answers = svf + (columns.bounds == BoundsColumns::yes ? bounds : 0) + columns.further.size();
  return rows * (format.bytes_of_row + static_cast<double>(answers + further_columns) * format.bytes_of_value);
}

/// The files of a raster, which are written tile by tile while its cells are evaluated.
class RasterFiles {
 public:
  /// Files that are only planned take as much of an estimate, and nothing else.
  void plan(const OutputFormat& format, const RasterFrame& frame) {
    bytes_ += format.raster_writer_bytes(frame);
    const double pixels = static_cast<double>(frame.columns) * static_cast<double>(frame.rows);
    const double values =
        format.is_picture ? std::min(pixels, most_pixels_of_picture) : pixels * static_cast<double>(frame.bands.size());
    output_bytes_ += values * format.bytes_of_pixel;
  }
  void add(const OutputFormat& format, const RasterFrame& frame, const std::filesystem::path& path) {
    writers_.push_back(format.raster_writer(frame, path));
    paths_.push_back(path);
    plan(format, frame);
  }
  void write(const RasterTile& tile) const {
    for (const auto& writer : writers_) writer->write(tile);
  }
  [[nodiscard]] const std::vector<std::filesystem::path>& commit() const {
    for (const auto& writer : writers_) writer->commit();
    return paths_;
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] double output_bytes() const { return output_bytes_; }

 private:
  std::vector<std::unique_ptr<RasterWriter>> writers_;
  std::vector<std::filesystem::path> paths_;
  std::uint64_t bytes_ = 0;
  double output_bytes_ = 0.0;
};

/// The extent of a raster: a mask needs no pixels around it.
std::optional<Box2d> extent_of(const SvfOptions& options) {
  if (options.bbox_projected || options.evaluation.region == nullptr) return options.bbox_projected;
  return options.evaluation.region->outline();
}

RasterPlan plan_of(const Package& package, const SvfOptions& options, [[maybe_unused]] std::vector<std::string>& notes) {
  if (options.own_pixels) {
    const RasterPlan plan = *plan_of_surface_model(package, extent_of(options));
    notes.push_back(fmt::format(
        "The city is a raster: its own pixels, {} × {} of {:g} m, are answered, {:g} m above its surface (--height). Of what "
        "lies around the raster, nothing but a --far-terrain is known: at its margin, values are those of an open surrounding.",
        plan.columns, plan.rows, plan.step_m, options.placing.height_m));
    return plan;
  }
  if (options.grid_like.empty()) return plan_raster(package, options.grid_step_m, extent_of(options));
#ifdef FARLOD_WITH_GDAL
  const RasterGrid grid = gdal_files().read_raster_grid(options.grid_like, package.description().crs_wkt);
  if (!grid.says_crs)
    notes.push_back(options.grid_like.string() + " says no CRS: its pixels were taken to be in that of the package.");
  return grid.plan;
#else
  throw PointsError(options.grid_like.string() + " needs GDAL, which this farlod-svf was built without: give --grid and --bbox.");
#endif
}

/// What SOLWEIG may miss.
void add_notes_of_kit(const Package& package, const SvfOptions& options, std::vector<std::string>& notes) {
  if (!options.format->is_solweig_kit) return;
  if (plan_of_surface_model(package))
    notes.emplace_back(
        "The city is a surface model, which knows no ground of its own: there is no dem.tif, and SOLWEIG takes yours.");
  else if (options.placing.above == HeightAbove::ground)
    notes.emplace_back("Pixels inside buildings have no data, where UMEP has the roof's: --on-surface has them.");
}

/// What the run will take without its files, whatever its limits.
RunEstimate estimate_of(const Package& package, const RasterPlan& plan, const SvfOptions& options, RunSettings run) {
  EvaluationSettings asked = options.evaluation;
  asked.dry_run = true;
  run.on_progress = nullptr;
  run.answers = nullptr;
  run.shard.reset();
  run.memory_limit_mib.reset();  // the run itself tells what it needs, with its files
  return *evaluate_raster(
              package, plan, options.placing, asked, [](const RasterTile&) {}, run)
              .estimate;
}

/// So many pixels take long, and cells of them much memory: what is needed is told before. An estimate tells the rest itself.
void tell_of_many_pixels(const Package& package, const RasterPlan& plan, const SvfOptions& options, const RunSettings& run,
                         std::vector<std::string>& notes) {
  constexpr std::uint64_t many = 100'000'000;
  const std::uint64_t pixels = std::uint64_t{plan.columns} * plan.rows;
  if (pixels < many) return;
  const std::string what = fmt::format("The raster has {} pixels ({} × {} of {:g} m)", with_commas(pixels),
                                       with_commas(plan.columns), with_commas(plan.rows), plan.step_m);
  if (options.evaluation.dry_run) {
    notes.push_back(what + ".");
    return;
  }
  if (options.run.verbosity != Verbosity::normal) return;
  const RunEstimate estimate = estimate_of(package, plan, options, run);
  constexpr double mib = 1 << 20;
  const bool is_refused = run.memory_limit_mib ? estimate.memory_bytes > mib * static_cast<double>(*run.memory_limit_mib)
                                               : is_refused_by_machine(estimate.memory_bytes);
  if (is_refused) return;
  fmt::print(stderr,
             "{}: about {} and {} of memory in all. A larger --grid or a part (--bbox) takes less; --dry-run tells it alone.\n",
             what, rough_duration(estimate.seconds), rough_size(estimate.memory_bytes / mib));
}

void tell_of_raster(const Package& package, const RasterPlan& plan, const SvfOptions& options, const RunSettings& run,
                    std::vector<std::string>& notes) {
  add_notes_of_kit(package, options, notes);
  tell_of_many_pixels(package, plan, options, run, notes);
}

void add_files(const SvfOptions& options, const RasterFrame& frame, RasterFiles& files) {
  const auto add = [&](const OutputFormat& format, const std::filesystem::path& path) {
    options.writes() ? files.add(format, frame, path) : files.plan(format, frame);
  };
  add(*options.format, options.output);
  if (options.preview_format != nullptr) add(*options.preview_format, options.preview_file);
}

/// What to tell of how the points were read, and of those that have no answer.
std::vector<std::string> notes_of_points(const NamedPoints& named, const Reasons& reasons, const PackageDescription& city) {
  std::vector<std::string> notes = named.notes;
  for (const auto& note :
       {note_of_points_beyond(named, city), note_of_heights(named, reasons, city), note_of_unanswered(named, reasons, city)})
    if (note) notes.push_back(*note);
  return notes;
}

/// Where no point has an answer since its height was taken for another one, that is what to say.
void require_heights_above_ground(const NamedPoints& named, const Reasons& reasons, const PointAnswers& answers,
                                  const PackageDescription& city) {
  if (answers.summary.receivers > 0 || count_below_open_ground(reasons) == 0) return;
  if (const auto note = note_of_heights(named, reasons, city))
    throw NoAnswer("No receiver has an answer, and nothing was written: " + *note);
}

/// Adds to the table why points have no answer, and returns all that is to be told. Throws NoAnswer where none has one.
std::vector<std::string> notes_with_reasons(const Package& package, const PointAnswers& answers, const SvfOptions& options,
                                            std::size_t threads, const AnswerColumns& columns, NamedPoints& named) {
  const PackageDescription& city = package.description();
  const Reasons reasons = reasons_of_unanswered(package, named, answers, threads);
  require_heights_above_ground(named, reasons, answers, city);
  require_answers_of_points(named, reasons, answers, options, city);
  require_answers(answers.summary, options, city);
  named.add_reasons(reasons, columns);
  std::vector<std::string> notes = notes_of_points(named, reasons, city);
  if (auto note = note_outside_of_grid(named, answers, options, city)) notes.push_back(std::move(*note));
  return notes;
}

}  // namespace

std::string quantity_name(SkyWeight weight) { return weight == SkyWeight::cosine ? "svf" : "svf_solid"; }

const char* option_of_place(const SvfOptions& options) {
  if (options.bbox_projected) return "bbox";
  if (!options.mask_file.empty()) return "mask";
  if (!options.grid_like.empty()) return "grid-like";
  constexpr std::array<const char*, 5> of_sources{"grid", "points", "along", "surfaces", "at"};
  return of_sources.at(static_cast<std::size_t>(options.source));
}

void require_answers(const EvaluationSummary& summary, const SvfOptions& options, const PackageDescription& city) {
  if (summary.estimate ? summary.estimate->receivers >= 1.0 : summary.receivers > 0) return;
  constexpr const char* nothing = "No receiver has an answer, and nothing was written";
  const Box2d& box = city.city_projected;
  const std::string place = fmt::format("The city lies from {:.0f}, {:.0f} to {:.0f}, {:.0f} in {}: check --{}.", box.low.x,
                                        box.low.y, box.high.x, box.high.y, city.crs_name, option_of_place(options));
  const std::size_t beyond = summary.beyond_grid + summary.outside_of_region;
  if (summary.no_data > 0 && options.source == ReceiverSource::surfaces)
    throw NoAnswer(fmt::format("{}: another building or the ground covers all {} receivers on surfaces{}. {}", nothing,
                               summary.no_data, beyond > 0 ? fmt::format(", and {} lie beyond the box", beyond) : "", place));
  if (options.evaluation.within_m && summary.outside_of_region > 0)
    throw NoAnswer(
        fmt::format("{}: {} inside buildings or without ground, {} farther than {:g} m from any building. Give a larger "
                    "--within, or finer pixels.",
                    nothing, summary.no_data, summary.outside_of_region, *options.evaluation.within_m));
  if (summary.no_data > 0)
    throw NoAnswer(fmt::format("{}: {} inside buildings or without ground{}. Choose other places, or --on-surface.", nothing,
                               summary.no_data, beyond > 0 ? fmt::format(", {} beyond the city", beyond) : ""));
  if (beyond > 0) throw NoAnswer(fmt::format("{}: none of {} lies in the city. {}", nothing, beyond, place));
  throw NoAnswer(fmt::format("{}: there is nothing of what was asked for. {}", nothing, place));
}

WrittenRun write_raster(const Package& package, const SvfOptions& options, RunSettings run) {
  WrittenRun written;
  const RasterPlan plan = plan_of(package, options, written.notes);
  tell_of_raster(package, plan, options, run, written.notes);
  const RasterFrame frame = frame_of(plan, options, package, run.threads);
  RasterFiles files;
  add_files(options, frame, files);
  RunHistogram histogram(options);
  std::optional<ScreenFit> fit;
  if (draws_errors(options)) fit.emplace(with_svf_drawn(frame));
  run.caller_bytes = files.bytes() + (fit ? PreviewWriter::bytes_for(frame) : 0);
  const auto take = [&](const RasterTile& tile) {
    files.write(tile);
    histogram.add(bands_of(tile)[frame.drawn_band]);
    if (fit) fit->add(tile);
  };
  written.summary = evaluate_raster(package, plan, options.placing, options.evaluation, take, run);
  written.output_bytes = files.output_bytes();
  if (!options.writes()) return written;
  require_answers(written.summary, options, package.description());
  written.write_s = seconds_of([&] {
    written.files = files.commit();
    histogram.write(options);
  });
  if (fit) written.grey_map = GreyMap{plan.north_west_m, fit->preview()};
  return written;
}

WrittenRun write_points(const Package& package, const SvfOptions& options, RunSettings run) {
  const AnswerColumns columns = answer_columns(options);
  NamedPoints named = requested_points(options, package.description());
  if (options.evaluation.region) named.keep(*options.evaluation.region);
  named.rename_attributes_that_clash(columns);
  require_any_in_reach(named, options, package.description());
  run.caller_bytes = named.bytes();  // the library counts its answers
  const PointAnswers answers = evaluate_named(package, named, options, run);
  WrittenRun written{answers.summary};
  written.notes = notes_of_points(named, {}, package.description());
  written.skipped_features = named.skipped_features;
  written.output_bytes = bytes_of_table(*options.format, columns, named.attributes.names().size() + (named.has_normals() ? 2 : 0),
                                        static_cast<double>(named.ids.size()));
  if (!options.writes()) return written;
  written.notes = notes_with_reasons(package, answers, options, run.threads, columns, named);
  written.files = {options.output};
  const TableFrame frame = frame_of(columns, options, package);
  RunHistogram histogram(options);
  histogram.add(answers);
  written.write_s = seconds_of([&] {
    options.format->write_points(rows_of(named, answers), frame, options.output);
    histogram.write(options);
  });
  return written;
}

/// A table of surfaces' receivers also has the building, the surface, its kind, azimuth, tilt and area.
WrittenRun plan_surfaces(const Package& package, const SvfOptions& options, const RunSettings& run) {
  constexpr std::size_t columns_of_surface = 6;
  WrittenRun planned{evaluate_surfaces(package, options.surfaces, options.evaluation, {}, run).summary};
  if (const auto& estimate = planned.summary.estimate)
    planned.output_bytes = bytes_of_table(*options.format, answer_columns(options), columns_of_surface, estimate->receivers);
  return planned;
}

WrittenRun write_surfaces(const Package& package, const SvfOptions& options, const RunSettings& run) {
  if (!options.writes()) return plan_surfaces(package, options, run);
  const auto writer = options.format->surface_tables_writer(frame_of(answer_columns(options), options, package), options.output);
  RunHistogram histogram(options);
  const auto take = [&](std::size_t cell, std::span<const SurfacePoint> points) {
    writer->write_part(cell, points);
    histogram.add(points);
  };
  const SurfaceMeans means = evaluate_surfaces(package, options.surfaces, options.evaluation, take, run);
  WrittenRun written{means.summary};
  require_answers(written.summary, options, package.description());
  if (!options.matrix_file.empty()) written.matrix = write_matrix(package, options, means, run);
  written.write_s = seconds_of([&] {
    if (!options.energyplus_file.empty())
      write_energyplus_idf(means.surfaces, columns_of(options.evaluation.further), options.energyplus_file);
    written.files = writer->commit(means.surfaces, means.buildings);
    histogram.write(options);
  });
  if (written.matrix) written.files.push_back(options.matrix_file);
  if (!options.energyplus_file.empty()) written.files.push_back(options.energyplus_file);
  return written;
}

}  // namespace farlod
