// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/points.hpp"
#include "farlod/quantities.hpp"
#include "farlod/surfaces.hpp"
#include "results/picture/histogram.hpp"

namespace farlod {

/// The values of a run that a preview draws, counted while they pass, for --histogram. Counts nothing where none is asked for.
class RunHistogram {
 public:
  explicit RunHistogram(const SvfOptions& options);

  /// The band of a raster that is drawn. NaN is no data.
  void add(std::span<const float> values);
  void add(const PointAnswers& points);
  /// Each counts by its area.
  void add(std::span<const SurfacePoint> points);
  /// Draws the histogram that the options ask for.
  void write(const SvfOptions& options) const;
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }

 private:
  bool is_wanted_;
  std::size_t drawn_ = 0;  ///< svf, and then the columns of further quantities
  ColumnDescription column_;
  ValueCounts values_, roofs_, walls_;
};

}  // namespace farlod
