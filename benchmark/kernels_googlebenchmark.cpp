// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <utility>

#include "benchmark/contest.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/packet_horizon.hpp"
#include "scene/near_scene.hpp"
#include "scene/vertical_profile.hpp"

// Times the parts that an answer is made of, one thread:
//   build/bin/farlod-kernels city.farlod --benchmark_filter="silhouettes"
// A kernel is a function of the city and of Google Benchmark's state; the list at the end names them all.

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

  Package package;
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

void draw_silhouettes(KernelCity& city, State& state) {
  const CellReceivers& cell = inhabited_cell(city);
  const FarHorizon far = city.package.far_horizon(cell.cell);
  const CellSilhouettes silhouettes = cell_silhouettes(city.package, cell.cell, far, bounding_box(cell.receivers));
  const AzimuthSampling azimuths = AzimuthSampling::even(SkySettings().azimuths, city.package.grid().rotation);
  const ReceiverPacket packet = first_packet(cell);
  PacketHorizon horizon(azimuths);
  for (auto _ : state) {
    horizon.clear();
    horizon.raise(silhouettes.grounded, packet);
    ::benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(packet.count));
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
    for (const auto& [name, kernel] : kernels)
      ::benchmark::RegisterBenchmark(name, [&city, kernel = kernel](State& state) { kernel(city, state); });
    ::benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-kernels: %s\n", error.what());
    return 1;
  }
  return 0;
}
