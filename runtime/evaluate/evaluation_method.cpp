// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/evaluation_method.hpp"

namespace farlod {

FarMapOfCell far_map_of(const PackageReader& package, Cell cell) {
  if (!package.grid().cells.contains(cell)) return FarMapOfCell::outside_of_grid;
  if (!package.has_far_map(cell)) return FarMapOfCell::missing;
  return package.manifest().far_map.is_box() ? FarMapOfCell::box : FarMapOfCell::horizon;
}

EvaluationMethod method_of(Engine engine, FarMapOfCell far_map) {
  using enum EvaluationMethod;
  if (far_map == FarMapOfCell::outside_of_grid || engine == Engine::exact) return whole_city;
  if (engine == Engine::near_only) return near_scene_alone;
  if (far_map == FarMapOfCell::missing) return engine == Engine::horizon ? horizons_alone : whole_city;
  if (far_map == FarMapOfCell::box) return near_scene_and_box;
  if (engine == Engine::rays) return rays_against_horizons;
  return engine == Engine::horizon ? horizons_alone : horizons_and_rays;
}

}  // namespace farlod
