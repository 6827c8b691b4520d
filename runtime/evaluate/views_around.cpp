// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/views_around.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "evaluate/sky_evaluator.hpp"
#include "evaluate/view_columns.hpp"
#include "farlod/angle.hpp"

namespace farlod {
namespace {

Point3f normal_of(const FaceOfCube& face, const package::Manifest& manifest) {
  if (face.normal_z != 0.0) return {0.0F, 0.0F, static_cast<float>(face.normal_z)};
  // true azimuth = grid azimuth + convergence
  const Angle azimuth = Angle::degrees(face.azimuth_deg) - manifest.convergence;
  const Point2d n = manifest.grid.rotation.grid_from_city(Point2d{sin(azimuth), cos(azimuth)});
  return {static_cast<float>(n.x), static_cast<float>(n.y), 0.0F};
}

SkySettings settings_of_views(const SkySettings& settings, SkyWeight weight) {
  SkySettings views = settings;
  views.weight = weight;
  views.allowed_error.reset();  // it is that of svf
  views.further = {.view_factors = true, .wall_sectors = settings.further.wall_sectors, .canopy = settings.further.canopy};
  return views;
}

/// The view factors of receivers at the same places that look elsewhere.
SvfValues views_towards(const Point3f& normal, const CellReceivers& cell, const SkyEvaluator& evaluator) {
  CellReceivers turned = cell;
  for (Receiver& r : turned.receivers) r.normal = normal;
  return values_of(evaluator, std::move(turned), false);
}

}  // namespace

ViewsAround::ViewsAround(const SkyEvaluator& evaluator) {
  const SkySettings& asked = evaluator.settings();
  const auto evaluator_of = [&](SkyWeight weight) {
    return std::make_unique<const SkyEvaluator>(evaluator, settings_of_views(asked, weight));
  };
  if (asked.further.view_cube) faces_ = evaluator_of(SkyWeight::cosine);
  if (asked.further.view_sphere) halves_ = evaluator_of(SkyWeight::solid_angle);
  for (const FaceOfCube& face : faces_of_cube) normals_.push_back(normal_of(face, evaluator.package().manifest()));
}

ViewsAround::~ViewsAround() = default;

void ViewsAround::store(const CellReceivers& cell, const FurtherQuantities& quantities, const SkyAnswers& answers) const {
  /// Adds a share of what the n-th receiver sees to its columns from `first` on.
  const auto add = [&](const SvfValues& found, std::size_t first, float share) {
    for (std::size_t n = 0; n < cell.receivers.size(); ++n) {
      const std::span<float> columns = answers.further.subspan(cell.receivers[n].index * quantities.size() + first);
      const std::span<const float> views = found.further_of(n);
      for (std::size_t c = 0; c < views.size(); ++c) columns[c] += share * views[c];
    }
  };
  const auto clear = [&](const ColumnRange& range) {
    for (const Receiver& r : cell.receivers)
      std::ranges::fill(answers.further.subspan(r.index * quantities.size() + range.first, range.count), 0.0F);
  };
  const ViewRanges& ranges = quantities.view_columns();
  clear(ranges.cube);
  clear(ranges.sphere);
  const std::size_t of_face = ranges.cube.count / faces_of_cube.size();
  for (std::size_t n = 0; n < faces_of_cube.size() && faces_; ++n)
    add(views_towards(normals_[n], cell, *faces_), ranges.cube.first + n * of_face, 1.0F);
  // The first two normals are up and down
  for (std::size_t n = 0; n < 2 && halves_; ++n) add(views_towards(normals_[n], cell, *halves_), ranges.sphere.first, 0.5F);
}

}  // namespace farlod
