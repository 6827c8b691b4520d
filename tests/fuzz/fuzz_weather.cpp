// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <cmath>

#include "base/expects.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"
#include "weather/weather.hpp"

namespace farlod {
namespace {

void expect_weather(const Weather& weather) {
  FARLOD_EXPECTS(!weather.intervals.empty() && !weather.source.empty());
  for (const WeatherInterval& interval : weather.intervals) {
    FARLOD_EXPECTS(interval.duration.count() > 0);
    const std::array values{interval.global_w_m2, interval.direct_normal_w_m2, interval.diffuse_w_m2};
    for (const double value : values) FARLOD_EXPECTS(std::isfinite(value) && value >= 0.0);
    FARLOD_EXPECTS(std::isfinite(interval.temperature_c) && std::isfinite(interval.dew_point_c) && interval.pressure_hpa > 0.0);
  }
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder folder;
  const std::filesystem::path file = folder.write({data, size}, "weather.epw");
  expect_answer_or_refusal([&] {
    const Weather weather = read_weather(file, PlaceOnEarth{Angle::degrees(4.45), Angle::degrees(51.95)});
    expect_weather(weather);
    expect_weather(within(weather, period_in("06")));
  });
  expect_answer_or_refusal([&] { expect_weather(read_weather(file, std::nullopt)); });
  return 0;
}
