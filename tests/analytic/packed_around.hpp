// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {

inline constexpr float packed_eye_m = 1.5F;
inline constexpr double packed_cell_edge_m = 40.0;

/// A city around the middle of its only cell in which there are receivers, packed.
class PackedAround {
 public:
  template <class Build>
  explicit PackedAround(Angle grid_bearing, const Build& build) : package_(std::in_place, packed(grid_bearing, build)) {}

  /// The columns of a receiver in the middle.
  [[nodiscard]] std::map<std::string, double> columns(Engine engine, const Quantities& further,
                                                      const Point3d& normal_city = {0.0, 0.0, 1.0},
                                                      SkyWeight weight = SkyWeight::cosine) const {
    SkySettings settings{
        .engine = engine, .weight = weight, .rays = 20000, .azimuths = azimuths_for(further, 720), .further = further};
    const SkyEvaluator evaluator(*package_, settings);
    const Point3d n = package_->grid().rotation.grid_from_city(normal_city);
    const auto half = static_cast<float>(0.5 * packed_cell_edge_m);
    const CellReceivers receivers{{0, 0},
                                  {{0,
                                    {half, half, static_cast<float>(packed_eye_m - package_->manifest().height_origin_m)},
                                    {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}}}};
    std::vector<float> svf(1), values(evaluator.further_columns());
    evaluator.evaluate(receivers, SkyAnswers(svf, {}, {}, values));
    std::map<std::string, double> named{{"svf", svf.front()}};
    const std::vector<std::string> names = columns_of(further);
    for (std::size_t n_column = 0; n_column < names.size(); ++n_column) named[names[n_column]] = values[n_column];
    return named;
  }

  [[nodiscard]] const PackageReader& package() const { return *package_; }
  /// Puts crowns of the package's grid and heights into it.
  void plant(CrownsOfCity crowns) {
    scenes::plant(crowns, folder_.path() / "scene.farlod");
    package_.emplace(folder_.path() / "scene.farlod");
  }
  /// Receivers on a square of 36 m around the middle, row by row, with these normals.
  [[nodiscard]] CellReceivers receivers_on_square(const std::vector<Point3d>& normals_city) const {
    CellReceivers result{{0, 0}, {}};
    const auto z = static_cast<float>(packed_eye_m - package_->manifest().height_origin_m);
    for (std::size_t n = 0; n < normals_city.size(); ++n) {
      const Point3d normal = package_->grid().rotation.grid_from_city(normals_city[n]);
      result.receivers.push_back({n,
                                  {2.3F + 11.7F * static_cast<float>(n % 4), 2.1F + 11.9F * static_cast<float>(n / 4), z},
                                  {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)}});
    }
    return result;
  }

 private:
  template <class Build>
  PackageReader packed(Angle grid_bearing, const Build& build) const {
    const GridRotation rotation(grid_bearing);
    const Point2d middle_city = rotation.city_from_grid(Point2d{0.5 * packed_cell_edge_m, 0.5 * packed_cell_edge_m});
    scenes::SceneBuilder builder({middle_city.x, middle_city.y, packed_eye_m});
    build(builder);
    builder.add_box({{-0.05, -0.05}, {0.05, 0.05}}, -packed_eye_m, -packed_eye_m + 0.01);  // says where the ground is
    const CityModel city = builder.city();
    const Grid grid = scenes::grid_covering(city, grid_bearing, packed_cell_edge_m, 1, 1);
    scenes::pack_city(city, grid, folder_.path() / "scene.farlod", {}, Assign::clip, {{Cell{0, 0}}});
    return PackageReader(folder_.path() / "scene.farlod");
  }

  scenes::TemporaryFolder folder_;
  std::optional<PackageReader> package_;
};

}  // namespace farlod
