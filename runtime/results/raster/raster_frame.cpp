// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_frame.hpp"

namespace farlod {
namespace {

std::string definition_of(const std::string& quantity) {
  if (quantity == "svf") return "sky view factor: share of the sky that the receiver sees, weighted by the cosine to its normal";
  if (quantity == "svf_solid") return "share of the solid angle of the sky that the receiver sees";
  return quantity;
}

/// Of svfNveg and the like; of others none.
std::string half_of_vegetation(const std::string& column) {
  if (column == "svfNveg" || column == "svfNaveg") return "northern";
  if (column == "svfEveg" || column == "svfEaveg") return "eastern";
  if (column == "svfSveg" || column == "svfSaveg") return "southern";
  return column == "svfWveg" || column == "svfWaveg" ? "western" : "";
}

/// Of canopies; others have no definition here.
std::string canopy_definition_of(const std::string& column) {
  if (column == "svf_total") return "sky view factor with what passes the crowns of trees and comes past them";
  if (column == "svf_total_low" || column == "svf_total_high")
    return column == "svf_total_low" ? "certain lower bound of svf_total" : "certain upper bound of svf_total";
  if (column == "svfveg") return "1 - the sky behind crowns, weighted as in svf";
  if (column == "svfaveg") return "1 - the view of solid things that crowns hide, weighted as in svf";
  if (column == "share_sky") return "share of the view that is sky";
  if (column == "share_vegetation") return "share of the view that is crowns of trees";
  if (const std::string half = half_of_vegetation(column); !half.empty())
    return column.ends_with("aveg") ? "svfaveg of the " + half + " half of the sky"
                                    : "svfveg of the " + half + " half of the sky";
  return column == "share_building" ? "share of the view that is neither sky nor crowns of trees" : "";
}

Band half_of_sky(const std::string& column, const std::string& half) {
  return {column, "1", "sky view factor of the " + half + " half of the sky, twice its share"};
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

Band further_band(const std::string& column) {
  if (const std::string definition = canopy_definition_of(column); !definition.empty()) return {column, "1", definition};
  if (column == "svfN") return half_of_sky(column, "northern");
  if (column == "svfE") return half_of_sky(column, "eastern");
  if (column == "svfS") return half_of_sky(column, "southern");
  if (column == "svfW") return half_of_sky(column, "western");
  if (column == "hidden_near") return {column, "1", "share of the sky that geometry of the neighborhood hides"};
  if (column == "hidden_far") return {column, "1", "share of the sky that geometry beyond the neighborhood alone hides"};
  if (column == "sunlit_h") return {column, "h", "hours at which the middle of the sun is seen, were the sky clear"};
  if (column.starts_with("horizon_"))
    return {column, "degree", "elevation above which all is sky, at " + column.substr(8) + " degrees clockwise from true north"};
  if (column.starts_with("distance_"))
    return {column, "m",
            "level distance to what makes the horizon at " + column.substr(9) + " degrees clockwise from true north"};
  if (column.starts_with("patch_"))
    return {column, "1", "share that is seen of patch " + column.substr(6) + " of the sky, weighted by the cosine to the normal"};
  return {column, "1", definition_of(column)};
}

}  // namespace farlod
