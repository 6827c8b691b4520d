// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/points.hpp"
#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "tests/fuzz/changed_file.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

/// A copy of the sample in which one file is changed, and each checksum is right.
void write_changed(const fs::path& folder, ChangedFile changed, std::span<const std::byte> all) {
  std::vector<std::byte> bytes(all.begin(), all.end());
  fs::copy(sample_packages()[changed.package], folder, fs::copy_options::recursive);
  if (changed.kind == ChangedFile::Kind::manifest)
    return write_sealed(folder, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const bool is_tiles = changed.kind == ChangedFile::Kind::tiles;
  if (is_tiles) mend_tiles(bytes);
  nlohmann::json manifest = open_manifest(folder);
  manifest["blocks"][0][is_tiles ? "tiles" : "far_map"] = entry_of_file(bytes);
  write_bytes(
      folder / package::folder_of(read_manifest(folder).blocks[0]) / (is_tiles ? package::tiles_file : package::far_map_file),
      bytes);
  write_sealed(folder, manifest.dump(1) + "\n");
}

void evaluate(const Package& package, Engine engine) {
  const Box2d outline = package.description().outline_projected;
  const std::vector<double> x{outline.low.x + 10.0, 0.5 * (outline.low.x + outline.high.x), outline.high.x - 10.0};
  const std::vector<double> y{outline.low.y + 10.0, 0.5 * (outline.low.y + outline.high.y), outline.high.y - 10.0};
  EvaluationSettings settings;
  settings.engine = engine;
  settings.azimuths = 16;
  settings.rays = 37;
  RunSettings run;
  run.threads = 1;
  run.memory_limit_mib = 1024;
  const PointAnswers answers = evaluate_points(package, {x, y}, {}, settings, run);
  for (const float value : answers.svf) FARLOD_EXPECTS(std::isnan(value) || (0.0F <= value && value <= 1.0F));
}

void ask_everything(const fs::path& folder) {
  const Package package(folder);
  RunSettings run;
  run.threads = 1;
  run.memory_limit_mib = 1024;
  const CellRectangle cells = inventory_of(package).cells;
  const CellPlace first{cells.i_begin, cells.j_begin};
  for (const Engine engine : {Engine::automatic, Engine::horizon, Engine::rays, Engine::exact, Engine::near_only})
    expect_answer_or_refusal([&] { evaluate(package, engine); });
  expect_answer_or_refusal([&] { (void)check_package(package, run); });
  expect_answer_or_refusal([&] { (void)inspect_cell(package, first); });
  expect_answer_or_refusal([&] { (void)geometry_of(package, {first.i, first.j, first.i + 1, first.j + 1}); });
  expect_answer_or_refusal([&] { (void)far_view_of(package, first); });
  expect_answer_or_refusal(
      [&] { (void)building_outlines(package, package.description().outline_projected, std::size_t{100'000}, run); });
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  if (size < 2) return 0;
  static const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "a.farlod";
  fs::remove_all(folder);
  write_changed(folder, ChangedFile::of(data[0]), std::as_bytes(std::span(data, size)).subspan(1));
  expect_answer_or_refusal([&] { ask_everything(folder); });
  return 0;
}
