// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "console/output_files.hpp"
#include "console/run_program.hpp"
#include "farlod/error.hpp"
#include "generator/app/city_options.hpp"
#include "generator/app/city_summary.hpp"
#include "generator/city_trees.hpp"
#include "generator/generated_city.hpp"

namespace farlod {
namespace {

void count(const GeneratedBuilding& building, CityCounts& counts) {
  ++counts.buildings;
  counts.polygons += building.facets.size();
  counts.towers += building.kind == BuildingKind::tower ? 1 : 0;
  counts.bridges += building.kind == BuildingKind::bridge ? 1 : 0;
  counts.tallest_m = std::max(counts.tallest_m, building.height_m());
}

/// Writes the trees of one block after the other, as its buildings are done.
class TreesBeside {
 public:
  TreesBeside(const CityOptions& options, const CityHeader& header) : settings_(options.settings), layout_(options.settings) {
    if (!options.trees.empty()) writer_.emplace(options.trees, header);
  }
  void add(const GeneratedBuilding& building) {
    if (writer_) of_block_.push_back(building);
  }
  /// `done`: blocks so far.
  void end_block(std::int64_t done) {
    if (!writer_) return;
    for (const GeneratedTree& tree : trees_of_block(settings_, layout_.block_at(done - 1), of_block_)) {
      writer_->add(tree);
      ++count_;
    }
    of_block_.clear();
  }
  std::uint64_t end() {
    if (writer_) writer_->end();
    return count_;
  }

 private:
  const CitySettings& settings_;
  CityLayout layout_;
  std::optional<TreeWriter> writer_;
  std::vector<GeneratedBuilding> of_block_;
  std::uint64_t count_ = 0;
};

[[nodiscard]] CityCounts write_city(const CityOptions& options) {
  CityCounts counts;
  const auto start = std::chrono::steady_clock::now();
  CityHeader header = header_of(options.settings, options.output);
  header.obj_from_centre = options.obj_from_centre;
  TreesBeside trees(options, header);
  const auto writer = make_city_writer(options.format, options.output, header);
  ProgressLine progress("Building", options.run.verbosity);
  const auto blocks = static_cast<std::size_t>(CityLayout(options.settings).block_count());
  writer->begin();
  visit_city(options.settings, {.building =
                                    [&](const GeneratedBuilding& building) {
                                      writer->add(building);
                                      trees.add(building);
                                      count(building, counts);
                                    },
                                .block_done =
                                    [&](std::int64_t done) {
                                      trees.end_block(done);
                                      progress.update(static_cast<std::size_t>(done), blocks);
                                    }});
  counts.trees = trees.end();
  counts.bytes = writer->end();
  counts.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return counts;
}

void print_counts(const CityOptions& options, const CityCounts& counts) {
  if (options.run.verbosity == Verbosity::quiet) return;
  if (counts.trees > 0) fmt::print("{}: {} trees\n", options.trees.string(), counts.trees);
  fmt::print("{}: {} buildings, {} polygons, tallest {:.1f} m, {:.1f} MiB, {:.1f} s\n", options.output.string(), counts.buildings,
             counts.polygons, counts.tallest_m, static_cast<double>(counts.bytes) / 1048576.0, counts.seconds);
}

int run(const CityOptions& options) {
  const CityCounts counts = write_city(options);
  write_text(options.run.summary_file, city_summary_json(options, counts));
  print_counts(options, counts);
  return exit_done;
}

}  // namespace
}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  return run_program({.name = "farlod-city", .when_out_of_memory = "Make a smaller city."}, [&] {
    const ParsedCityOptions parsed = parse_city_options(argc, argv);
    return parsed.options ? run(*parsed.options) : parsed.exit_code;
  });
}
