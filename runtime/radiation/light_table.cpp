// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/light_table.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <utility>

#include "radiation/perez_sky.hpp"
#include "radiation/sky_grid.hpp"

namespace farlod {
namespace {

using std::numbers::pi;

using Part = LightPart;
/// Parts of all azimuths: [azimuth][knot].
using Parts = std::vector<Part>;

/// ∫ cos² θ dθ and ∫ cos θ sin θ dθ between two knots.
struct KnotIntegrals {
  Angle middle;
  Part integral;
};
double elevation_of_knot(std::size_t knot) {
  return std::atan2(static_cast<double>(knot), static_cast<double>(LightTable::last_knot - knot));
}
std::vector<KnotIntegrals> integrals_between_knots() {
  std::vector<KnotIntegrals> knots;
  const auto along = [](double at) { return 0.5 * (at + std::sin(at) * std::cos(at)); };
  for (std::size_t n = 0; n < LightTable::last_knot; ++n) {
    const double from = elevation_of_knot(n), to = elevation_of_knot(n + 1);
    knots.push_back({Angle::radians(0.5 * (from + to)),
                     {along(to) - along(from), 0.5 * (std::pow(std::sin(to), 2) - std::pow(std::sin(from), 2))}});
  }
  return knots;
}

/// Adds a radiance, as a function of the turn and the elevation, so that all of it on a level plane is `on_level`.
template <class Radiance>
void add_sky(std::span<const double> turns, double on_level, const Radiance& radiance, Parts& parts) {
  static const std::vector<KnotIntegrals> knots = integrals_between_knots();
  Parts sky(parts.size());
  double all = 0.0;
  for (std::size_t k = 0; k < turns.size(); ++k)
    for (std::size_t n = 0; n < knots.size(); ++n) {
      const double r = radiance(turns[k], knots[n].middle);
      sky[k * knots.size() + n] = {r * knots[n].integral.along, r * knots[n].integral.up};
      all += r * knots[n].integral.up;
    }
  if (!(all > 0.0)) return;
  const double scale = on_level / all;
  for (std::size_t n = 0; n < sky.size(); ++n) {
    parts[n].along += scale * sky[n].along;
    parts[n].up += scale * sky[n].up;
  }
}

/// The azimuths by their turns, and the two that a turn lies between.
class SortedTurns {
 public:
  explicit SortedTurns(std::span<const double> turns) {
    for (std::size_t k = 0; k < turns.size(); ++k) turns_.emplace_back(turns[k], k);
    std::sort(turns_.begin(), turns_.end());
  }
  /// The mean angle from one to the next.
  [[nodiscard]] Angle apart() const { return Angle::radians(2.0 * pi / static_cast<double>(turns_.size())); }
  struct Neighbor {
    std::size_t azimuth = 0;
    double share = 0.0;
  };
  [[nodiscard]] std::array<Neighbor, 2> around(double turn) const {
    const auto above = std::upper_bound(turns_.begin(), turns_.end(), std::pair(turn, turns_.size()));
    const auto& after = above == turns_.end() ? turns_.front() : *above;
    const auto& before = above == turns_.begin() ? turns_.back() : *(above - 1);
    const auto positive = [](double d) { return d - std::floor(d); };
    const double gap = positive(after.first - before.first), from = positive(turn - before.first);
    const double share = gap > 0.0 ? std::clamp(from / gap, 0.0, 1.0) : 0.0;
    return {Neighbor{before.second, 1.0 - share}, Neighbor{after.second, share}};
  }

 private:
  std::vector<std::pair<double, std::size_t>> turns_;
};

/// Four strips of the sun's disk, level and of the same area, by the heights of their centroids in radii of the disk.
constexpr Angle sun_radius = Angle::degrees(0.2666);
constexpr std::array<double, 4> strips{-0.648, -0.2005, 0.2005, 0.648};
/// The sine and cosine of how much higher a strip is than the middle.
struct StripHeight {
  explicit StripHeight(double radii) : sine(sin(radii * sun_radius)), cosine(cos(radii * sun_radius)) {}
  double sine, cosine;
};

/// Adds the direct light of a position of the sun, of so much energy on a plane that faces it.
void add_sun(const SunPosition& sun, double energy, const SortedTurns& turns, Parts& parts) {
  static const std::array heights{StripHeight(strips[0]), StripHeight(strips[1]), StripHeight(strips[2]), StripHeight(strips[3])};
  const double turn = sun.azimuth.radians() / (2.0 * pi), level = cos(sun.elevation), up = sin(sun.elevation);
  const std::array<SortedTurns::Neighbor, 2> around = turns.around(turn - std::floor(turn));
  for (const StripHeight& height : heights) {
    const double sine = up * height.cosine + level * height.sine, cosine = level * height.cosine - up * height.sine;
    // The two intervals whose middles the strip lies between
    const double place = std::clamp(sine / (sine + cosine) * static_cast<double>(LightTable::last_knot) - 0.5, 0.0,
                                    static_cast<double>(LightTable::last_knot - 1));
    const std::size_t below = std::min(static_cast<std::size_t>(place), LightTable::last_knot - 2);
    const double above_share = place - static_cast<double>(below);
    for (const SortedTurns::Neighbor& at : around)
      for (const std::size_t higher : {std::size_t{0}, std::size_t{1}}) {
        const double share =
            energy * at.share * (higher == 1 ? above_share : 1.0 - above_share) / static_cast<double>(strips.size());
        Part& part = parts[at.azimuth * LightTable::last_knot + below + higher];
        part.along += share * level;
        part.up += share * up;
      }
  }
}

void add(const Parts& more, Parts& parts) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    parts[n].along += more[n].along;
    parts[n].up += more[n].up;
  }
}

/// The sun's way between its positions, one after the other.
class WayOfSun {
 public:
  explicit WayOfSun(std::span<const SunLight> suns) : suns_(suns) {}

  /// The sun from halfway after the position before to halfway to the next one, at places that are no farther apart than this: an
  /// edge that it passes there would else be passed at once.
  [[nodiscard]] std::vector<SunPosition> around(std::size_t n, Angle most_apart) const {
    const Step to_next = step(n), before = n > 0 && !step(n - 1).is_none() ? step(n - 1) : to_next,
               after = to_next.is_none() ? before : to_next;
    const double parts = std::ceil(std::max(before.longest_rad(), after.longest_rad()) / most_apart.radians());
    const auto count = static_cast<std::size_t>(std::clamp(parts, 1.0, most_parts));
    std::vector<SunPosition> places(count, suns_[n].sun);
    for (std::size_t k = 0; k < count; ++k) {
      const double on = (static_cast<double>(k) + 0.5) / static_cast<double>(count) - 0.5;
      const Step& way = on < 0.0 ? before : after;
      places[k].azimuth = places[k].azimuth + Angle::radians(on * way.azimuth_rad);
      places[k].elevation = places[k].elevation + Angle::radians(on * way.elevation_rad);
    }
    return places;
  }

 private:
  static constexpr double most_parts = 16.0;
  struct Step {
    double azimuth_rad = 0.0, elevation_rad = 0.0;
    [[nodiscard]] double longest_rad() const { return std::max(std::abs(azimuth_rad), std::abs(elevation_rad)); }
    [[nodiscard]] bool is_none() const { return azimuth_rad == 0.0 && elevation_rad == 0.0; }
  };
  /// From a position to the next one. None where it does not go on.
  [[nodiscard]] Step step(std::size_t n) const {
    if (n + 1 >= suns_.size() || !suns_[n + 1].goes_on) return {};
    const SunPosition &here = suns_[n].sun, &next = suns_[n + 1].sun;
    return {std::remainder((next.azimuth - here.azimuth).radians(), 2.0 * pi), (next.elevation - here.elevation).radians()};
  }

  std::span<const SunLight> suns_;
};

void add_direct(std::span<const SunLight> suns, const SortedTurns& turns, Parts& parts) {
  const Angle apart = std::min(turns.apart(), Angle::degrees(0.3));
  const WayOfSun way(suns);
  for (std::size_t n = 0; n < suns.size(); ++n) {
    if (!(suns[n].energy > 0.0)) continue;
    const std::vector<SunPosition> places = way.around(n, apart);
    for (const SunPosition& sun : places) add_sun(sun, suns[n].energy / static_cast<double>(places.size()), turns, parts);
  }
}

struct DirectAndDiffuse {
  Parts direct, diffuse;
};
DirectAndDiffuse light_of(const SunAndSky& light, std::span<const double> turns) {
  const std::size_t size = turns.size() * LightTable::last_knot;
  DirectAndDiffuse result{Parts(size), Parts(size)};
  add_direct(light.suns, SortedTurns(turns), result.direct);
  add_sky(
      turns, light.sky.on_level(), [&](double turn, Angle at) { return light.sky.radiance(turn, at); }, result.diffuse);
  return result;
}

double up_of(const Parts& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0, [](double sum, const Part& part) { return sum + part.up; });
}

/// Layers one by one, each with parts of all azimuths.
struct Layers {
  std::vector<Parts> of;
  std::vector<float> diffuse_of_totals;
  /// Adds all light as one layer.
  void add_total(DirectAndDiffuse light) {
    diffuse_of_totals.push_back(static_cast<float>(up_of(light.diffuse)));
    add(light.diffuse, light.direct);
    of.push_back(std::move(light.direct));
  }
};
/// The uniform and the overcast sky have one azimuth.
Layers layers_of(const LightOfPeriod& light, std::span<const double> turns) {
  Layers layers{std::vector<Parts>(static_cast<std::size_t>(LightLayer::first_total)), {}};
  const auto of = [&](LightLayer layer) -> Parts& { return layers.of[static_cast<std::size_t>(layer)]; };
  for (const LightLayer layer : {LightLayer::uniform, LightLayer::overcast}) of(layer).resize(LightTable::last_knot);
  for (const LightLayer layer : {LightLayer::direct, LightLayer::diffuse}) of(layer).resize(turns.size() * LightTable::last_knot);
  const double of_azimuth = 1.0 / static_cast<double>(turns.size());
  add_sky(
      turns.first(1), of_azimuth, [](double, Angle at) { return overcast_radiance(Angle::degrees(90.0) - at); },
      of(LightLayer::overcast));
  add_sky(
      turns.first(1), of_azimuth, [](double, Angle) { return 1.0; }, of(LightLayer::uniform));
  for (const SunAndSky& energy : light.energy) {
    DirectAndDiffuse part = light_of(energy, turns);
    add(part.direct, of(LightLayer::direct));
    add(part.diffuse, of(LightLayer::diffuse));
    if (!light.months.empty()) layers.add_total(std::move(part));
  }
  if (light.illuminance) layers.add_total(light_of(*light.illuminance, turns));
  return layers;
}

}  // namespace

std::string begin_text_of(const LightInterval& interval) {
  const auto midnight = std::chrono::floor<std::chrono::days>(interval.begin);
  const std::chrono::year_month_day day(midnight);
  const auto minutes = std::chrono::floor<std::chrono::minutes>(interval.begin - midnight).count();
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%04d%02u%02uT%02d%02d", static_cast<int>(day.year()),
                static_cast<unsigned>(day.month()), static_cast<unsigned>(day.day()), static_cast<int>(minutes / 60),
                static_cast<int>(minutes % 60));
  return text.data();
}

LightTable::LightTable(const LightOfPeriod& light, std::span<const double> turns)
    : months_(light.months), hours_(light.hours), hours_of_illuminance_(light.hours_of_illuminance) {
  Layers layers = layers_of(light, turns);
  diffuse_of_totals_ = std::move(layers.diffuse_of_totals);
  pairs_ = (layers.of.size() + 1) / 2;
  even_.resize(last_knot + 1);
  values_.resize(turns.size() * (last_knot + 1) * (pairs_ - 1));
  for (std::size_t layer = 0; layer < layers.of.size(); ++layer) add_layer(layer, layers.of[layer], turns.size());
}

void LightTable::add_layer(std::size_t layer, std::span<const LightPart> parts, std::size_t azimuths) {
  const bool is_even = layer / 2 == 0;
  LightPart all;
  for (std::size_t k = 0; k < (is_even ? 1 : azimuths); ++k) {
    LightPart above;
    for (std::size_t knot = last_knot; knot-- > 0;) {
      const LightPart& part = parts[k * last_knot + knot];
      above = {above.along + part.along, above.up + part.up};
      LightPair& pair = is_even ? even_[knot] : values_[(k * (last_knot + 1) + knot) * (pairs_ - 1) + layer / 2 - 1];
      pair.along[layer % 2] = static_cast<float>(above.along);
      pair.up[layer % 2] = static_cast<float>(above.up);
    }
    all = {all.along + above.along, all.up + above.up};
  }
  const double times = is_even ? static_cast<double>(azimuths) : 1.0;
  on_level_.push_back(static_cast<float>(times * all.up));
  // The mean of the positive part of a cosine over the turn is 1 / π
  on_upright_.push_back(static_cast<float>(times * all.along / pi));
}

}  // namespace farlod
