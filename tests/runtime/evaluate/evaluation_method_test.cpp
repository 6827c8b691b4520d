// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <tuple>
#include <vector>

#include "evaluate/error_budget.hpp"
#include "evaluate/sky_evaluator.hpp"

namespace farlod {
namespace {

std::string name_of(EvaluationMethod method) {
  switch (method) {
    case EvaluationMethod::horizons_and_rays:
      return "horizons_and_rays";
    case EvaluationMethod::horizons_alone:
      return "horizons_alone";
    case EvaluationMethod::rays_against_horizons:
      return "rays_against_horizons";
    case EvaluationMethod::near_scene_and_box:
      return "near_scene_and_box";
    case EvaluationMethod::near_scene_alone:
      return "near_scene_alone";
    case EvaluationMethod::whole_city:
      return "whole_city";
  }
  return "";
}

using Row = std::tuple<std::string, std::string, std::string, std::string, std::string>;

/// Engine and methods of each row of the table in docs/stages/evaluate.md.
std::vector<Row> documented_rows() {
  static const std::regex row("^\\| `(\\w+)`[^|]*\\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\|$");
  std::ifstream file(FARLOD_SOURCE_DIR "/docs/stages/evaluate.md");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::smatch cells;
    if (std::regex_match(line, cells, row)) rows.emplace_back(cells[1], cells[2], cells[3], cells[4], cells[5]);
  }
  return rows;
}

TEST(EvaluationMethod, FollowsTheDocumentedTable) {
  std::vector<Row> rows;
  for (const auto& [name, engine] : {std::pair("auto", Engine::automatic),
                                     {"horizon", Engine::horizon},
                                     {"rays", Engine::rays},
                                     {"exact", Engine::exact},
                                     {"near_only", Engine::near_only}})
    rows.emplace_back(name, name_of(method_of(engine, FarMapOfCell::horizon)), name_of(method_of(engine, FarMapOfCell::box)),
                      name_of(method_of(engine, FarMapOfCell::missing)),
                      name_of(method_of(engine, FarMapOfCell::outside_of_grid)));
  EXPECT_EQ(rows, documented_rows());
}

/// Whatever the engine is called, the sampling error is that of what answers.
TEST(EvaluationMethod, SaysWhoseSamplingErrorCounts) {
  // Either may be the larger one
  for (const auto& [rays, azimuths] : {std::pair<std::size_t, std::size_t>{100, 1000}, {100'000, 10}}) {
    const auto error = [&, rays = rays, azimuths = azimuths](Engine engine, FarMapOfCell far_map,
                                                             std::optional<double> max_far_error = {}) {
      return sampling_error_of({engine, SkyWeight::cosine, rays, max_far_error, DirectionSet::partition, azimuths}, far_map);
    };
    const double of_rays = sampling_error(rays), of_azimuths = azimuth_error(azimuths), larger = std::max(of_rays, of_azimuths);
    EXPECT_EQ(error(Engine::automatic, FarMapOfCell::horizon), larger);
    EXPECT_EQ(error(Engine::horizon, FarMapOfCell::horizon), of_azimuths);
    EXPECT_EQ(error(Engine::horizon, FarMapOfCell::horizon, 0.01), larger);
    EXPECT_EQ(error(Engine::rays, FarMapOfCell::horizon), of_rays);
    for (const Engine engine : {Engine::automatic, Engine::horizon, Engine::rays, Engine::exact, Engine::near_only})
      for (const FarMapOfCell far_map : {FarMapOfCell::box, FarMapOfCell::outside_of_grid})
        EXPECT_EQ(error(engine, far_map), of_rays);
    for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact})
      EXPECT_EQ(error(engine, FarMapOfCell::missing), of_rays);
  }
}

}  // namespace
}  // namespace farlod
