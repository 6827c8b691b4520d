// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_jumps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "farlod/point.hpp"
#include "horizon/kernels.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {
namespace {

/// What may come into sight in a wedge where a border ends. Nothing is looked for among no edges.
struct BordersInWedge {
  const DrawnEdges* drawn;
  std::uint32_t wedge, wedges;
  float least;  ///< how much sky must be at stake
};

/// A place on the way from the higher of two horizons to the lower one: the share of the way, and its slope.
struct PlaceOnWay {
  float share, slope;
};

/// Where places are seen from a receiver.
class Way {
 public:
  /// The way goes from the azimuth (cosine, sine), by so much of an angle as −1 or 1 times `per_angle` says.
  Way(const Point3f& receiver, float cosine, float sine, float per_angle)
      : receiver_(receiver), cosine_(cosine), sine_(sine), per_angle_(per_angle) {}

  [[nodiscard]] PlaceOnWay place(const Point3f& p) const {
    const float x = p.x - receiver_.x, y = p.y - receiver_.y, inverse = 1.0F / std::sqrt(x * x + y * y);
    return {(cosine_ * y - sine_ * x) * inverse * per_angle_, (p.z - receiver_.z) * inverse};
  }
  /// Looks along a share of it.
  [[nodiscard]] LookInWedge look(const BordersInWedge& borders, float share, float above) const {
    const float s = share / per_angle_, c = std::sqrt(1.0F - s * s);
    return {.wedge = borders.wedge,
            .wedges = borders.wedges,
            .x = receiver_.x,
            .y = receiver_.y,
            .z = receiver_.z,
            .cosine = cosine_ * c - sine_ * s,
            .sine = sine_ * c + cosine_ * s,
            .above = above};
  }

 private:
  Point3f receiver_;
  float cosine_, sine_, per_angle_;
};

/// The sky above slopes at one azimuth, for slopes that are in front of the receiver: F of docs/concepts.md, "Above a horizon".
class SkyAtAzimuth {
 public:
  SkyAtAzimuth(SkyWeight weight, float outward, float upward)
      : weight_(weight),
        outward_(outward),
        upward_(upward),
        lowest_(outward <= 0.0F && upward > 0.0F ? -outward / upward : 0.0F),
        highest_(outward > 0.0F && upward < 0.0F ? -outward / upward : std::numeric_limits<float>::infinity()),
        behind_(std::isinf(highest_) ? 0.0F : integral_from(highest_)) {}

  [[nodiscard]] float above(float slope) const {
    if (outward_ <= 0.0F && upward_ <= 0.0F) return 0.0F;
    return integral_from(std::clamp(slope, lowest_, highest_)) - behind_;
  }

 private:
  [[nodiscard]] float integral_from(float t) const {
    if (std::isinf(t)) return 0.0F;
    const float cos_square = 1.0F / (1.0F + t * t);
    if (weight_ == SkyWeight::solid_angle) return 1.0F - t * std::sqrt(cos_square);
    if (outward_ == 0.0F) return upward_ * cos_square;  // most receivers look straight up
    const float zenith_distance = std::numbers::pi_v<float> / 2.0F - std::atan(t);
    return outward_ * (zenith_distance - t * cos_square) + upward_ * cos_square;
  }

  SkyWeight weight_;
  float outward_, upward_, lowest_, highest_, behind_;
};

/// The higher horizon goes on along its edge and those that follow it, and then along what is highest beyond, as far as that
/// reaches above the lower horizon.
class BorderOnWay {
 public:
  BorderOnWay(const Way& way, const BorderEnds& ends, float higher_slope, float lower_slope)
      : way_(way), ends_(ends), at_{0.0F, higher_slope}, lower_slope_(lower_slope) {}

  /// Goes to the end of an edge that lies on the way. False if there is none.
  [[nodiscard]] bool go_along(std::int32_t edge) {
    const auto [share, end] = farther_end(static_cast<std::size_t>(edge));
    if (!(share >= 0.0F && share < 1.0F)) return false;
    go_to(next_to(end));
    return true;
  }
  /// Goes on along the edge that leads farthest from where another one ended. False if there is none.
  [[nodiscard]] bool go_on() {
    if (!end_) return false;
    std::optional<Next> farthest;
    for (std::size_t n = ends_.end(*end_).next; n != *end_; n = ends_.end(n).next)
      if (const Next next = next_to(n ^ 1U); next.place.share > (farthest ? farthest->place.share : at_.share)) farthest = next;
    if (farthest) go_to(*farthest);
    return farthest.has_value();
  }
  /// Goes to the end of the highest border that is seen beside the end of another one, and tells the slope at which it comes into
  /// sight. None if nothing is above the lower horizon.
  [[nodiscard]] std::optional<float> go_beyond(const BordersInWedge& borders) {
    // So far beside the end that rounding does not matter: with 320 azimuths 1 mm at 50 m
    constexpr float beside = 1e-3F;
    if (!end_ || borders.drawn == nullptr || !(at_.share + beside < 1.0F)) return std::nullopt;
    const HighestBorder highest = wedge_end_kernels().find_highest(borders.drawn->spans(), borders.drawn->size(), ends_.all(),
                                                                   way_.look(borders, at_.share + beside, lower_slope_));
    if (highest.number < 0) return std::nullopt;
    at_.slope = highest.slope;
    const auto [share, end] = farther_end(static_cast<std::size_t>(highest.number));
    go_to(share > at_.share ? next_to(end) : Next{{1.0F, lower_slope_}, std::nullopt});
    return highest.slope;
  }
  [[nodiscard]] const PlaceOnWay& at() const { return at_; }

 private:
  struct Next {
    PlaceOnWay place;
    std::optional<std::size_t> end;  ///< unless it lies below the lower horizon, or beyond its azimuth
  };
  struct FartherEnd {
    float share;
    std::size_t end;
  };
  [[nodiscard]] FartherEnd farther_end(std::size_t edge) const {
    const float share_a = way_.place(ends_.end(2 * edge).p).share, share_b = way_.place(ends_.end(2 * edge + 1).p).share;
    return share_b > share_a ? FartherEnd{share_b, 2 * edge + 1} : FartherEnd{share_a, 2 * edge};
  }
  /// The end of an edge from here; or where it comes down to the lower horizon, which it does at the latest at its azimuth.
  [[nodiscard]] Next next_to(std::size_t end) const {
    const PlaceOnWay place = way_.place(ends_.end(end).p);
    if (!(place.share > at_.share) || (place.slope > lower_slope_ && place.share <= 1.0F)) return {place, end};
    const float down = at_.slope > place.slope ? (at_.slope - lower_slope_) / (at_.slope - place.slope) : 1.0F;
    const float share = at_.share + std::clamp(down, 0.0F, 1.0F) * (place.share - at_.share);
    return {{std::min(share, 1.0F), lower_slope_}, std::nullopt};
  }
  void go_to(const Next& next) {
    at_ = next.place;
    end_ = next.end;
  }

  const Way& way_;
  const BorderEnds& ends_;
  PlaceOnWay at_;
  float lower_slope_;
  std::optional<std::size_t> end_;
};

/// The sky above both horizons, at one azimuth.
struct SkyOfBoth {
  float higher, lower;
};

/// How much more the mean sky on the way is than with the jump in its middle: past the border and what comes into sight where it
/// ends, and then above the lower horizon.
struct AddedSky {
  float sky, light;
};
AddedSky added_sky(BorderOnWay& border, const BordersInWedge& borders, const SkyAtAzimuth& sky, const SkyOfBoth& both) {
  // More edges within one jump are not followed
  constexpr int most_edges = 16;
  constexpr float half = 0.5F;
  float share = 0.0F, here = both.higher, mean = 0.0F;
  const auto added = [&] { return mean + (1.0F - share) * both.lower - half * (both.higher + both.lower); };
  std::optional<float> of_sky;  // once light alone is looked for
  for (int n = 0; n < most_edges; ++n) {
    const float there = sky.above(border.at().slope);
    mean += half * (border.at().share - share) * (here + there);
    share = border.at().share;
    here = there;
    if (border.go_on()) continue;
    const float at_stake = (1.0F - share) * (both.lower - there);
    if (!(at_stake > borders.least)) break;
    if (!of_sky && !(at_stake > HorizonJumps::least_of_sky.beyond)) of_sky = added();
    const std::optional<float> slope = border.go_beyond(borders);
    if (!slope) break;
    here = sky.above(*slope);
  }
  return {of_sky.value_or(added()), added()};
}

}  // namespace

HorizonJumps::SkyAbove HorizonJumps::sky_above(const PacketHorizon& horizon, SkyWeight weight, const ReceiverPacket& receivers,
                                               std::uint32_t in_recess, const OfAzimuths& of_azimuths) {
  const auto [of_sky, of_light] = of_azimuths;
  SkyAbove above{horizon.sky_above(weight, receivers, sky_), {}};
  std::copy_n(sky_.begin(), of_sky.size(), of_sky.begin());
  std::copy_n(sky_.begin(), of_light.size(), of_light.begin());
  if (azimuths_.size() < least_azimuths) return above;
  const bool is_light = !of_light.empty();
  const Least least = is_light ? least_of_light : least_of_sky;
  for (const SkyJump& jump : horizon.find_jumps(sky_, least.jump, jumps_))
    for (std::uint32_t lanes = jump.receivers; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      const Correction correction = correction_of(jump.azimuth, lane, {horizon, weight, receivers, least, in_recess});
      if (is_light) of_light[correction.azimuth_of(correction.light)][lane] += correction.light;
      const float of_rows = std::abs(sky_[jump.azimuth][lane] - sky_[after(jump.azimuth)][lane]);
      if (!(of_rows > least_of_sky.jump) || correction.jump < least_of_sky.jump) continue;
      above.correction[lane] += correction.sky;
      if (!of_sky.empty()) of_sky[correction.azimuth_of(correction.sky)][lane] += correction.sky;
    }
  for (std::size_t l = 0; l < above.sky.size(); ++l) {
    above.correction[l] /= static_cast<float>(azimuths_.size());
    above.sky[l] = std::clamp(above.sky[l] + above.correction[l], 0.0F, 1.0F);
  }
  return above;
}

HorizonJumps::Correction HorizonJumps::correction_of(std::size_t azimuth, std::size_t lane, const Seen& seen) const {
  const auto& [horizon, weight, receivers, least, in_recess] = seen;
  const std::size_t next = after(azimuth);
  const bool is_here = horizon.row(azimuth)[lane] > horizon.row(next)[lane];
  const std::size_t higher = is_here ? azimuth : next, lower = is_here ? next : azimuth;
  const float higher_slope = horizon.row(higher)[lane], lower_slope = horizon.row(lower)[lane];
  const std::int32_t edge = horizon.edge_number(higher, lane);
  if (edge < 0) return {};
  const float *cosine = azimuths_.cosine(), *sine = azimuths_.sine();
  // (1) How far the higher one reaches
  const float per_angle = static_cast<float>(azimuths_.size()) / (2.0F * std::numbers::pi_v<float>);
  const Way way({receivers.x[lane], receivers.y[lane], receivers.z[lane]}, cosine[higher], sine[higher],
                is_here ? per_angle : -per_angle);
  BorderOnWay border(way, ends_, higher_slope, lower_slope);
  if (!border.go_along(edge)) return {};
  // (2) Both horizons at one azimuth: what is left is the jump, and not the turn of the receiver's normal
  constexpr float half = 0.5F;
  const float outward = half * (receivers.normal_x[lane] * (cosine[higher] + cosine[lower]) +
                                receivers.normal_y[lane] * (sine[higher] + sine[lower]));
  const SkyAtAzimuth sky(weight, outward, receivers.normal_z[lane]);
  const SkyOfBoth both{sky.above(higher_slope), sky.above(lower_slope)};
  const float size = both.lower - both.higher;
  if (size < least.jump) return {};
  const bool looks = azimuths_.size() >= least_azimuths_to_look && ((in_recess >> lane) & 1U) == 0;
  const BordersInWedge borders{looks ? &horizon.drawn() : nullptr, static_cast<std::uint32_t>(azimuth),
                               static_cast<std::uint32_t>(azimuths_.size()), least.beyond};
  const AddedSky added = added_sky(border, borders, sky, both);
  return {added.sky, added.light, higher, lower, size};
}

}  // namespace farlod
