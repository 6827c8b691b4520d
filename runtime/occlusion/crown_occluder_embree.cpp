// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "base/expects.hpp"
#include "farlod/point.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/device_embree.hpp"
#include "occlusion/prism_rays.hpp"
#include "occlusion/queries_embree.hpp"

namespace farlod {
namespace {

/// The part of a line that lies within a body: from `begin` to `end`, in lengths of the line's direction. A line that only
/// touches the body has no such part.
struct Chord {
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();

  [[nodiscard]] static Chord none() { return {0.0, 0.0}; }
  [[nodiscard]] bool is_none() const { return !(begin < end); }
  [[nodiscard]] Chord within(const Chord& other) const { return {std::max(begin, other.begin), std::min(end, other.end)}; }
};

/// The part of the line p + t d with |x| ≤ half.
[[nodiscard]] inline Chord chord_of_slab(double p, double d, double half) {
  if (d == 0.0) return std::abs(p) < half ? Chord{} : Chord::none();
  const double a = (-half - p) / d, b = (half - p) / d;
  return {std::min(a, b), std::max(a, b)};
}

/// The chord of a line with the unit ball, or with the unit circle times the z axis where both z are 0. The place that is nearest
/// to the middle comes first: the usual formula loses all digits of a ball that is far away.
[[nodiscard]] inline Chord chord_of_unit_ball(const Point3d& p, const Point3d& d) {
  const double dd = dot(d, d);
  if (dd == 0.0) return dot(p, p) < 1.0 ? Chord{} : Chord::none();
  const double middle = -dot(p, d) / dd;
  const Point3d nearest = p + middle * d;
  const double rest = 1.0 - dot(nearest, nearest);
  if (!(rest > 0.0)) return Chord::none();
  const double half = std::sqrt(rest / dd);
  return {middle - half, middle + half};
}

/// The turn of a prism, which is the same for all rays.
struct CrownTurn {
  double cosine = 1.0, sine = 0.0;

  explicit CrownTurn(const Crown& crown) {
    if (crown.shape == CrownShape::prism) cosine = std::cos(crown.turn_rad()), sine = std::sin(crown.turn_rad());
  }
};

/// The chord of a line with a crown, in the crown's frame. The direction is not 0.
[[nodiscard]] inline Chord chord_of(const Crown& crown, const CrownTurn& turn, const Point3d& origin, const Point3d& direction) {
  const double half_height_m = 0.5 * (static_cast<double>(crown.top_m) - crown.bottom_m), half_width_m = crown.half_width_m;
  const Point3d p{origin.x - crown.x_m, origin.y - crown.y_m, origin.z - crown.bottom_m - half_height_m};
  const auto scaled = [&](const Point3d& v, double z) { return Point3d{v.x / half_width_m, v.y / half_width_m, z}; };
  if (crown.shape == CrownShape::spheroid)
    return chord_of_unit_ball(scaled(p, p.z / half_height_m), scaled(direction, direction.z / half_height_m));
  const Chord layer = chord_of_slab(p.z, direction.z, half_height_m);
  if (crown.shape == CrownShape::cylinder) return layer.within(chord_of_unit_ball(scaled(p, 0.0), scaled(direction, 0.0)));
  const double c = turn.cosine, s = turn.sine;
  return layer.within(chord_of_slab(c * p.x + s * p.y, c * direction.x + s * direction.y, half_width_m))
      .within(chord_of_slab(c * p.y - s * p.x, c * direction.y - s * direction.x, half_width_m));
}
[[nodiscard]] inline Chord chord_of(const Crown& crown, const Point3d& origin, const Point3d& direction) {
  return chord_of(crown, CrownTurn(crown), origin, direction);
}

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t foliage_count = 3;

/// Embree counts bodies with 32 bits, the last of which means none.
void require_numbers_for(std::size_t crown_count) {
  constexpr std::size_t most = 0xFFFFFFFE;
  if (crown_count > most)
    throw LimitReached("a scene would have " + std::to_string(crown_count) + " crowns, and can have " + std::to_string(most) +
                       ": pack a part of the city.");
}

/// What a run makes of its settings: numbers for each Foliage.
struct CrownEffects {
  CanopyRule rule;
  std::array<double, foliage_count> transmissivity{}, extinction_per_m{};

  explicit CrownEffects(const CanopySettings& settings) : rule(settings.rule) {
    for (std::size_t n = 0; n < foliage_count; ++n) {
      transmissivity[n] = transmissivity_of(Foliage{static_cast<std::uint8_t>(n)}, settings);
      extinction_per_m[n] = extinction_per_m_of(Foliage{static_cast<std::uint8_t>(n)}, settings);
    }
  }
};

/// A crown that a ray meets.
struct Meeting {
  std::uint32_t lane, crown;
  double effect;  ///< ψ, or κ times the length by the rule `beer`

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> key() const { return {lane, crown}; }
};

/// What was found along the rays of a question. Crowns come in the order in which Embree visits them, which nobody promises, and
/// perhaps twice: products and sums are formed at the end, in the order of the crowns.
class Findings {
 public:
  explicit Findings(CanopyRule rule) : rule_(rule) {
    nearest_.fill(infinity);
    least_.fill(1.0);
  }

  /// Called by Embree, through which nothing may be thrown.
  void add(const Meeting& meeting, double begin) noexcept {
    float& nearest = nearest_[meeting.lane];
    nearest = std::min(nearest, static_cast<float>(begin));
    double& least = least_[meeting.lane];
    if (rule_ != CanopyRule::beer) least = std::min(least, meeting.effect);
    if (rule_ == CanopyRule::once) return;
    try {
      meetings_.push_back(meeting);
    } catch (const std::bad_alloc&) {
      is_out_of_memory_ = true;
    }
  }

  [[nodiscard]] CrownLights lights() {
    if (is_out_of_memory_) throw std::bad_alloc();
    std::array<double, RayOrigins::lanes> transmitted = rule_ == CanopyRule::once ? least_ : of_all_meetings();
    CrownLights lights;
    lights.nearest = nearest_;
    for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane) {
      lights.transmitted[lane] = static_cast<float>(transmitted[lane]);
      lights.met |= nearest_[lane] < infinity ? 1U << lane : 0U;
    }
    return lights;
  }

 private:
  [[nodiscard]] std::array<double, RayOrigins::lanes> of_all_meetings() {
    const auto in_order = [](const Meeting& a, const Meeting& b) { return a.key() < b.key(); };
    const auto alike = [](const Meeting& a, const Meeting& b) { return a.key() == b.key(); };
    std::sort(meetings_.begin(), meetings_.end(), in_order);
    meetings_.erase(std::unique(meetings_.begin(), meetings_.end(), alike), meetings_.end());
    const bool is_beer = rule_ == CanopyRule::beer;
    std::array<double, RayOrigins::lanes> result{};
    result.fill(is_beer ? 0.0 : 1.0);
    for (const Meeting& m : meetings_) result[m.lane] = is_beer ? result[m.lane] + m.effect : result[m.lane] * m.effect;
    if (is_beer)
      for (double& depth : result) depth = std::exp(-depth);
    return result;
  }

  CanopyRule rule_;
  std::array<float, RayOrigins::lanes> nearest_{};
  std::array<double, RayOrigins::lanes> least_{};
  std::vector<Meeting> meetings_;
  bool is_out_of_memory_ = false;
};

/// Embree hands the context of a question back to us.
struct QuestionContext {
  EmbreeContext embree;
  Findings findings;
  double enough;                    ///< a ray that met so small a ψ, or a smaller one, need not go on
  bool is_any_enough = false;       ///< no ray need go on that met a crown, and nothing is to be found besides
  const PrismRays* rays = nullptr;  ///< of the packet, where any is enough
};

}  // namespace

struct CrownOccluder::Impl {
  std::vector<Crown> crowns;
  CrownEffects effects;
  double smallest_transmissivity = 1.0;  ///< of all crowns
  OwnedScene scene;                      ///< none without crowns

  Impl(std::vector<Crown> c, const CanopySettings& settings, const std::stop_token& stop)
      : crowns(std::move(c)), effects(settings) {
    require_numbers_for(crowns.size());
    for (const Crown& crown : crowns) smallest_transmissivity = std::min(smallest_transmissivity, transmissivity_of_crown(crown));
    if (crowns.empty()) return;
    scene = scene_of(RTC_GEOMETRY_TYPE_USER, std::to_string(crowns.size()) + " crowns", stop, [this](RTCGeometry geometry) {
      rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(crowns.size()));
      rtcSetGeometryUserData(geometry, this);
      rtcSetGeometryBoundsFunction(geometry, tell_bounds, nullptr);
      rtcSetGeometryOccludedFunction(geometry, visit);
    });
  }
  ~Impl() = default;
  Impl(const Impl&) = delete;  // Embree knows where it is
  Impl& operator=(const Impl&) = delete;

  double transmissivity_of_crown(const Crown& crown) const {
    return effects.transmissivity[static_cast<std::size_t>(crown.foliage)];
  }

  double effect_of(const Crown& crown, double length_m) const {
    if (effects.rule != CanopyRule::beer) return transmissivity_of_crown(crown);
    return effects.extinction_per_m[static_cast<std::size_t>(crown.foliage)] * length_m;
  }

  static void tell_bounds(const RTCBoundsFunctionArguments* arguments) {
    const Crown& crown = static_cast<const Impl*>(arguments->geometryUserPtr)->crowns[arguments->primID];
    const double turned = crown.turn_rad();
    const double half_m = crown.half_width_m * (crown.shape == CrownShape::prism ? std::cos(turned) + std::sin(turned) : 1.0);
    // Nothing of the crown may be outside: floats are rounded to the nearest
    const auto below = [](double x) { return std::nextafter(static_cast<float>(x), -infinity); };
    const auto above = [](double x) { return std::nextafter(static_cast<float>(x), infinity); };
    *arguments->bounds_o = {below(crown.x_m - half_m), below(crown.y_m - half_m), below(crown.bottom_m), 0.0F,
                            above(crown.x_m + half_m), above(crown.y_m + half_m), above(crown.top_m),    0.0F};
  }

  /// Embree asks whether rays meet a crown. All answers but "enough" are no, so that it shows each ray all crowns on its way.
  static void visit(const RTCOccludedFunctionNArguments* arguments) {
    const Impl& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
    auto& question = *reinterpret_cast<QuestionContext*>(arguments->context);
    if (question.is_any_enough) return self.end_rays_that_meet(arguments->primID, *arguments, *question.rays);
    for (unsigned n = 0; n < arguments->N; ++n)
      if (arguments->valid[n] == -1) self.visit(arguments->primID, arguments->ray, arguments->N, n, question);
  }

  /// The part of a ray that lies within a crown.
  static Chord chord_on(RTCRayN* rays, unsigned count, unsigned n, const Crown& crown, const CrownTurn& turn) {
    const Point3d origin{RTCRayN_org_x(rays, count, n), RTCRayN_org_y(rays, count, n), RTCRayN_org_z(rays, count, n)};
    return chord_of(crown, turn, origin, direction_of(rays, count, n))
        .within({RTCRayN_tnear(rays, count, n), RTCRayN_tfar(rays, count, n)});
  }
  static Point3d direction_of(RTCRayN* rays, unsigned count, unsigned n) {
    return {RTCRayN_dir_x(rays, count, n), RTCRayN_dir_y(rays, count, n), RTCRayN_dir_z(rays, count, n)};
  }

  void end_rays_that_meet(unsigned number, const RTCOccludedFunctionNArguments& a, const PrismRays& rays) const {
    const Crown& crown = crowns[number];
    if (a.N == PrismRays::lanes && rays.see(crown)) {
      const std::uint32_t met = rays.meet(crown, &RTCRayN_tnear(a.ray, a.N, 0), &RTCRayN_tfar(a.ray, a.N, 0));
      for (unsigned n = 0; n < a.N; ++n)
        if (a.valid[n] == -1 && ((met >> n) & 1U) != 0) RTCRayN_tfar(a.ray, a.N, n) = -infinity;
      return;
    }
    const CrownTurn turn(crown);
    for (unsigned n = 0; n < a.N; ++n)
      if (a.valid[n] == -1 && !chord_on(a.ray, a.N, n, crown, turn).is_none()) RTCRayN_tfar(a.ray, a.N, n) = -infinity;
  }

  void visit(unsigned number, RTCRayN* rays, unsigned count, unsigned n, QuestionContext& question) const {
    const Crown& crown = crowns[number];
    const Chord chord = chord_on(rays, count, n, crown, CrownTurn(crown));
    if (chord.is_none()) return;
    const double effect = effect_of(crown, (chord.end - chord.begin) * norm(direction_of(rays, count, n)));
    question.findings.add({RTCRayN_id(rays, count, n), number, effect}, chord.begin);
    if (effect <= question.enough) RTCRayN_tfar(rays, count, n) = -infinity;
  }

  QuestionContext question_of(CrownQuestion question) const {
    const bool may_end = question == CrownQuestion::light && effects.rule == CanopyRule::once;
    return {embree_context(), Findings(effects.rule), may_end ? smallest_transmissivity : -1.0};
  }
};

CrownOccluder::CrownOccluder(std::vector<Crown> crowns, const CanopySettings& settings, const std::stop_token& stop)
    : impl_(std::make_unique<Impl>(std::move(crowns), settings, stop)) {}
CrownOccluder::CrownOccluder(CrownOccluder&&) noexcept = default;
CrownOccluder& CrownOccluder::operator=(CrownOccluder&&) noexcept = default;
CrownOccluder::~CrownOccluder() = default;

std::size_t CrownOccluder::crown_count() const { return impl_->crowns.size(); }

CrownLight CrownOccluder::light(const Ray& ray, CrownQuestion question) const {
  if (impl_->scene == nullptr) return {};
  QuestionContext context = impl_->question_of(question);
  const Point3f &o = ray.origin, &d = ray.direction;
  RTCRay query{o.x, o.y, o.z, ray.begin, d.x, d.y, d.z, 0.0F, ray.end, ~0U, 0, 0};
  ask_occluded(impl_->scene.get(), context.embree, query);
  const CrownLights lights = context.findings.lights();
  return {lights.transmitted[0], lights.nearest[0]};
}

CrownLights CrownOccluder::light(const RayOrigins& origins, const Point3f& direction, float begin, std::uint32_t wanted,
                                 CrownQuestion question) const {
  return light(origins, sixteen_times(direction), begin, wanted, question);
}

CrownLights CrownOccluder::light(const RayOrigins& origins, const Occluder::Directions& directions, float begin,
                                 std::uint32_t wanted, CrownQuestion question) const {
  QuestionContext context = impl_->question_of(question);
  if (impl_->scene == nullptr || wanted == 0) return context.findings.lights();
  RayPacket packet(origins, directions, begin, wanted);
  ask_occluded(packet.valid.data(), impl_->scene.get(), context.embree, packet.rays);
  return context.findings.lights();
}

std::uint32_t CrownOccluder::met_before(const Occluder::Distances& ends, const RayOrigins& origins,
                                        const Occluder::Directions& directions, float begin, std::uint32_t wanted) const {
  if (impl_->scene == nullptr || wanted == 0) return 0;
  QuestionContext context = impl_->question_of(CrownQuestion::light);
  context.is_any_enough = true;
  const PrismRays prism_rays(origins, directions, impl_->crowns.front());
  context.rays = &prism_rays;
  RayPacket packet(origins, directions, begin, wanted);
  for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane)
    packet.rays.tfar[lane] = std::min(packet.rays.tfar[lane], ends[lane]);
  ask_occluded_together(packet.valid.data(), impl_->scene.get(), context.embree, packet.rays);
  std::uint32_t met = 0;
  for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane) met |= packet.rays.tfar[lane] < 0.0F ? 1U << lane : 0U;
  return met & wanted;
}

}  // namespace farlod
