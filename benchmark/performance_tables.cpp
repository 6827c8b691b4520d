// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/performance_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "console/wrapped_document.hpp"

namespace farlod::benchmark {
namespace {

/// With a comma between thousands: 1,536.
std::string count_text(std::uint64_t value) {
  std::string digits = fmt::format("{}", value);
  for (std::size_t n = digits.size(); n > 3; n -= 3) digits.insert(n - 3, ",");
  return digits;
}
/// Rounded to three digits: more are noise.
std::string about_text(double value) {
  const double unit = value > 0.0 ? std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 2.0)) : 1.0;
  return count_text(static_cast<std::uint64_t>(std::round(value / unit) * unit));
}
std::string rate_text(std::size_t receivers, double seconds) {
  return seconds > 0.0 ? about_text(static_cast<double>(receivers) / seconds) : "";
}
std::string rung_text(const std::optional<Rung>& rung) {
  return rung ? fmt::format("{} | {:.4f}", count_text(rung->samples), rung->errors.max_abs) : "none | ";
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
      results.ours.name, results.ours.sample_name, results.contests.front().sample, count_text(results.extent.truth_rays),
      results.city, results.extent.cells, results.extent.turns, results.ours.sample_name);
  for (const Contest& contest : results.contests)
    for (const ContestRow& row : contest.rows) text += contest_line(row);
  for (const ContestRow& row : results.same_directions) text += contest_line(row);
  return text + "\nThe receivers are the same for both, and are placed beforehand: ";
}

std::string placing_sentence(const Results& results) {
  std::string text;
  for (const Contest& c : results.contests)
    text += fmt::format("{}{} {} in {:.2f} s", text.empty() ? "" : ", ", count_text(c.rows.front().receivers), name_of(c.place),
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
    text += fmt::format("| {} |", count_text((contests.front().*ladder)[n].samples));
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
      study.pixel_m, count_text(study.pixels), count_text(study.receivers), study.raster_s);
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
    text += fmt::format("| {} | {} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | **{:.2f}** |\n", count_text(row.polygons),
                        count_text(row.triangles), row.build_s, static_cast<double>(row.index_bytes) / 0x1p20,
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
    text += fmt::format("| {} | {:.2f} | {:.3f} | {:.3f} | {} | {} |\n", count_text(row.polygons), row.pack_s, row.open_s,
                        row.build_s, receivers ? about_text(*receivers) : "never: not faster", about_text(row.all_receivers));
  }
  return text;
}

}  // namespace

std::string markdown(const Results& results) {
  return wrapped_document(main_table(results) + placing_sentence(results) +
                          ladder_table("the rival", "rays", results.contests, &Contest::rival_ladder) +
                          ladder_table("ours", results.ours.sample_name, results.contests, &Contest::our_ladder) +
                          sweep_table(results.sweep) + variants_table(results.variants) + sizes_table(results.sizes) +
                          break_even_table(results.sizes));
}

}  // namespace farlod::benchmark
