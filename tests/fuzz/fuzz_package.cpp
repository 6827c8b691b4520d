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
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The sample's manifest, which names the changed file by its new length and checksum.
std::string manifest_naming(const fs::path& sample, const char* key, std::span<const std::byte> bytes) {
  json m = json::parse(file_text(sample / package::manifest_file));
  m.erase("xxh3");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string seal = package::ManifestSeal::text_of(checksum_of_manifest(text));
  m["blocks"][0][key] = {{"bytes", bytes.size()},
                         {"xxh3", seal.substr(package::ManifestSeal::before_digits.size(), package::ManifestSeal::digits)}};
  return scenes::sealed(m.dump(1) + "\n");
}

/// A copy of the sample in which one file is changed, and each checksum is right.
void write_changed(const fs::path& folder, ChangedFile changed, std::span<const std::byte> all) {
  const fs::path& sample = sample_packages()[changed.package];
  std::vector<std::byte> bytes(all.begin(), all.end());
  const auto write = [&](const fs::path& name, const void* data, std::size_t size) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary).write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  };
  fs::copy(sample, folder, fs::copy_options::recursive);
  if (changed.kind == ChangedFile::Kind::manifest) {
    const std::string whole = scenes::sealed({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return write(package::manifest_file, whole.data(), whole.size());
  }
  const bool is_tiles = changed.kind == ChangedFile::Kind::tiles;
  if (is_tiles) mend_header(bytes);
  const package::Manifest m = read_manifest(sample);
  write(fs::path(package::folder_of(m.blocks[0])) / (is_tiles ? package::tiles_file : package::far_map_file), bytes.data(),
        bytes.size());
  const std::string text = manifest_naming(sample, is_tiles ? "tiles" : "far_map", bytes);
  write(package::manifest_file, text.data(), text.size());
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
