// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/result_layer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace farlod {
namespace {

static_assert(std::endian::native == std::endian::little, "layers are sent as little-endian floats");

void append(std::string& bytes, const float* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(float));
}

}  // namespace

std::string_view name_of(ResultForm form) {
  switch (form) {
    case ResultForm::raster:
      return "raster";
    case ResultForm::surfaces:
      return "surfaces";
    case ResultForm::points:
      return "points";
    case ResultForm::problems:
      break;
  }
  return "problems";
}

std::array<float, 2> ResultLayer::range() const {
  float low = 0.0F, high = 1.0F;
  bool is_first = true;
  for (const float value : values) {
    if (std::isnan(value)) continue;
    low = is_first ? value : std::min(low, value);
    high = is_first ? value : std::max(high, value);
    is_first = false;
  }
  return 0.0F <= low && high <= 1.0F ? std::array{0.0F, 1.0F} : std::array{low, high};
}

std::string ResultLayer::bytes() const {
  std::string bytes;
  if (form == ResultForm::raster) {
    append(bytes, values.data(), values.size());
    return bytes;
  }
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const std::array<float, 3> row{static_cast<float>(surfaces[n][0]), static_cast<float>(surfaces[n][1]), values[n]};
    append(bytes, row.data(), row.size());
  }
  for (std::size_t n = 0; n < places_local.size(); ++n) {
    append(bytes, places_local[n].data(), places_local[n].size());
    const float value = values.empty() ? NAN : values[n];
    append(bytes, &value, 1);
  }
  return bytes;
}

}  // namespace farlod
