// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/rival_variants.hpp"

#include <memory>
#include <string>

#include "benchmark/measurement.hpp"

namespace farlod::benchmark {
namespace {

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

}  // namespace

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

}  // namespace farlod::benchmark
