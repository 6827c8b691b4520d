// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/stand_ins.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "city/city_model.hpp"

namespace farlod::plausibility {
namespace {

/// The numbers of rule (2) of take_out_stand_ins.
bool may_stand_in(float height_m) { return height_m == 0.0F || height_m == -1.0F; }

/// What the heights of a raster look like beside its zeros.
struct BesideZeros {
  float lowest_m = std::numeric_limits<float>::infinity();
  std::size_t zeros = 0, others = 0;
  std::set<float> different;  ///< of the others, as many as show that the ground has slopes
};

constexpr std::size_t levels_of_a_model = 16;

BesideZeros beside_zeros(const std::vector<std::optional<float>>& heights_m) {
  BesideZeros found;
  for (const auto& height_m : heights_m) {
    if (!height_m || !may_be_elevation(*height_m)) continue;
    if (may_stand_in(*height_m)) {
      ++found.zeros;
      continue;
    }
    ++found.others;
    found.lowest_m = std::min(found.lowest_m, *height_m);
    if (found.different.size() <= levels_of_a_model) found.different.insert(*height_m);
  }
  return found;
}

bool zero_stands_in(const std::vector<std::optional<float>>& heights_m, HeightsOf of) {
  constexpr float least_gap_m = 20.0F, beyond_doubt_m = 100.0F;
  const BesideZeros found = beside_zeros(heights_m);
  if (found.zeros == 0 || found.others == 0 || found.lowest_m < least_gap_m) return false;
  if (of == HeightsOf::ground || found.lowest_m >= beyond_doubt_m) return true;
  return found.different.size() > levels_of_a_model && 2 * found.zeros < found.others;
}

/// The least number of all and the next one.
struct Lowest {
  float height_m = std::numeric_limits<float>::infinity(), next_m = std::numeric_limits<float>::infinity();
  std::size_t pixels = 0;

  void add(float other_m) {
    if (other_m == height_m) {
      ++pixels;
    } else if (other_m < height_m) {
      next_m = std::exchange(height_m, other_m);
      pixels = 1;
    } else {
      next_m = std::min(next_m, other_m);
    }
  }
  /// Whether it is apart from all others, which reach up to `highest_m`.
  [[nodiscard]] bool is_apart(float highest_m, float least_gap_m, std::size_t of_pixels) const {
    constexpr std::size_t fewest = 16, one_of = 1000;
    const float gap_m = next_m - height_m, range_m = highest_m - next_m;
    return pixels >= std::max(fewest, of_pixels / one_of) && gap_m >= std::max(least_gap_m, range_m);
  }
};

/// The number of rule (3) of take_out_stand_ins.
std::optional<float> number_apart(const std::vector<std::optional<float>>& heights_m, HeightsOf of) {
  Lowest lowest, highest;  // that of heights that count downwards
  std::set<float> different;
  for (const auto& height_m : heights_m) {
    if (!height_m || !may_be_elevation(*height_m)) continue;
    lowest.add(*height_m);
    highest.add(-*height_m);
    if (different.size() <= levels_of_a_model) different.insert(*height_m);
  }
  if (different.size() <= levels_of_a_model) return std::nullopt;
  const float least_gap_m = of == HeightsOf::ground ? 50.0F : 100.0F;
  if (lowest.is_apart(-highest.height_m, least_gap_m, heights_m.size())) return lowest.height_m;
  if (of == HeightsOf::ground && highest.is_apart(-lowest.height_m, least_gap_m, heights_m.size())) return -highest.height_m;
  return std::nullopt;
}

}  // namespace

std::vector<StandIn> take_out_stand_ins(std::vector<std::optional<float>>& heights_m, HeightsOf of) {
  const bool without_zero = zero_stands_in(heights_m, of);
  const auto apart_m = number_apart(heights_m, of);
  std::map<float, StandIn> by_height;
  for (std::size_t n = 0; n < heights_m.size(); ++n) {
    auto& height_m = heights_m[n];
    if (!height_m) continue;
    if (may_be_elevation(*height_m) && !(without_zero && may_stand_in(*height_m)) && height_m != apart_m) continue;
    ++by_height.try_emplace(*height_m, StandIn{*height_m, 0, n}).first->second.pixels;
    height_m.reset();
  }
  std::vector<StandIn> found;
  for (const auto& [height, stand_in] : by_height) found.push_back(stand_in);
  std::stable_sort(found.begin(), found.end(), [](const StandIn& a, const StandIn& b) { return a.pixels > b.pixels; });
  return found;
}

std::optional<std::string> sign_of_another_unit(std::span<const StandIn> stand_ins, std::size_t left) {
  constexpr std::size_t enough_different = 100;
  if (stand_ins.size() < enough_different) return std::nullopt;
  std::size_t pixels = 0;
  for (const StandIn& s : stand_ins) pixels += s.pixels;
  if (pixels <= left || 2 * stand_ins.front().pixels >= pixels) return std::nullopt;
  const auto by_height = [](const StandIn& a, const StandIn& b) { return a.height_m < b.height_m; };
  const auto [low, high] = std::minmax_element(stand_ins.begin(), stand_ins.end(), by_height);
  const bool may_be_centimetres = may_be_elevation(high->height_m / 100.0),
             may_be_millimetres = may_be_elevation(high->height_m / 1e3);
  return fmt::format(
      "{} of {} heights read from it are no elevations on land in metres: they are {} different numbers from {:g} to {:g}. {}",
      pixels, pixels + left, stand_ins.size(), low->height_m, high->height_m,
      may_be_centimetres   ? "Are they in centimetres, or millimetres? gdal_edit.py -scale 0.01 FILE says that they "
                             "are centimetres, -scale 0.001 millimetres; or convert the file to metres"
      : may_be_millimetres ? "Are they in millimetres? gdal_edit.py -scale 0.001 FILE says so; or convert the file "
                             "to metres"
                           : "Is it another quantity? Give a raster of heights in metres");
}

}  // namespace farlod::plausibility
