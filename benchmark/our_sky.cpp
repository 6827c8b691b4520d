// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/our_sky.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <stdexcept>

namespace farlod::benchmark {

SkySettings OurEngine::settings(std::size_t samples) const {
  SkySettings settings;
  settings.engine = engine;
  (engine == Engine::rays ? settings.rays : settings.azimuths) = samples;
  return settings;
}

OurEngine engine_named(const std::string& name) {
  const std::vector<std::size_t> rays{256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192};
  const std::vector<std::size_t> azimuths{32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024};
  if (name == "rays") return {name, Engine::rays, "rays", rays};
  if (name == "horizon") return {name, Engine::horizon, "azimuths", azimuths, true};
  if (name == "auto") return {name, Engine::automatic, "azimuths", azimuths, true};
  throw std::runtime_error("farlod-benchmark knows no engine '" + name + "'");
}

void evaluate(const PackageReader& package, const SkySettings& settings, const CityReceivers& receivers, std::span<float> svf) {
  const SkyEvaluator evaluator(package, settings);
  oneapi::tbb::parallel_for(std::size_t{0}, receivers.cells.size(),
                            [&](std::size_t n) { evaluator.evaluate(receivers.cells[n], svf); });
}

std::vector<float> exact_answers(const PackageReader& package, const CityReceivers& receivers, std::size_t rays) {
  SkySettings settings;
  settings.engine = Engine::exact;
  settings.rays = rays;
  std::vector<float> svf(receivers.count);
  evaluate(package, settings, receivers, svf);
  return svf;
}

}  // namespace farlod::benchmark
