// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/contest.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/kernels.hpp"
#include "horizon/packet_horizon.hpp"
#include "scene/ray_scenes.hpp"
#include "scene/vertical_profile.hpp"

// Times the parts that an answer is made of, one thread:
//   build/bin/farlod-kernels city.farlod --benchmark_filter="silhouettes"
// A kernel is a function of the city and of Google Benchmark's state, those of the horizon also of a target; two lists name
// them all.

namespace farlod::benchmark {
namespace {

constexpr std::size_t cell_count = 25, rays = 1000;

/// A package, and receivers on the ground of some of its cells.
struct KernelCity {
  explicit KernelCity(const char* folder)
      : package(folder),
        cells(spread_cells(package.grid(), cell_count)),
        ground(place_receivers(package, cells, Place::ground, 1.0)),
        directions(SkyWeight::cosine, rays, package.grid().rotation) {}
  /// One after the other, over and over.
  [[nodiscard]] Cell next_cell() { return cells[turn++ % cells.size()]; }

  PackageReader package;
  std::vector<Cell> cells;
  CityReceivers ground;
  SkyDirections directions;
  std::size_t turn = 0;
};
using State = ::benchmark::State;

/// The cell in the middle, or the last one that has a packet of receivers.
const CellReceivers& inhabited_cell(const KernelCity& city) {
  const CellReceivers* found = &city.ground.cells[city.ground.cells.size() / 2];
  for (const CellReceivers& cell : city.ground.cells)
    if (found->receivers.size() < packet_lanes) found = &cell;
  return *found;
}

void read_far_map(KernelCity& city, State& state) {
  for (auto _ : state) ::benchmark::DoNotOptimize(city.package.far_horizon(city.next_cell()));
}

/// For the receivers of its cell, all of them together.
void build_silhouettes(KernelCity& city, State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    const CellReceivers& cell = inhabited_cell(city);
    const FarHorizon far = city.package.far_horizon(cell.cell);
    state.ResumeTiming();
    ::benchmark::DoNotOptimize(cell_silhouettes(city.package, cell.cell, far, bounding_box(cell.receivers)));
  }
}

void build_near_scene(KernelCity& city, State& state) {
  for (auto _ : state) {
    const Occluder near = near_scene(city.package, city.next_cell());
    ::benchmark::DoNotOptimize(near.triangle_count());
  }
}

void build_locator(KernelCity& city, State& state) {
  for (auto _ : state) {
    const PointLocator locator(city.package, city.next_cell());
    ::benchmark::DoNotOptimize(&locator);
  }
}

void look_up_profile(KernelCity& city, State& state) {
  const PointLocator locator(city.package, city.cells[city.cells.size() / 2]);
  const auto edge_m = static_cast<float>(city.package.grid().cell_edge_m);
  float x = 0.5F, y = 0.5F;
  for (auto _ : state) {
    ::benchmark::DoNotOptimize(locator.at(x, y).highest_m());
    x = x + 1.0F < edge_m ? x + 1.0F : 0.5F;
    y = x > 1.0F ? y : y + 1.0F < edge_m ? y + 1.0F : 0.5F;
  }
  state.SetItemsProcessed(state.iterations());
}

ReceiverPacket first_packet(const CellReceivers& cell) {
  ReceiverPacket packet;
  for (std::size_t n = 0; n < packet_lanes; ++n) packet.add(cell.receivers[n]);
  return packet;
}

/// A packet on the ground, and what it may see of the city.
struct GroundPacket {
  explicit GroundPacket(const KernelCity& city) : GroundPacket(city, inhabited_cell(city)) {}
  GroundPacket(const KernelCity& city, const CellReceivers& cell)
      : edges(cell_silhouettes(city.package, cell.cell, city.package.far_horizon(cell.cell), bounding_box(cell.receivers))
                  .grounded),
        azimuths(AzimuthSampling::even(SkySettings().azimuths, city.package.grid().rotation)),
        receivers(first_packet(cell)) {}

  SilhouetteEdges edges;
  AzimuthSampling azimuths;
  ReceiverPacket receivers;
};

void draw_silhouettes(KernelCity& city, State& state) {
  const GroundPacket packet(city);
  PacketHorizon horizon(packet.azimuths);
  for (auto _ : state) {
    horizon.clear();
    horizon.raise(packet.edges, packet.receivers);
    ::benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(packet.receivers.count));
}

/// One direction from 16 neighboring receivers in each packet.
void trace_near_packets(KernelCity& city, State& state) {
  const CellReceivers& cell = inhabited_cell(city);
  const Occluder near = near_scene(city.package, cell.cell);
  std::vector<Point3f> origins;
  for (std::size_t n = 0; n < packet_lanes; ++n) origins.push_back(cell.receivers[n].p_cell);
  for (auto _ : state) ::benchmark::DoNotOptimize(count_free(near, origins, city.directions.facing_up()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(origins.size() * rays));
}

/// All of it, cell by cell.
void answer_cell(KernelCity& city, State& state, Engine engine) {
  SkySettings settings;
  settings.engine = engine;
  const SkyEvaluator evaluator(city.package, settings);
  std::vector<float> svf(city.ground.count);
  std::int64_t answered = 0;
  for (auto _ : state) {
    const CellReceivers& cell = city.ground.cells[city.turn++ % city.ground.cells.size()];
    evaluator.evaluate(cell, svf);
    answered += static_cast<std::int64_t>(cell.receivers.size());
  }
  state.SetItemsProcessed(answered);
}
void answer_automatically(KernelCity& city, State& state) { answer_cell(city, state, Engine::automatic); }
void answer_by_rays(KernelCity& city, State& state) { answer_cell(city, state, Engine::rays); }

using Kernel = void (*)(KernelCity& city, State& state);
constexpr std::pair<const char*, Kernel> kernels[] = {
    {"read far map of a cell", read_far_map},           {"build silhouettes of a cell", build_silhouettes},
    {"build near scene of a cell", build_near_scene},   {"build point locator of a cell", build_locator},
    {"look up vertical profile", look_up_profile},      {"draw silhouettes of a packet", draw_silhouettes},
    {"trace near rays in packets", trace_near_packets}, {"answer a cell, engine auto", answer_automatically},
    {"answer a cell, engine rays", answer_by_rays}};

// --- Kernels of the horizon, of each target that this processor runs
// ----------------------------------------------------------

using Rows = std::vector<PacketHorizon::Row>;

void find_facing(KernelCity& city, State& state, const KernelTarget& target) {
  const GroundPacket packet(city);
  const CenteredBox box = bounds_of(packet.receivers).box;
  std::vector<float> distances_m(packet.edges.batches().size() * packet_lanes);
  for (auto _ : state) {
    target.edge->find_facing({packet.edges.batches(), EdgeRole::grounded}, box, distances_m.data());
    ::benchmark::ClobberMemory();
  }
}

void raise_to_edges(const GroundPacket& packet, const KernelTarget& target, Rows& slopes) {
  (void)target.edge->raise_to_edges({packet.edges.batches(), EdgeRole::grounded}, packet.receivers, bounds_of(packet.receivers),
                                    packet.azimuths.view(), Culling::nothing_drawn, {slopes.front().data()});
}
void raise_to_edges(KernelCity& city, State& state, const KernelTarget& target) {
  const GroundPacket packet(city);
  Rows slopes(packet.azimuths.size());
  for (auto _ : state) {
    std::fill(slopes.begin(), slopes.end(), PacketHorizon::Row{});
    raise_to_edges(packet, target, slopes);
    ::benchmark::ClobberMemory();
  }
}

/// For receivers on an inclined roof.
void sum_cosine(KernelCity& city, State& state, const KernelTarget& target) {
  GroundPacket packet(city);
  packet.receivers.normal_x.fill(0.6F);
  packet.receivers.normal_z.fill(0.8F);
  Rows slopes(packet.azimuths.size());
  raise_to_edges(packet, target, slopes);
  PacketHorizon::Lanes sums;
  for (auto _ : state) {
    target.sky->sum_cosine(slopes.front().data(), packet.receivers, packet.azimuths.view(), sums.data(), nullptr);
    ::benchmark::ClobberMemory();
  }
}

/// What a compiler makes slow for one target shows beside the others.
using HorizonKernel = void (*)(KernelCity& city, State& state, const KernelTarget& target);
constexpr std::pair<const char*, HorizonKernel> horizon_kernels[] = {
    {"find facing edges", find_facing}, {"raise horizons to edges", raise_to_edges}, {"sum sky by cosine", sum_cosine}};

void register_all(KernelCity& city) {
  for (const auto& [name, kernel] : kernels)
    ::benchmark::RegisterBenchmark(name, [&city, kernel = kernel](State& state) { kernel(city, state); });
  for (const auto& [name, kernel] : horizon_kernels)
    for (const KernelTarget& target : runnable_kernels())
      ::benchmark::RegisterBenchmark((std::string(name) + ", " + target.name).c_str(),
                                     [&city, kernel = kernel, &target](State& state) { kernel(city, state, target); });
}

}  // namespace
}  // namespace farlod::benchmark

int main(int argc, char** argv) {
  using namespace farlod::benchmark;
  ::benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fputs("farlod-kernels: name one package: farlod-kernels city.farlod [--benchmark_filter=REGEX]\n", stderr);
    return 2;
  }
  try {
    KernelCity city(argv[1]);
    register_all(city);
    ::benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-kernels: %s\n", error.what());
    return 1;
  }
  return 0;
}
