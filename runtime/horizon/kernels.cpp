// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/kernels.hpp"

#include <vector>

#include "horizon/gap_kernels.hpp"
#include "horizon/light_kernels.hpp"
#include "horizon/pixel_march.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {

// What CMakeLists.txt compiles for each target
#define FARLOD_DECLARE_TARGET(target)               \
  namespace target {                                \
  extern const EdgeKernels edge_kernels;            \
  extern const SkyKernels sky_kernels;              \
  extern const GapKernels gap_kernels;              \
  extern const WedgeEndKernels wedge_end_kernels;   \
  extern const WedgeSkyKernels wedge_sky_kernels;   \
  extern const WedgePairKernels wedge_pair_kernels; \
  extern const WedgeGapKernels wedge_gap_kernels;   \
  extern const PixelKernels pixel_kernels;          \
  extern const LightKernels light_kernels;          \
  }
FARLOD_DECLARE_TARGET(baseline)
#ifdef FARLOD_X86_TARGETS
FARLOD_DECLARE_TARGET(avx2)
FARLOD_DECLARE_TARGET(avx512)
#endif
#undef FARLOD_DECLARE_TARGET

namespace {

#ifdef FARLOD_X86_TARGETS
// Exactly the extensions that CMakeLists.txt compiles the targets with
bool runs_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2"); }
bool runs_avx512() {
  return runs_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

std::vector<KernelTarget> find_runnable_kernels() {
  std::vector<KernelTarget> targets;
#ifdef FARLOD_X86_TARGETS
  if (runs_avx512())
    targets.push_back({"avx512", &avx512::edge_kernels, &avx512::sky_kernels, &avx512::gap_kernels, &avx512::wedge_end_kernels,
                       &avx512::wedge_sky_kernels, &avx512::wedge_pair_kernels, &avx512::wedge_gap_kernels,
                       &avx512::pixel_kernels, &avx512::light_kernels});
  if (runs_avx2())
    targets.push_back({"avx2", &avx2::edge_kernels, &avx2::sky_kernels, &avx2::gap_kernels, &avx2::wedge_end_kernels,
                       &avx2::wedge_sky_kernels, &avx2::wedge_pair_kernels, &avx2::wedge_gap_kernels, &avx2::pixel_kernels,
                       &avx2::light_kernels});
#endif
  targets.push_back({"baseline", &baseline::edge_kernels, &baseline::sky_kernels, &baseline::gap_kernels,
                     &baseline::wedge_end_kernels, &baseline::wedge_sky_kernels, &baseline::wedge_pair_kernels,
                     &baseline::wedge_gap_kernels, &baseline::pixel_kernels, &baseline::light_kernels});
  return targets;
}

}  // namespace

std::span<const KernelTarget> runnable_kernels() {
  static const std::vector<KernelTarget> targets = find_runnable_kernels();
  return targets;
}

const EdgeKernels& edge_kernels() {
  static const EdgeKernels& fastest = *runnable_kernels().front().edge;
  return fastest;
}

const SkyKernels& sky_kernels() {
  static const SkyKernels& fastest = *runnable_kernels().front().sky;
  return fastest;
}

const GapKernels& gap_kernels() {
  static const GapKernels& fastest = *runnable_kernels().front().gap;
  return fastest;
}

const WedgeEndKernels& wedge_end_kernels() {
  static const WedgeEndKernels& fastest = *runnable_kernels().front().wedge_end;
  return fastest;
}

const WedgeSkyKernels& wedge_sky_kernels() {
  static const WedgeSkyKernels& fastest = *runnable_kernels().front().wedge_sky;
  return fastest;
}

const WedgeGapKernels& wedge_gap_kernels() {
  static const WedgeGapKernels& fastest = *runnable_kernels().front().wedge_gap;
  return fastest;
}

const WedgePairKernels& wedge_pair_kernels() {
  static const WedgePairKernels& fastest = *runnable_kernels().front().wedge_pair;
  return fastest;
}

const PixelKernels& pixel_kernels() {
  static const PixelKernels& fastest = *runnable_kernels().front().pixel;
  return fastest;
}

const LightKernels& light_kernels() {
  static const LightKernels& fastest = *runnable_kernels().front().light;
  return fastest;
}

}  // namespace farlod
