// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmark/contest.hpp"
#include "benchmark/line_sweep.hpp"
#include "console/progress.hpp"

// Measures us against tracing the whole city, and prints the tables behind docs/performance.md. benchmark/run runs it.

namespace farlod::benchmark {
namespace {

/// One way to use Embree, beside the way that is measured everywhere else.
struct VariantRow {
  std::string name;
  double build_s = 0.0, ground_s = 0.0, facades_s = 0.0;
  double ground_ratio = 0.0, facades_ratio = 0.0;  ///< of the time that the measured one takes, within a turn
};
struct VariantTable {
  std::size_t rays = 0, ground_receivers = 0, facade_receivers = 0;
  std::vector<VariantRow> rows;
};

constexpr std::size_t rays = 1024;
/// Some of the cells will do: there are many variants.
constexpr std::size_t share_of_cells = 4;

template <class Change>
RivalVariant changed(const std::string& name, const Change& change) {
  RivalVariant variant;
  variant.name = name;
  change(variant);
  return variant;
}

/// Embree cannot be started for what the processor does not have.
bool processor_has(const std::string& device) {
#if defined(__x86_64__)
  if (device == "isa=avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (device == "isa=avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#endif
  return !device.starts_with("isa=");
}

std::vector<RivalVariant> all_variants() {
  using V = RivalVariant;
  std::vector<RivalVariant> variants{
      {},
      changed("robust traversal", [](V& v) { v.robust = true; }),
      changed("without the coherent flag", [](V& v) { v.coherent = false; }),
      changed("single rays", [](V& v) { v.packets = v.coherent = false; }),
      changed("directions in the order of the lattice", [](V& v) { v.order = DirectionOrder::as_given; }),
      changed("rays that end above the city", [](V& v) { v.ends_above_city = true; }),
      changed("BVH of high quality", [](V& v) { v.high_quality = true; })};
  for (const char* device : {"isa=avx2", "isa=avx512", "hugepages=1", "tri_accel=bvh4.triangle4", "tri_accel=bvh8.triangle4"})
    if (processor_has(device))
      variants.push_back(changed(device, [device](V& v) { v.device = device; }));
    else
      tell(std::string("variants of the rival: without ") + device + ", which this processor does not have");
  return variants;
}

struct PackedReceivers {
  std::size_t count;
  std::vector<SharedPacket> packets;
};

PackedReceivers packed_receivers(const City& city, Place place, const Extent& extent) {
  const std::vector<Cell> cells = spread_cells(city.package.grid(), (extent.cells + share_of_cells - 1) / share_of_cells);
  const CityReceivers placed = place_receivers(city.package, cells, place, extent.spacing_m(place));
  return {placed.count, packets_of(city.package.grid(), placed)};
}

/// All the ways that were tried, to see that the rival is at its best.
VariantTable study_variants(const City& city, const Extent& extent) {
  const PackedReceivers ground = packed_receivers(city, Place::ground, extent),
                        facades = packed_receivers(city, Place::walls, extent);
  const std::vector<Point3d> directions = fibonacci_directions(rays);
  VariantTable table{rays, ground.count, facades.count, {}};
  for (const RivalVariant& variant : all_variants()) {
    tell("variants of the rival: " + variant.name);
    std::unique_ptr<WholeCityRival> rival;
    VariantRow row{variant.name};
    row.build_s = median_seconds(extent.turns, [&] { rival = std::make_unique<WholeCityRival>(city.triangles, variant); });
    const auto race = [&](const PackedReceivers& receivers) {
      std::vector<float> svf(receivers.count);
      return duel(
          extent.turns, [&] { city.rival.evaluate(receivers.packets, directions, svf); },
          [&] { rival->evaluate(receivers.packets, directions, svf); });
    };
    const Duel on_ground = race(ground), on_facades = race(facades);
    row.ground_s = on_ground.second_s;
    row.ground_ratio = on_ground.ratio;
    row.facades_s = on_facades.second_s;
    row.facades_ratio = on_facades.ratio;
    table.rows.push_back(row);
  }
  return table;
}

/// All that is measured in one run.
struct Results {
  Extent extent;
  OurEngine ours;
  std::string city;  ///< what the contests' city is
  std::vector<Contest> contests;
  std::vector<ContestRow> same_directions;
  SweepStudy sweep;
  VariantTable variants;
  std::vector<SizeRow> sizes;
};

/// Rounded to three digits: more are noise.
std::string about_text(double value) {
  const double unit = value > 0.0 ? std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 2.0)) : 1.0;
  return with_commas(static_cast<std::uint64_t>(std::round(value / unit) * unit));
}
std::string rate_text(std::size_t receivers, double seconds) {
  return seconds > 0.0 ? about_text(static_cast<double>(receivers) / seconds) : "";
}
std::string rung_text(const std::optional<Rung>& rung) {
  return rung ? fmt::format("{} | {:.4f}", with_commas(rung->samples), rung->errors.max_abs) : "none | ";
}

std::string contest_line(const ContestRow& row) {
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.what, rung_text(row.rival), rate_text(row.receivers, row.rival_s),
                     rung_text(row.ours), rate_text(row.receivers, row.ours_s),
                     row.ours_s > 0.0 ? fmt::format("**{:.2f}**", row.ratio) : "");
}

std::string main_table(const Results& results) {
  std::string text = fmt::format(
      "## Against tracing the whole city\n\nReceivers a second, all cores together. *Ours*: engine `{}`, its accuracy set by {}. "
      "*Rival*: the whole city in one Embree scene, at its best (below). Both at the fewest samples whose largest error among {} "
      "random receivers is within the target (of maps of the ground, those of the densest); the truth is {} rays against all "
      "tiles. "
      "City: {}; {} cells of it, spread evenly (of coarser maps more). "
      "Ratio: rival's time by ours, the median over {} turns (both back to back in each).\n\n"
      "| receivers | rival: rays | max error | receivers/s | ours: {} | max error | receivers/s | ratio |\n"
      "|---|---|---|---|---|---|---|---|\n",
      results.ours.name, results.ours.sample_name, results.contests.front().sample, with_commas(results.extent.truth_rays),
      results.city, results.extent.cells, results.extent.turns, results.ours.sample_name);
  for (const Contest& contest : results.contests)
    for (const ContestRow& row : contest.rows) text += contest_line(row);
  for (const ContestRow& row : results.same_directions) text += contest_line(row);
  return text + "\nThe receivers are the same for both, and are placed beforehand: ";
}

std::string placing_sentence(const Results& results) {
  std::string text;
  for (const Contest& c : results.contests)
    text += fmt::format("{}{} {} in {:.2f} s", text.empty() ? "" : ", ", with_commas(c.rows.front().receivers), name_of(c.place),
                        c.placing_s);
  return text +
         ". Reading far maps and indexing near scenes is part of our time; indexing the whole city is not part of the rival's.\n";
}

std::string ladder_table(const char* who, const std::string& samples, const std::vector<Contest>& contests,
                         std::vector<Rung> Contest::*ladder) {
  std::string text = fmt::format("\n### Errors of {}\n\n| {} |", who, samples), rule = "|---|";
  for (const Contest& c : contests) {
    text += fmt::format(" {}: mean | rms | max |", name_of(c.place));
    rule += "---|---|---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t n = 0; n < (contests.front().*ladder).size(); ++n) {
    text += fmt::format("| {} |", with_commas((contests.front().*ladder)[n].samples));
    for (const Contest& c : contests) {
      const Errors& e = (c.*ladder)[n].errors;
      text += fmt::format(" {:.5f} | {:.5f} | {:.4f} |", e.mean_abs, e.rms, e.max_abs);
    }
    text += "\n";
  }
  return text;
}

std::string sweep_table(const SweepStudy& study) {
  std::string text = fmt::format(
      "\n## Beside a line sweep over a raster\n\nThe same city as a north-up raster of {:g} m ({} pixels), all of it at once, "
      "since a sweep has to; receivers are the {} pixels of the ground. Errors are those at the receivers of the table above. "
      "Making the raster takes {:.2f} s more.\n\n| azimuths | receivers/s | mean error | rms | max |\n|---|---|---|---|---|\n",
      study.pixel_m, with_commas(study.pixels), with_commas(study.receivers), study.raster_s);
  for (const SweepRow& row : study.rows)
    text += fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.3f} |\n", row.azimuths, rate_text(study.receivers, row.seconds),
                        row.errors.mean_abs, row.errors.rms, row.errors.max_abs);
  return text;
}

std::string variants_table(const VariantTable& table) {
  std::string text = fmt::format(
      "\n## The rival at its best\n\nPackets of 16 neighbouring receivers that share a direction (on roofs and façades, "
      "receivers of one surface), directions from a spherical Fibonacci lattice mapped to the disk and traced along a curve over "
      "it, `rtcOccluded16`, coherent flag, scene without the robust flag. What else was tried, with {} rays; time relative to "
      "the first line, each within one turn.\n\n| variant | index, s | ground: receivers/s | time | façades: receivers/s | time "
      "|\n"
      "|---|---|---|---|---|---|\n",
      table.rays);
  for (const VariantRow& row : table.rows)
    text += fmt::format("| {} | {:.2f} | {} | × {:.2f} | {} | × {:.2f} |\n", row.name, row.build_s,
                        rate_text(table.ground_receivers, row.ground_s), row.ground_ratio,
                        rate_text(table.facade_receivers, row.facades_s), row.facades_ratio);
  return text;
}

std::string sizes_table(const std::vector<SizeRow>& rows) {
  std::string text =
      "\n## Cities of all sizes\n\nGround receivers, at a largest error of .010 in the city above.\n\n"
      "| polygons | triangles | rival: index, s | index, MiB | µs a receiver | ours: µs a receiver | ratio "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const SizeRow& row : rows)
    text += fmt::format("| {} | {} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | **{:.2f}** |\n", with_commas(row.polygons),
                        with_commas(row.triangles), row.build_s, static_cast<double>(row.index_bytes) / 0x1p20,
                        1e6 * row.rival_s_each(), 1e6 * row.ours_s_each(), row.ratio);
  return text;
}

std::string break_even_table(const std::vector<SizeRow>& rows) {
  std::string text =
      "\n## When packing pays\n\nBreak-even is the number of receivers from which on packing a city and evaluating its package "
      "takes less time than indexing its triangles (which are in memory already) and tracing rays against all of them.\n\n"
      "| polygons | pack, s | open, s | rival: index, s | break-even, receivers | ground grid of the whole city "
      "|\n|---|---|---|---|---|---|\n";
  for (const SizeRow& row : rows) {
    const std::optional<double> receivers = row.break_even();
    text += fmt::format("| {} | {:.2f} | {:.3f} | {:.3f} | {} | {} |\n", with_commas(row.polygons), row.pack_s, row.open_s,
                        row.build_s, receivers ? about_text(*receivers) : "never: not faster", about_text(row.all_receivers));
  }
  return text;
}

/// The tables behind docs/performance.md.
std::string markdown(const Results& results) {
  return main_table(results) + placing_sentence(results) +
         ladder_table("the rival", "rays", results.contests, &Contest::rival_ladder) +
         ladder_table("ours", results.ours.sample_name, results.contests, &Contest::our_ladder) + sweep_table(results.sweep) +
         variants_table(results.variants) + sizes_table(results.sizes) + break_even_table(results.sizes);
}

struct Options {
  bool quick = false, maps = false;
  std::string engine = "auto", generator;
  std::filesystem::path city, overhangs;
  std::vector<std::filesystem::path> packed;
  std::vector<double> pack_s;
  std::size_t cells = 0, turns = 0;
};

Extent extent_of(const Options& options) {
  Extent extent = options.quick ? quick_extent() : Extent();
  if (options.cells > 0) extent.cells = options.cells;
  if (options.turns > 0) extent.turns = options.turns;
  return extent;
}

std::vector<SizedCity> sized_cities(const Options& options) {
  std::vector<SizedCity> cities;
  for (std::size_t n = 0; n < options.packed.size(); ++n) cities.push_back({options.packed[n], options.pack_s.at(n)});
  return cities;
}

/// What both were set to for the first target on the ground; the finest where that did not do.
Accuracy accuracy_of(const Contest& ground) {
  const ContestRow& row = ground.rows.front();
  return {row.rival.value_or(ground.rival_ladder.back()).samples, row.ours.value_or(ground.our_ladder.back()).samples};
}

std::string described(const PackageReader& package, const std::string& generator) {
  return fmt::format("`farlod-city {}`, {} polygons, cells of {:g} m, N = {}", generator, package.manifest().polygons,
                     package.grid().cell_edge_m, package.grid().neighborhood);
}

/// What benchmark/end_to_end needs to know: a line for each target of the ground.
int print_maps(const Options& options) {
  const Extent extent = extent_of(options);
  const City city(options.city);
  const double index_s = median_seconds(extent.turns, [&] { static_cast<void>(WholeCityRival(city.triangles)); });
  fmt::print("spacing_m,max_error,index_s,rival_rays,rival_error,rival_per_s,our_samples,our_error,our_per_s\n");
  for (const ContestRow& row : contest(city, Place::ground, engine_named(options.engine), extent).rows) {
    if (!row.rival || !row.ours) continue;
    const auto count = static_cast<double>(row.receivers);
    fmt::print("{:g},{:g},{:.3f},{},{:.4f},{:.0f},{},{:.4f},{:.0f}\n", row.target.spacing_m, row.target.max_error, index_s,
               row.rival->samples, row.rival->errors.max_abs, count / row.rival_s, row.ours->samples, row.ours->errors.max_abs,
               count / row.ours_s);
  }
  return 0;
}

int run(const Options& options) {
  if (options.maps) return print_maps(options);
  Results results{extent_of(options), engine_named(options.engine), "", {}, {}, {}, {}, {}};
  {
    const City city(options.city);
    results.city = described(city.package, options.generator);
    for (const Place place : {Place::ground, Place::roofs, Place::walls})
      results.contests.push_back(contest(city, place, results.ours, results.extent));
    results.sweep = study_sweep(city, results.extent);
    results.variants = study_variants(city, results.extent);
  }
  results.same_directions = same_directions_contest(City(options.overhangs), results.extent);
  results.sizes = study_sizes(sized_cities(options), results.ours, accuracy_of(results.contests.front()), results.extent);
  std::fputs(markdown(results).c_str(), stdout);
  return 0;
}

int measure(int argc, char** argv) {
  CLI::App app("farlod-benchmark — measures us against tracing the whole city, for docs/performance.md", "farlod-benchmark");
  Options options;
  app.add_flag("--quick", options.quick, "Few receivers, one turn: to see that all of it runs");
  CLI::Option* maps = app.add_flag("--maps", options.maps, "Only maps of the ground of --city, as a table of commas");
  app.add_option("--engine", options.engine, "Which of ours")->capture_default_str();
  app.add_option("--city", options.city, "Package of the contests")->required();
  app.add_option("--generator", options.generator, "The options of farlod-city that made it");
  app.add_option("--overhangs", options.overhangs, "Package of a city with overhangs")->excludes(maps);
  app.add_option("--packed", options.packed, "Package of a city of the sizes that are compared; again for each");
  app.add_option("--pack-seconds", options.pack_s, "How long packing the --packed took, in their order");
  app.add_option("--cells", options.cells, "Cells of the city that are measured");
  app.add_option("--turns", options.turns, "Medians are of so many");
  CLI11_PARSE(app, argc, argv);
  if (!options.maps && options.overhangs.empty()) throw std::runtime_error("--overhangs is required, unless there is --maps");
  return run(options);
}

}  // namespace

}  // namespace farlod::benchmark

int main(int argc, char** argv) {
  try {
    return farlod::benchmark::measure(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-benchmark: %s\n", error.what());
    return 1;
  }
}
