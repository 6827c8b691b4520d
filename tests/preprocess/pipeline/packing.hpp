// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "package/package_reader.hpp"
#include "pipeline/pack.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod::pipeline::test {

/// What a call of the pipeline's progress said.
struct Told {
  std::string stage;
  std::size_t done = 0, all = 0;
};

/// Packs into a folder of its own, and keeps all that came of it.
struct Packing {
  scenes::TemporaryFolder folder;
  StageSettings settings;
  RunSettings run_settings;
  Report report;
  std::vector<Told> told;
  PackedCity result;

  Packing() { settings.output = folder.path() / "city.farlod"; }

  void run() {
    run_settings.on_progress = [this](const Progress& p) { told.push_back({std::string(p.stage), p.done, p.all}); };
    result = pack(settings, report, run_settings);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const { return folder.write(name, text); }
  [[nodiscard]] std::set<int> codes() const {
    std::set<int> codes;
    for (const Problem& problem : report.problems()) codes.insert(static_cast<int>(problem.code));
    return codes;
  }
  [[nodiscard]] std::vector<std::string> stages_timed() const {
    std::vector<std::string> stages;
    for (const auto& [stage, seconds] : result.stage_seconds) stages.push_back(stage);
    return stages;
  }
  [[nodiscard]] std::set<std::string> stages_told() const {
    std::set<std::string> stages;
    for (const Told& t : told) stages.insert(t.stage);
    return stages;
  }
};

/// The ids of all buildings that have a surface in the package.
inline std::set<std::string> ids_in(const PackageReader& package) {
  std::set<std::string> ids;
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    const BlockTiles& block = package.block_tiles(cells.cell_at(n));
    for (const package::BuildingRecord& b : block.buildings()) ids.emplace(block.id_of(b));
  }
  return ids;
}

}  // namespace farlod::pipeline::test
