// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "evaluate/verification.hpp"
#include "farlod/point.hpp"
#include "package/package_reader.hpp"
#include "receivers/point_receivers.hpp"
#include "validation/studied_city.hpp"

namespace farlod::validation {

/// A receiver that belongs to no grid, so that the same may be asked of many packages of a city.
struct Site {
  Point3d p_city;  ///< absolute height
  Point3d normal_city{0.0, 0.0, 1.0};
};

/// Random places of some cells, 1.5 m above the ground and outside of buildings.
[[nodiscard]] std::vector<Site> ground_sites(const PackageReader& package, std::span<const Cell> cells, std::size_t count);
/// Random places on the roofs or walls in some cells, party walls left out; all that there are when they are fewer.
[[nodiscard]] std::vector<Site> surface_sites(const PackageReader& package, std::span<const Cell> cells, SurfaceChoice choice,
                                              std::size_t count);

[[nodiscard]] std::vector<Cell> all_cells(const Grid& grid);
/// The cells in which sites stand, in ascending order.
[[nodiscard]] std::vector<Cell> cells_of(const Grid& grid, std::span<const Site> sites);

/// Sky view factors of sites.
[[nodiscard]] std::vector<double> sky_at(const PackageReader& package, const SkySettings& settings, std::span<const Site> sites);

/// What `--bounds` answers.
struct BoundedSky {
  std::vector<double> svf, low, high;
};
[[nodiscard]] BoundedSky bounds_at(const PackageReader& package, std::span<const Site> sites);
/// The sky that the triangles of the whole city leave open: no rays.
[[nodiscard]] std::vector<double> true_sky_at(const PackageReader& package, std::span<const Site> sites);

/// How wide bounds are, and how many of the true values are beyond them by more than rounding.
struct BoundsSummary {
  double mean_width = 0.0, max_width = 0.0;
  std::size_t outside = 0;
};
[[nodiscard]] BoundsSummary summarize_bounds(const BoundedSky& bounds, std::span<const double> truth);

/// How much is done.
struct Extent {
  double generated_size_m = 3520.0;
  std::vector<double> cell_edges_m{25.0, 50.0, 100.0, 200.0};
  std::vector<int> neighborhoods{1, 3, 5, 7, 9};
  std::size_t receivers = 2000;       ///< with cells of 50 and 100 m, N = 3
  std::size_t fewer_receivers = 500;  ///< at the other cell edges and neighborhoods
  std::size_t surface_receivers = 1000;
  std::size_t reference_rays = 20000;
  std::size_t sampling_reference_rays = 60000;
  std::vector<std::size_t> sampling_rays{250, 500, 1000, 2000, 4000, 8000, 16000};
};
[[nodiscard]] Extent quick_extent();
/// Of one city among many: cells of 50 m, N = 3.
[[nodiscard]] Extent extent_of_model(const Extent& extent);

/// Says what is being done; studies take minutes.
void tell(const std::string& what);

/// Random places of one city.
struct StudySites {
  std::vector<Site> ground, roofs, facades;
};

/// Errors against the engine `exact` with the same rays: those of the far field alone.
struct FarFieldErrors {
  ErrorSummary dropped, box, horizon;
  BoundsSummary bounds;  ///< of what users get with the kind `horizon`
};

/// What rays, as many as a user takes, add to the error of the far field.
struct RaysErrors {
  std::size_t rays = 0;
  ErrorSummary horizon;
};

/// One cell edge and neighborhood.
struct FarFieldRow {
  double cell_edge_m = 0.0;
  int neighborhood = 0;
  FarFieldErrors ground;
  std::vector<RaysErrors> ground_rays;              ///< with cells of 50 and 100 m, N = 3
  std::optional<FarFieldErrors> roofs, facades;     ///< at cells of 50 m, N = 3
  double box_bytes_a_cell = 0.0, bytes_a_cell = 0;  ///< at cells of 50 m, N = 3; else 0
};

struct CityStudy {
  std::string name;
  std::uint64_t buildings = 0, polygons = 0;
  std::vector<FarFieldRow> rows;
};

/// The places of a city; they depend on nothing but the city.
[[nodiscard]] StudySites choose_sites(const StudiedCity& city, const Extent& extent);
/// Dropped, the paper's map and ours, at all cell edges and neighborhoods.
[[nodiscard]] CityStudy study_far_field(const StudiedCity& city, const StudySites& sites, const Extent& extent);

}  // namespace farlod::validation
