// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "base/grid.hpp"
#include "evaluate/sky_answers.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The far map of a cell.
enum class FarMapOfCell {
  horizon,
  box,
  missing,          ///< the cell is one of the grid, and far maps were made for others
  needless,         ///< the city is a rough surface, over whose pixels rays march
  outside_of_grid,  ///< there are no cells, and no far maps
  all_is_near       ///< likewise, but the edges of the city are so few that all are drawn, without a far map
};

[[nodiscard]] FarMapOfCell far_map_of(const PackageReader& package, Cell cell);
/// That of every cell outside of the grid: all_is_near or outside_of_grid.
[[nodiscard]] FarMapOfCell far_map_outside_of_grid(const PackageReader& package);

/// How the receivers of a cell are answered. A direction is free when
enum class EvaluationMethod {
  horizons,               ///< it lies above the horizon, or in a gap below an overhang that no facet hides
  rays_against_horizons,  ///< the same, but facets in gaps are met by rays; asked for each of --rays directions instead of each
                          ///< azimuth
  near_scene_and_box,     ///< its ray meets no near tile, and the box far map has no occluder in this direction
  near_scene_alone,       ///< its ray meets no near tile
  whole_city,             ///< its ray meets no tile of the package
  pixels_and_whole_city   ///< it lies above the horizon of pixels; elsewhere, and for what these do not tell, as whole_city
};
inline constexpr std::size_t evaluation_method_count = 6;

/// The only place that decides which method answers a cell: the table of docs/stages/evaluate.md. Rays march over the pixels of
/// a rough surface before horizons are drawn, too.
[[nodiscard]] EvaluationMethod method_of(Engine engine, FarMapOfCell far_map);

class SkyMethod;
class ViewsAround;
struct Evaluation;
struct HemisphereDirections;
struct SkyParts;

/// Upper bound of the sampling error, without the error of the far map, where cells have far maps of this kind: that of the
/// azimuths or that of the rays, whichever is larger among those that answer there (method_of). Whether there is an allowed far
/// error counts, not how large it is.
[[nodiscard]] double sampling_error_of(const SkySettings& settings, FarMapOfCell far_map = FarMapOfCell::horizon);

/// Computes sky view factors from a package: chooses the method of each cell. Thread-safe. The same receivers give the same
/// answers whatever else is evaluated, up to the rounding of floats (docs/concepts.md, "Culling edges for a packet").
class SkyEvaluator {
 public:
  /// The package must outlive the evaluator. When `stop` is asked for, evaluate() ends with Cancelled within some milliseconds.
  SkyEvaluator(const PackageReader& package, const SkySettings& settings, const std::stop_token& stop = {});
  /// An evaluator of the same package, stopped by the same token. The two share the scene of the whole city, where they need it.
  SkyEvaluator(const SkyEvaluator& other, const SkySettings& settings);
  ~SkyEvaluator();

  /// Writes the sky view factor of each receiver, in [0, 1], by the method of the cell (method_of). Where `low` and `high` are
  /// wanted, the value for the same azimuths or rays, with jumps of the horizon at the same places, and the true far city lies
  /// between them, up to the rounding of floats
  /// (docs/concepts.md, "Bounds of a sky view factor"); bounds need far maps of the kind `horizon` or the method `whole_city`.
  /// Throws PackageUnusable where `horizons` meets a cell whose far map is missing.
  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const;
  void evaluate(const CellReceivers& cell, std::span<float> svf) const { evaluate(cell, SkyAnswers(svf)); }

  /// What the only receiver of a cell sees, direction by direction, by the method of the cell.
  [[nodiscard]] SkyParts parts_of_sky(const CellReceivers& cell, const HemisphereDirections& directions) const;

  [[nodiscard]] EvaluationStatistics statistics() const;
  [[nodiscard]] const PackageReader& package() const;
  [[nodiscard]] const SkySettings& settings() const;
  /// The columns of SkyAnswers::further.
  [[nodiscard]] std::size_t further_columns() const;

 private:
  explicit SkyEvaluator(std::unique_ptr<const Evaluation> evaluation);
  [[nodiscard]] const SkyMethod& method_for(Cell cell) const;
  /// The horizons of the receivers are answered already.
  void find_horizon_distances(const CellReceivers& cell, const SkyAnswers& answers) const;
  void find_shadow_patches(const CellReceivers& cell, const SkyAnswers& answers) const;
  void find_views(const CellReceivers& cell, const SkyAnswers& answers) const;
  void find_building(const CellReceivers& cell, const SkyAnswers& answers) const;

  std::unique_ptr<const Evaluation> evaluation_;
  std::array<std::unique_ptr<const SkyMethod>, evaluation_method_count> methods_;
  std::unique_ptr<const ViewsAround> around_;  ///< null where nobody asks for a cube or a sphere
  std::vector<Point3d> eye_directions_;        ///< empty where nobody asks for Quantities::view_eye
};

/// Sky view factors of receivers by their numbers, with bounds where they are wanted (otherwise `low` and `high` are empty).
struct SvfValues {
  static constexpr float no_data = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> svf, low, high;
  std::vector<float> further;  ///< the values of SkySettings::further, receiver by receiver
  std::size_t further_columns = 0;
  RayCounts counts = {};

  SvfValues(std::size_t size, bool bounds, std::size_t columns = 0)
      : svf(size, no_data),
        low(bounds ? size : 0, no_data),
        high(low),
        further(size * columns, no_data),
        further_columns(columns) {}
  /// Those of the n-th receiver.
  [[nodiscard]] std::span<const float> further_of(std::size_t n) const {
    return std::span(further).subspan(n * further_columns, further_columns);
  }
  /// The n-th of `svf`, `low` or `high`; nothing where it is no data, or where bounds are not wanted.
  [[nodiscard]] static std::optional<double> value(const std::vector<float>& values, std::size_t n) {
    return values.empty() || std::isnan(values[n]) ? std::nullopt : std::optional<double>(values[n]);
  }
};

/// The cells of a run, in their order, and what becomes of their answers.
class CellsOfRun {
 public:
  virtual ~CellsOfRun() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual Cell place(std::size_t n) const = 0;
  /// About how many receivers the n-th cell has, before they are placed.
  [[nodiscard]] virtual double receivers_about(std::size_t n) const = 0;
  /// The receivers of the n-th cell: the same at each call, on any thread.
  [[nodiscard]] virtual CellReceivers receivers(std::size_t n) = 0;
  /// Takes the values of the n-th cell, which are in the order of its receivers. Called for one cell at a time, in the order of
  /// the cells.
  virtual void store(std::size_t n, const CellReceivers& cell, const SvfValues& values) = 0;
};

/// Evaluates all receivers of a cell. The values are in the order of the receivers, whatever their indices.
[[nodiscard]] inline SvfValues values_of(const SkyEvaluator& evaluator, CellReceivers cell, bool bounds) {
  SvfValues values(cell.receivers.size(), bounds, evaluator.further_columns());
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) cell.receivers[k].index = k;
  SkyAnswers answers(values.svf, values.low, values.high, values.further);
  answers.counts = &values.counts;
  evaluator.evaluate(cell, answers);
  return values;
}

}  // namespace farlod
