// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farlod/quantities.hpp"

namespace farlod {

/// What can be computed beside the sky view factor, in the order of its columns.
enum class Quantity : std::uint8_t {
  svf_solid,
  directional,
  hidden,
  horizon,
  horizon_distance,
  sky_patches,
  sunlit,
  sunlit_total,
  shadow_patches,
  irradiation,
  irradiance,
  illuminance,
  shade,
  sky_component,
  view_factors,
  view_factors_below,
  view_cube,
  view_sphere,
  view_eye,
  view_building,
  svf_total,
  svfaveg,
  directional_vegetation,
  shares
};

class FurtherQuantities;
struct ProfiledPacket;
class QuantityColumns;
struct CanopyAnswer;

/// Takes the values of a receiver, one by one.
class ValuesOfReceiver {
 public:
  explicit ValuesOfReceiver(std::span<float> values) : values_(values) {}

  void add(float value) { values_[count_++] = value; }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::span<float> values_;
  std::size_t count_ = 0;
};

/// A row of the table of quantities. A new quantity is a member of Quantities, a value of Quantity, and a row with its functions,
/// of which one computes: `add`, or `add_of_crowns` in the last rows. Options, help, messages, the key of results, rasters and
/// tables go by the rows; only a number that is chosen besides, as of horizons, needs an option and its place in the key
/// (runtime/app/quantity_options.cpp, result_key.cpp). Tests hold the lists of Python (python/src/farlod/_settings.py), QGIS
/// (qgis/farlod/evaluation.py) and docs/stages/evaluate.md to the rows.
struct QuantityRow {
  Quantity quantity{};
  QuantityWord word;
  bool (*is_asked)(const Quantities&) = nullptr;
  void (*ask)(Quantities&) = nullptr;  ///< with as many values as are usual
  void (*describe)(const Quantities&, std::vector<ColumnDescription>&) = nullptr;
  /// Adds the columns of a packet, from its profile.
  void (FurtherQuantities::*add)(const ProfiledPacket&, QuantityColumns&) const = nullptr;
  /// Adds the values of a receiver whose svf is known, from what crowns do to its view.
  void (*add_of_crowns)(const Quantities&, float svf, const CanopyAnswer&, ValuesOfReceiver&) = nullptr;
};

[[nodiscard]] std::span<const QuantityRow> quantity_table();

/// Where the columns of a quantity are among columns_of; none where it is not asked for.
struct ColumnRange {
  std::size_t first = 0, count = 0;
};
[[nodiscard]] ColumnRange range_of(Quantity quantity, const Quantities& quantities);
/// The last columns of columns_of: those of crowns.
[[nodiscard]] ColumnRange range_of_crowns(const Quantities& quantities);

/// Patches of each band from the horizon upwards, without the zenith, and the bands' height as a share of the right angle. A band
/// of Reinhart's is half of one of Tregenza's, with twice as many patches; the zenith takes what is left.
struct PatchBands {
  std::vector<std::uint32_t> counts;
  double height = 0.0;
};
[[nodiscard]] PatchBands patch_bands_of(SkyPatchSet set);

/// Where svf_total is among columns_of, and its lower bound, which the upper one follows; nothing where they are not.
struct TotalColumns {
  std::optional<std::size_t> total, low;
};
[[nodiscard]] TotalColumns total_columns_of(const Quantities& quantities);

}  // namespace farlod
