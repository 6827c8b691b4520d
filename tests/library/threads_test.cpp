// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <stop_token>
#include <thread>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Threads, TwoWithOnePackage) {
  const PackedSample sample;
  const Package package(sample.folder());
  const RasterPlan plan = plan_raster(package, 2.0);
  const Raster alone = evaluate_raster(package, plan);
  const SurfaceMeans alone_surfaces = evaluate_surfaces(package, {});
  std::vector<Raster> rasters(2);
  SurfaceMeans surfaces;
  {
    const std::jthread first([&] { rasters[0] = evaluate_raster(package, plan); });
    const std::jthread second([&] { rasters[1] = evaluate_raster(package, plan); });
    const std::jthread third([&] { surfaces = evaluate_surfaces(package, {}); });
  }
  for (const Raster& raster : rasters) EXPECT_TRUE(same_bytes(raster.svf, alone.svf));
  ASSERT_EQ(surfaces.surfaces.size(), alone_surfaces.surfaces.size());
  for (std::size_t n = 0; n < surfaces.surfaces.size(); ++n)
    EXPECT_EQ(surfaces.surfaces[n].svf_mean, alone_surfaces.surfaces[n].svf_mean);
}

TEST(Threads, FourPackagesInOneProcess) {
  const PackedSample samples[]{PackedSample(), PackedSample(FarMapKind::box), PackedSample(), PackedSample()};
  std::vector<Raster> alone, together(4);
  for (const PackedSample& sample : samples) {
    const Package package(sample.folder());
    alone.push_back(evaluate_raster(package, plan_raster(package, 4.0)));
  }
  {
    std::vector<std::jthread> threads;
    for (std::size_t n = 0; n < 4; ++n)
      threads.emplace_back([&, n] {
        RunSettings run;
        run.threads = n + 1;
        const Package package(samples[n].folder());
        together[n] = evaluate_raster(package, plan_raster(package, 4.0), {}, {}, run);
      });
  }
  for (std::size_t n = 0; n < 4; ++n) EXPECT_TRUE(same_bytes(together[n].svf, alone[n].svf)) << n;
}

TEST(Threads, PackingBesideEvaluating) {
  const PackedSample sample;
  const Package package(sample.folder());
  const Raster alone = evaluate_raster(package, plan_raster(package, 4.0));
  Raster beside;
  {
    const std::jthread evaluating([&] { beside = evaluate_raster(package, plan_raster(package, 4.0)); });
    const std::jthread packing([] { const PackedSample another; });
  }
  EXPECT_TRUE(same_bytes(beside.svf, alone.svf));
}

TEST(Threads, AnotherOneMayCancel) {
  const PackedSample sample;
  const Package package(sample.folder());
  std::stop_source stop;
  RunSettings run;
  run.stop = stop.get_token();
  // In the midst of the run: when there is a first tile, and no other thread may have made the last one meanwhile
  run.threads = 1;
  const auto take = [&](const RasterTile&) { const std::jthread other([&] { stop.request_stop(); }); };
  EXPECT_THROW((void)evaluate_raster(package, plan_raster(package, 0.25), {}, {}, take, run), Cancelled);
}

}  // namespace
}  // namespace farlod::library
