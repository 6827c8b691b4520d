// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_frame.hpp"

namespace farlod {
namespace {

std::string definition_of(const std::string& quantity) {
  if (quantity == "svf") return "sky view factor: share of the sky that the receiver sees, weighted by the cosine to its normal";
  Quantities solid;
  solid.svf_solid = true;
  return column_descriptions_of(solid).front().definition;
}

}  // namespace

std::vector<Band> svf_bands(const std::string& quantity, RasterBands bands) {
  const std::string definition = definition_of(quantity);
  std::vector<Band> all{{quantity, "1", definition}};
  if (bands == RasterBands::svf_and_bounds) {
    all.push_back({quantity + "_low", "1", "lower bound of the " + definition});
    all.push_back({quantity + "_high", "1", "upper bound of the " + definition});
  }
  return all;
}

std::vector<std::span<const float>> bands_of(const RasterTile& tile) {
  std::vector<std::span<const float>> bands{tile.svf};
  if (!tile.low.empty()) bands.insert(bands.end(), {tile.low, tile.high});
  bands.insert(bands.end(), tile.further.begin(), tile.further.end());
  return bands;
}

}  // namespace farlod
