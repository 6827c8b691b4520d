// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The arguments of a call, right until a case makes one of them wrong.
struct Arguments {
  explicit Arguments(const std::filesystem::path& folder) : package(folder) {
    const Point2d p = middle_of(package);
    x = {p.x, p.x + 30.0};
    y = {p.y, p.y - 30.0};
    plan = plan_raster(package, 8.0);
    part = package.description().outline_projected;
    const CellRectangle all = inventory_of(package).cells;
    cell = {all.i_begin, all.j_begin};
    cells = {all.i_begin, all.j_begin, all.i_begin + 1, all.j_begin + 1};
  }

  Package package;
  std::vector<double> x, y, z;
  std::vector<Angle> azimuth, tilt;
  std::vector<float> svf{0.0F, 0.0F}, low, high;
  std::vector<double> height_m;
  std::vector<float> further;
  Placing placing;
  RasterPlan plan;
  Box2d part;
  std::size_t most_segments = 1'000'000;
  CellPlace cell;
  CellRectangle cells;
  SurfaceSettings surfaces{SurfaceChoice::all, 20.0};
  MatrixSettings matrix;
  EvaluationSettings settings;
  RunSettings run;
  OnRasterTile on_tile = [](const RasterTile&) {};
  OnSurfacePoints on_points;
};

using Call = std::function<void(Arguments&)>;

struct Named {
  std::string name;
  Call call;
};

inline const Named points_into{"points_into", [](Arguments& a) {
                                 (void)evaluate_points(a.package, {a.x, a.y, a.z, a.azimuth, a.tilt}, a.placing, a.settings,
                                                       {a.svf, a.low, a.high, a.height_m, a.further}, a.run);
                               }};
inline const Named points{"points", [](Arguments& a) {
                            (void)evaluate_points(a.package, {a.x, a.y, a.z, a.azimuth, a.tilt}, a.placing, a.settings, a.run);
                          }};
inline const Named tiles{"tiles",
                         [](Arguments& a) { (void)evaluate_raster(a.package, a.plan, a.placing, a.settings, a.on_tile, a.run); }};
inline const Named raster{"raster", [](Arguments& a) { (void)evaluate_raster(a.package, a.plan, a.placing, a.settings, a.run); }};
inline const Named window{
    "window", [](Arguments& a) {
      (void)evaluate_window(a.package, a.plan, {0, 0, a.plan.columns, a.plan.rows}, a.placing, a.settings, a.run);
    }};
inline const Named surfaces{"surfaces",
                            [](Arguments& a) { (void)evaluate_surfaces(a.package, a.surfaces, a.settings, a.on_points, a.run); }};
inline const Named matrix{"matrix",
                          [](Arguments& a) { (void)view_factor_matrix(a.package, a.surfaces, {}, a.matrix, a.settings, a.run); }};
inline const Named plan{"plan", [](Arguments& a) { (void)plan_raster(a.package, a.plan.step_m); }};
inline const Named inventory{"inventory", [](Arguments& a) { (void)inventory_of(a.package); }};
inline const Named height_range{"height range", [](Arguments& a) { (void)heights_of(a.package); }};
inline const Named check{"check", [](Arguments& a) { (void)check_package(a.package, a.run); }};
inline const Named cell_contents{"cell", [](Arguments& a) { (void)inspect_cell(a.package, a.cell); }};
inline const Named geometry{"geometry", [](Arguments& a) { (void)geometry_of(a.package, a.cells); }};
inline const Named far_view{"far view", [](Arguments& a) { (void)far_view_of(a.package, a.cell); }};
inline const Named outlines{"outlines", [](Arguments& a) { (void)building_outlines(a.package, a.part, a.most_segments, a.run); }};
inline const Named heights{"heights", [](Arguments& a) { (void)ground_heights(a.package, a.plan, a.run); }};
inline const Named plan_of_heights{"plan heights", [](Arguments& a) { (void)plan_heights(a.package, a.plan, a.run); }};
inline const Named description{"description", [](Arguments& a) { (void)a.package.description(); }};

}  // namespace farlod::library
