// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/light_table.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "radiation/perez_sky.hpp"
#include "radiation/sky_grid.hpp"

namespace farlod {
namespace {

using std::numbers::pi;

/// What comes from the directions between two knots of an azimuth: along it, and from above.
struct Part {
  double along = 0.0, up = 0.0;
};
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

/// Four strips of the sun's disk, level and of the same area, by the heights of their centroids.
constexpr double sun_radius_deg = 0.2666;
constexpr std::array<double, 4> strips{-0.648, -0.2005, 0.2005, 0.648};

/// Adds the direct light of a position of the sun, of so much energy on a plane that faces it.
void add_sun(const SunPosition& sun, double energy, const SortedTurns& turns, Parts& parts) {
  const double turn = sun.azimuth.radians() / (2.0 * pi);
  const Part all{energy * cos(sun.elevation), energy * sin(sun.elevation)};
  for (const double strip : strips) {
    const Angle elevation = sun.elevation + Angle::degrees(strip * sun_radius_deg);
    // The two intervals whose middles the strip lies between
    const double slope_share = sin(elevation) / (sin(elevation) + cos(elevation));
    const double place = std::clamp(slope_share * static_cast<double>(LightTable::last_knot) - 0.5, 0.0,
                                    static_cast<double>(LightTable::last_knot - 1));
    const std::size_t below = std::min(static_cast<std::size_t>(place), LightTable::last_knot - 2);
    const double above_share = place - static_cast<double>(below);
    for (const SortedTurns::Neighbor& at : turns.around(turn - std::floor(turn)))
      for (const std::size_t up : {std::size_t{0}, std::size_t{1}}) {
        const double share = at.share * (up == 1 ? above_share : 1.0 - above_share) / static_cast<double>(strips.size());
        Part& part = parts[at.azimuth * LightTable::last_knot + below + up];
        part.along += share * all.along;
        part.up += share * all.up;
      }
  }
}

void add_direct(const LightInterval& interval, const SortedTurns& turns, Parts& parts) {
  double hours_of_sun = 0.0;
  for (const SunPosition& sun : interval.sun) hours_of_sun += sun.elevation.radians() > 0.0 ? sun.hours : 0.0;
  const double energy = energy_kwh_m2(interval.direct_normal_w_m2, interval.hours);
  if (!(energy > 0.0) || !(hours_of_sun > 0.0)) return;
  for (const SunPosition& sun : interval.sun)
    if (sun.elevation.radians() > 0.0) add_sun(sun, energy * sun.hours / hours_of_sun, turns, parts);
}

/// The light of some of the intervals.
struct DirectAndDiffuse {
  Parts direct, diffuse;
};
template <class Wanted>
DirectAndDiffuse light_of(const Light& light, std::span<const double> turns, const Wanted& wanted) {
  const std::size_t size = turns.size() * LightTable::last_knot;
  DirectAndDiffuse result{Parts(size), Parts(size)};
  const SortedTurns sorted(turns);
  SkyGrid sky;
  for (const LightInterval& interval : light.intervals) {
    if (!wanted(interval)) continue;
    sky.add(interval, light.sky_model);
    add_direct(interval, sorted, result.direct);
  }
  add_sky(
      turns, sky.on_level(), [&](double turn, Angle at) { return sky.radiance(turn, at); }, result.diffuse);
  return result;
}

void add(const Parts& more, Parts& parts) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    parts[n].along += more[n].along;
    parts[n].up += more[n].up;
  }
}

/// Layers one by one, each with parts of all azimuths.
std::vector<Parts> layers_of(const Light& light, std::span<const double> turns, std::span<const unsigned> months) {
  const std::size_t size = turns.size() * LightTable::last_knot;
  std::vector<Parts> layers(static_cast<std::size_t>(LightLayer::first_month), Parts(size));
  add_sky(
      turns, 1.0, [](double, Angle at) { return overcast_radiance(Angle::degrees(90.0) - at); },
      layers[static_cast<std::size_t>(LightLayer::overcast)]);
  add_sky(
      turns, 1.0, [](double, Angle) { return 1.0; }, layers[static_cast<std::size_t>(LightLayer::uniform)]);
  for (std::size_t n = 0; n < std::max<std::size_t>(1, months.size()); ++n) {
    DirectAndDiffuse part =
        light_of(light, turns, [&](const LightInterval& i) { return months.empty() || i.month == months[n]; });
    add(part.direct, layers[static_cast<std::size_t>(LightLayer::direct)]);
    add(part.diffuse, layers[static_cast<std::size_t>(LightLayer::diffuse)]);
    if (months.empty()) break;
    layers.push_back(std::move(part.direct));
    layers.push_back(std::move(part.diffuse));
  }
  return layers;
}

}  // namespace

std::vector<unsigned> months_by_name(const Light& light) {
  std::vector<unsigned> months;
  if (!light.by_month) return months;
  for (const LightInterval& interval : light.intervals) months.push_back(interval.month);
  std::sort(months.begin(), months.end());
  months.erase(std::unique(months.begin(), months.end()), months.end());
  return months;
}

LightTable::LightTable(const Light& light, std::span<const double> turns)
    : layers_((static_cast<std::size_t>(LightLayer::first_month) + 2 * months_by_name(light).size() + group - 1) / group * group),
      months_(months_by_name(light)),
      values_(turns.size() * (last_knot + 1) * 2 * layers_),
      on_level_(layers_),
      on_upright_(layers_) {
  for (const LightInterval& interval : light.intervals) hours_ += interval.hours;
  const std::vector<Parts> layers = layers_of(light, turns, months_);
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    Part all;
    for (std::size_t k = 0; k < turns.size(); ++k) {
      Part above;
      for (std::size_t knot = last_knot; knot-- > 0;) {
        above.along += layers[layer][k * last_knot + knot].along;
        above.up += layers[layer][k * last_knot + knot].up;
        float* const values = &values_[(k * (last_knot + 1) + knot) * 2 * layers_];
        values[layer / group * 2 * group + layer % group] = static_cast<float>(above.along);
        values[(layer / group * 2 + 1) * group + layer % group] = static_cast<float>(above.up);
      }
      all.along += above.along;
      all.up += above.up;
    }
    on_level_[layer] = static_cast<float>(all.up);
    // The mean of the positive part of a cosine over the turn is 1 / π
    on_upright_[layer] = static_cast<float>(all.along / pi);
  }
}

}  // namespace farlod
