// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "benchmark/contest.hpp"
#include "package/package_reader.hpp"
#include "receivers/raster_receivers.hpp"

namespace farlod::benchmark {

/// What raster tools make of a city: the highest surface and the ground at the centre of each pixel, row by row from the
/// north-west. Heights as on disk; nothing is at −∞.
struct HeightRaster {
  RasterPlan plan;
  std::vector<float> surface_m, ground_m;
};
[[nodiscard]] HeightRaster rasterise(const PackageReader& package, double pixel_m);

/// Sky view factors of a raster by sweeping lines over it (Timonen & Westerholm, Scalable height field self-shadowing, 2010).
///
/// For each azimuth, parallel lines one pixel apart run over the raster towards the receivers, so that each pixel lies on one of
/// them. A line keeps the upper convex hull of what it has passed: only its corners can be a horizon, and each pixel enters and
/// leaves it once. The factor is the mean of cos² of the horizon's elevation; nothing is cut off at a radius. A pixel is a post
/// with vertical faces at its borders.
class LineSweep {
 public:
  /// Receivers stand `height_m` above the ground of each pixel that nothing stands on.
  LineSweep(const HeightRaster& raster, float height_m);

  [[nodiscard]] std::size_t receiver_count() const;
  /// For each pixel, on all cores; 0 where there is no receiver.
  [[nodiscard]] std::vector<float> sky_view_factors(std::size_t azimuths) const;

 private:
  /// Heights of surfaces and of eyes, so laid that lines run along its rows rather than across them. No eye is at +∞: it sees
  /// all.
  struct Field {
    std::size_t columns = 0, rows = 0;
    std::vector<float> surface_m, eye_m;
  };
  [[nodiscard]] static Field transposed(const Field& field);
  void sweep(const Field& field, double column_step, double row_step, std::vector<float>& sums) const;

  double pixel_m_;
  Field field_, transposed_;
};

/// A line sweep over the whole city's raster at so many azimuths.
struct SweepRow {
  std::size_t azimuths = 0;
  Errors errors;  ///< at the receivers of the ground contest that have a pixel without a building
  double seconds = 0.0;
};
struct SweepStudy {
  double pixel_m = 0.0, raster_s = 0.0;  ///< making the raster is not part of a row's time
  std::size_t pixels = 0, receivers = 0, compared = 0;
  std::vector<SweepRow> rows;
};
[[nodiscard]] SweepStudy study_sweep(const City& city, const Extent& extent);

}  // namespace farlod::benchmark
