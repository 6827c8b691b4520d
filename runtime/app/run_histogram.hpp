// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/surfaces.hpp"
#include "results/picture/histogram.hpp"

namespace farlod {

/// The values of a run, counted while they pass, for --histogram. Counts nothing where none is asked for.
class RunHistogram {
 public:
  explicit RunHistogram(const SvfOptions& options) : is_wanted_(!options.histogram_file.empty()) {}

  /// NaN is no data.
  void add(std::span<const float> values);
  /// Each counts by its area.
  void add(std::span<const SurfacePoint> points);
  /// Draws the histogram that the options ask for.
  void write(const SvfOptions& options) const;
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }

 private:
  bool is_wanted_;
  ValueCounts values_, roofs_, walls_;
};

}  // namespace farlod
