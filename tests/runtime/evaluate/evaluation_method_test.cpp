// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <string>
#include <tuple>
#include <vector>

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

using Row = std::tuple<std::string, std::string, std::string, std::string>;

/// Engine and methods of each row of the table in docs/stages/evaluate.md.
std::vector<Row> documented_rows() {
  static const std::regex row("^\\| `(\\w+)`[^|]*\\| `(\\w+)` \\| `(\\w+)` \\| `(\\w+)` \\|$");
  std::ifstream file(FARLOD_SOURCE_DIR "/docs/stages/evaluate.md");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::smatch cells;
    if (std::regex_match(line, cells, row)) rows.emplace_back(cells[1], cells[2], cells[3], cells[4]);
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
                      name_of(method_of(engine, FarMapOfCell::none)));
  EXPECT_EQ(rows, documented_rows());
}

}  // namespace
}  // namespace farlod
