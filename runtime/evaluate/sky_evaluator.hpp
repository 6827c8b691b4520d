// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>

#include "evaluate/evaluation_method.hpp"
#include "evaluate/sky_answers.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

class SkyMethod;
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
  /// Throws PackageUnusable where `horizons_alone` meets a receiver that may see too much sky below an overhang, or a cell
  /// whose far map is missing.
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

  std::unique_ptr<const Evaluation> evaluation_;
  std::array<std::unique_ptr<const SkyMethod>, evaluation_method_count> methods_;
};

}  // namespace farlod
