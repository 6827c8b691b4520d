// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <string_view>
#include <vector>

#include "canopy/crown_kernels.hpp"
#include "horizon/kernels.hpp"

namespace farlod {

// What the kernels of the horizon are compiled for, too
#define FARLOD_DECLARE_TARGET(target)                   \
  namespace target {                                    \
  extern const CrownKernels crown_kernels;              \
  extern const CrownLightKernels crown_light_kernels;   \
  extern const CanopyMarchKernels canopy_march_kernels; \
  }
FARLOD_DECLARE_TARGET(baseline)
#ifdef FARLOD_X86_TARGETS
FARLOD_DECLARE_TARGET(avx2)
FARLOD_DECLARE_TARGET(avx512)
#endif
#undef FARLOD_DECLARE_TARGET

namespace {

CrownTarget target_of(const KernelTarget& horizon) {
#ifdef FARLOD_X86_TARGETS
  const std::string_view name = horizon.name;
  if (name == "avx512")
    return {horizon.name, &avx512::crown_kernels, &avx512::crown_light_kernels, &avx512::canopy_march_kernels};
  if (name == "avx2") return {horizon.name, &avx2::crown_kernels, &avx2::crown_light_kernels, &avx2::canopy_march_kernels};
#endif
  return {horizon.name, &baseline::crown_kernels, &baseline::crown_light_kernels, &baseline::canopy_march_kernels};
}

std::vector<CrownTarget> find_runnable_kernels() {
  std::vector<CrownTarget> targets;
  for (const KernelTarget& horizon : runnable_kernels()) targets.push_back(target_of(horizon));
  return targets;
}

}  // namespace

std::span<const CrownTarget> runnable_crown_kernels() {
  static const std::vector<CrownTarget> targets = find_runnable_kernels();
  return targets;
}

const CrownTarget& crown_kernels() { return runnable_crown_kernels().front(); }

}  // namespace farlod
