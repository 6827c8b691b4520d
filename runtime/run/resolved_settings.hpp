// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "evaluate/sky_evaluator.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/run.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// The settings of a run, checked, with what follows from them.
struct ResolvedSettings {
  SkySettings sky;
  Accuracy accuracy;
  bool bounds = false;
  std::size_t verify = 0;
  bool dry_run = false;
  std::size_t threads = 1;
  std::shared_ptr<const Region> region;  ///< null: everywhere
  std::optional<double> within_m;        ///< of pixels: EvaluationSettings::within_m
  RunSettings run;

  [[nodiscard]] bool wants(Point2d p_projected) const { return region == nullptr || region->contains(p_projected); }
};

/// Throws InvalidArgument where a setting is not what its declaration promises. Half of an allowed error is for the sky between
/// the samples, half for what the far map does not decide; where the caller fixes the samples, the map gets what they leave.
[[nodiscard]] ResolvedSettings resolved(const EvaluationSettings& evaluation, const RunSettings& run);

/// The same for a height, which counts from 1 cm upwards: on the surface itself a receiver would see nothing but that surface.
[[nodiscard]] Placing resolved(const Placing& placing);

/// The height of a placing as the receivers of a package count it: above sea level, it counts from the package's height origin.
[[nodiscard]] float package_height_m(const Placing& placing, const package::Manifest& manifest);

}  // namespace farlod
