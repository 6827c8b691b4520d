// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_evaluator.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "evaluate/canopy_answers.hpp"
#include "evaluate/error_budget.hpp"
#include "evaluate/further_answers.hpp"
#include "evaluate/retraced_rays.hpp"
#include "evaluate/sky_parts.hpp"
#include "evaluate/traced_canopy.hpp"
#include "evaluate/visibility.hpp"
#include "evaluate/whole_city_on_demand.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/horizon_engine.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/receiver_packet.hpp"
#include "package/package_error.hpp"
#include "rays/ray_engine.hpp"
#include "scene/canopy_around.hpp"
#include "scene/near_scene.hpp"

namespace farlod {
namespace {

/// An index of the whole city takes some 150 bytes a triangle: 45 MB.
constexpr std::uint64_t most_triangles_indexed_whole = 300'000;

std::vector<Point3f> places_of(std::span<const Receiver> receivers) {
  std::vector<Point3f> places;
  for (const Receiver& r : receivers) places.push_back(r.p_cell);
  return places;
}

SvfInterval svf_of(const FreeRays& free, std::size_t ray_count) {
  const auto part = [ray_count](std::uint32_t n) {
    return static_cast<float>(static_cast<double>(n) / static_cast<double>(ray_count));
  };
  return {part(free.low), part(free.estimate), part(free.high)};
}

void store(const SvfInterval& svf, std::size_t index, const SkyAnswers& answers) {
  answers.svf[index] = svf.estimate;
  if (answers.low.empty()) return;
  answers.low[index] = svf.low;
  answers.high[index] = svf.high;
}

/// Counts the free ones of the directions by tracing, and stores the answers; `origins` are those of the receivers in the frame
/// of the occluder.
void count_and_store(const Occluder& occluder, std::span<const Point3f> origins, std::span<const Point3d> directions,
                     std::span<const Receiver> receivers, std::size_t ray_count, const std::stop_token& stop,
                     const SkyAnswers& answers) {
  const std::vector<std::uint32_t> free = count_free(occluder, origins, directions, stop);
  for (std::size_t n = 0; n < receivers.size(); ++n)
    store(svf_of({free[n], free[n], free[n]}, ray_count), receivers[n].index, answers);
}

}  // namespace

double sampling_error_of(const SkySettings& settings, FarMapOfCell far_map) {
  const EvaluationMethod method = method_of(settings.engine, far_map);
  const bool has_horizons = method == EvaluationMethod::horizons_alone || method == EvaluationMethod::horizons_and_rays;
  // With an allowed far error, rays answer some receivers of `horizons_alone`, too
  const bool has_rays = method != EvaluationMethod::horizons_alone || settings.max_far_error.has_value();
  return std::max(has_rays ? sampling_error(settings.rays) : 0.0, has_horizons ? azimuth_error(settings.azimuths) : 0.0);
}

SkyEvaluator::SkyEvaluator(const PackageReader& package, const SkySettings& settings, std::stop_token stop)
    : SkyEvaluator(package, settings, std::move(stop), std::make_shared<WholeCityOnDemand>()) {}

SkyEvaluator::SkyEvaluator(const SkyEvaluator& other, const SkySettings& settings)
    : SkyEvaluator(other.package_, settings, other.stop_, other.city_) {}

SkyEvaluator::SkyEvaluator(const PackageReader& package, const SkySettings& settings, std::stop_token stop,
                           std::shared_ptr<WholeCityOnDemand> city)
    : package_(package),
      settings_(settings),
      stop_(std::move(stop)),
      directions_(settings.weight, settings.rays, package.grid().rotation, settings.directions, stop_),
      further_(settings.further, settings.azimuths, package.manifest()),
      city_(std::move(city)) {
  FARLOD_EXPECTS(!settings.max_far_error || settings.engine == Engine::exact || settings.engine == Engine::near_only ||
                 !package.manifest().far_map.is_box());
}
SkyEvaluator::~SkyEvaluator() = default;

EvaluationMethod SkyEvaluator::method_for(Cell cell) const { return method_of(settings_.engine, far_map_of(package_, cell)); }

void SkyEvaluator::evaluate(const CellReceivers& cell, const SkyAnswers& answers) const {
  if (cell.receivers.empty()) return;
  throw_if_cancelled(stop_);
  evaluate_by_method(cell, answers);
  if (settings_.further.horizon_distances) find_horizon_distances(cell, answers);
}

void SkyEvaluator::evaluate_by_method(const CellReceivers& cell, const SkyAnswers& answers) const {
  switch (method_for(cell.cell)) {
    case EvaluationMethod::horizons_and_rays:
    case EvaluationMethod::horizons_alone:
      return evaluate_by_horizons(cell, answers);
    case EvaluationMethod::rays_against_horizons:
      return evaluate_by_rays_against_horizons(cell, answers);
    case EvaluationMethod::near_scene_and_box:
    case EvaluationMethod::near_scene_alone:
      return evaluate_by_near_scene(cell, answers);
    case EvaluationMethod::whole_city:
      return evaluate_by_whole_city(cell, answers);
  }
}

void SkyEvaluator::find_horizon_distances(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  const WholeCity& city = city_->city(package_, stop_);
  const auto scene_ready = Clock::now();
  const HorizonColumns wanted = further_.horizon_columns();
  for (const Receiver& r : cell.receivers) {
    throw_if_cancelled(stop_);
    trace_horizon_distances(city.occluder(), city.scene_from_cell(r.p_cell, cell.cell), wanted,
                            answers.further.subspan(r.index * further_.size(), further_.size()));
  }
  add_times(start, scene_ready);
}

void SkyEvaluator::count(const SkyAnswers& answers, const RayCounts& more) const {
  by_rays_ += more.by_rays;
  retraced_rays_ += more.retraced_rays;
  if (answers.counts == nullptr) return;
  answers.counts->by_rays += more.by_rays;
  answers.counts->retraced_rays += more.retraced_rays;
}

void SkyEvaluator::add_times(Clock::time_point start, Clock::time_point scene_ready) const {
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  scenes_s_ += seconds(scene_ready - start);
  evaluate_s_ += seconds(Clock::now() - scene_ready);
}

void SkyEvaluator::evaluate_by_whole_city(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  const WholeCity& city = city_->city(package_, stop_);
  const auto scene_ready = Clock::now();
  for_each_normal(cell.receivers, [&](std::span<const Receiver> group) {
    std::vector<Point3f> origins;
    for (const Receiver& r : group) origins.push_back(city.scene_from_cell(r.p_cell, cell.cell));
    const std::vector<Point3d> directions = directions_.facing_as(group.front());
    count_and_store(city.occluder(), origins, directions, group, directions_.ray_count(), stop_, answers);
  });
  const PlacedScene scene = whole_city(cell.cell);
  const auto blocked = [&](const ReceiverPacket& packet, const Occluder::Directions& directions, std::uint32_t wanted) {
    return scene.occluder.blocked(scene.origins_of(packet), directions, least_distance_m, wanted);
  };
  trace_further(cell, blocked, answers);
  if (further_.canopy_columns().count > 0) {
    const CrownOccluder& crowns = city_->crowns(package_, settings_.further.canopy, stop_);
    store_traced_canopies(cell, {city.occluder(), crowns}, scene.scene_from_cell_m, directions_, further_, answers, stop_);
  }
  add_times(start, scene_ready);
}

void SkyEvaluator::evaluate_by_near_scene(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  const Occluder near = near_scene(package_, cell.cell);
  const bool has_box = method_for(cell.cell) == EvaluationMethod::near_scene_and_box;
  const BoxFarMap far = has_box ? package_.box_far_map(cell.cell) : BoxFarMap();
  const auto scene_ready = Clock::now();
  for_each_normal(cell.receivers, [&](std::span<const Receiver> group) {
    std::vector<Point3d> directions = directions_.facing_as(group.front());
    // A box map is looked up by direction alone: what it blocks is blocked for the whole group, and needs no ray
    std::erase_if(directions, [&far](const Point3d& d) { return far.blocks(d); });
    count_and_store(near, places_of(group), directions, group, directions_.ray_count(), stop_, answers);
  });
  const auto blocked = [&](const ReceiverPacket& packet, const Occluder::Directions& directions, std::uint32_t wanted) {
    std::uint32_t by_far = 0;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      by_far |= far.blocks({directions.x[l], directions.y[l], directions.z[l]}) ? 1U << l : 0U;
    const PlacedScene scene{near, {}};
    return by_far | near.blocked(scene.origins_of(packet), directions, least_distance_m, wanted);
  };
  trace_further(cell, blocked, answers);
  if (further_.canopy_columns().count > 0) {
    const CrownOccluder crowns(canopy_around(package_, cell.cell, bounding_box(cell.receivers).low.z), settings_.further.canopy,
                               stop_);
    const CanopyScene scene{near, crowns, [&](const Point3d& d) { return far.blocks(d); }};
    store_traced_canopies(cell, scene, {}, directions_, further_, answers, stop_);
  }
  add_times(start, scene_ready);
}

std::vector<float> SkyEvaluator::trace_near_sky(const CellReceivers& cell) const {
  const Occluder near = near_scene(package_, cell.cell);
  std::vector<float> svf;
  for_each_normal(cell.receivers, [&](std::span<const Receiver> group) {
    const std::vector<Point3d> directions = directions_.facing_as(group.front());
    for (const std::uint32_t free : count_free(near, places_of(group), directions, stop_))
      svf.push_back(svf_of({free, free, free}, directions_.ray_count()).estimate);
  });
  return svf;
}

void SkyEvaluator::trace_further(const CellReceivers& cell, const BlockedRaysOfPacket& blocked, const SkyAnswers& answers) const {
  if (!further_.needs_profiles()) return;
  FurtherAnswers further(further_, cell, answers);
  if (further_.needs_near_sky()) further.set_near_sky(trace_near_sky(cell));
  for_each_group(cell.receivers, packet_order(cell.receivers, stop_),
                 [&](std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers) {
                   further.trace(packets, blocked, stop_);
                   further.store(packets, numbers);
                 });
}

/// What the receivers of a cell may see.
struct SkyEvaluator::CellGeometry {
  CellGeometry(const PackageReader& package, const CellReceivers& cell, OverhangGeometry::WholeScene whole_scene)
      : far(package.far_horizon(cell.cell)),
        silhouettes(cell_silhouettes(package, cell.cell, far, bounding_box(cell.receivers))),
        overhangs(package, cell.cell, std::move(whole_scene)) {}
  FarHorizon far;
  CellSilhouettes silhouettes;
  OverhangGeometry overhangs;
};

PlacedScene SkyEvaluator::whole_city(Cell cell) const {
  const WholeCity& city = city_->city(package_, stop_);
  return {city.occluder(), city.scene_from_cell_m(cell)};
}

SkyEvaluator::CellGeometry SkyEvaluator::geometry_of(const CellReceivers& cell) const {
  // Of a small city, one scene is indexed for all cells; of a large one, what each cell needs
  OverhangGeometry::WholeScene whole_scene;
  if (package_.manifest().triangles <= most_triangles_indexed_whole) whole_scene = [this](Cell c) { return whole_city(c); };
  return {package_, cell, std::move(whole_scene)};
}

void SkyEvaluator::evaluate_by_horizons(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  require_far_map(cell.cell);
  CellGeometry geometry = geometry_of(cell);
  const auto scene_ready = Clock::now();
  draw_horizons(geometry, cell, answers, StoredAnswers::all);
  add_times(start, scene_ready);
}

SkyParts SkyEvaluator::parts_of_sky(const CellReceivers& cell, const HemisphereDirections& directions) const {
  FARLOD_EXPECTS(cell.receivers.size() == 1);
  SkyParts seen = parts_without_crowns(cell, directions);
  if (!package_.has_crowns()) return seen;
  const Receiver& receiver = cell.receivers.front();
  const Occluder near = near_scene(package_, cell.cell);
  const CrownOccluder crowns(canopy_around(package_, cell.cell, receiver.p_cell.z), settings_.further.canopy, stop_);
  mark_crowns(directions, receiver, {near, crowns}, stop_, seen);
  return seen;
}

SkyParts SkyEvaluator::parts_without_crowns(const CellReceivers& cell, const HemisphereDirections& directions) const {
  const Receiver& receiver = cell.receivers.front();
  const Occluder near = near_scene(package_, cell.cell);
  const EvaluationMethod method = method_for(cell.cell);
  if (method == EvaluationMethod::whole_city) {
    const WholeCity& city = city_->city(package_, stop_);
    const Point3f origin = city.scene_from_cell(receiver.p_cell, cell.cell);
    return parts_by_rays(
        directions, receiver, near,
        [&](const Point3f& d) {
          return city.occluder().blocks({origin, d, least_distance_m});
        },
        stop_);
  }
  if (method == EvaluationMethod::near_scene_and_box || method == EvaluationMethod::near_scene_alone) {
    const BoxFarMap far = method == EvaluationMethod::near_scene_and_box ? package_.box_far_map(cell.cell) : BoxFarMap();
    const auto is_hidden = [&](const Point3f& d) {
      return near.blocks({receiver.p_cell, d, least_distance_m}) || far.blocks(Point3d{d.x, d.y, d.z});
    };
    return parts_by_rays(directions, receiver, near, is_hidden, stop_);
  }
  CellGeometry geometry = geometry_of(cell);
  return parts_by_horizons(directions, receiver, geometry.far, geometry.silhouettes, geometry.overhangs, near, stop_);
}

void SkyEvaluator::evaluate_by_rays_against_horizons(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  CellGeometry geometry = geometry_of(cell);
  const auto scene_ready = Clock::now();
  count_rays(geometry, cell, answers);
  if (!further_.empty()) draw_horizons(geometry, cell, answers, StoredAnswers::further);
  add_times(start, scene_ready);
}

void SkyEvaluator::require_far_map(Cell cell) const {
  if (far_map_of(package_, cell) != FarMapOfCell::missing) return;
  throw PackageUnusable("The engine horizon needs a far map, and cell " + std::to_string(cell.i) + "," + std::to_string(cell.j) +
                        " has none, since far maps were made for a part of the city: add those that are missing (farlod-pack "
                        "--area), or use the engine auto.");
}

void SkyEvaluator::draw_horizons(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers,
                                 StoredAnswers stored) const {
  const AzimuthSampling& azimuths = further_.azimuths();
  const std::size_t rays_per_azimuth = std::max<std::size_t>(1, (settings_.rays + azimuths.size() / 2) / azimuths.size());
  const GapSettings gaps{static_cast<float>(azimuth_error(azimuths.size())), rays_per_azimuth, stop_};
  HorizonEngine engine(azimuths, settings_.weight, geometry.far, geometry.silhouettes, geometry.overhangs, gaps);
  if (settings_.max_far_error) engine.keep({*settings_.max_far_error, [&] { return whole_city(cell.cell); }});
  FurtherAnswers further(further_, cell, answers);
  if (!further_.empty()) further.listen_to(engine);
  if (further_.needs_near_sky()) further.draw_near_sky(package_, geometry.far, gaps);
  if (further_.canopy_columns().count > 0) further.draw_canopies(package_, certainty_of_canopies(cell.cell, answers), stop_);
  std::vector<PacketAnswer> of_packets;
  for_each_group(cell.receivers, packet_order(cell.receivers, stop_),
                 [&](std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers) {
                   throw_if_cancelled(stop_);
                   of_packets.resize(packets.size());
                   wants_bounds(answers) ? engine.evaluate_with_bounds(packets, of_packets)
                                         : engine.evaluate(packets, of_packets);
                   std::span<const std::uint32_t> left = numbers;
                   for (std::size_t n = 0; n < packets.size() && stored == StoredAnswers::all; ++n) {
                     store_packet(of_packets[n], cell, left.first(packets[n].count), answers);
                     left = left.subspan(packets[n].count);
                   }
                   if (!further_.empty())
                     further.store(packets, numbers, {of_packets, stored == StoredAnswers::all, settings_.max_far_error});
                 });
}

CanopyCertainty SkyEvaluator::certainty_of_canopies(Cell cell, const SkyAnswers& answers) const {
  const Quantities& wanted = settings_.further;
  CanopyCertainty certainty;
  if (!wanted.svf_total) return certainty;
  certainty.bounds = wanted.svf_total_bounds || settings_.max_far_error;
  certainty.max_error = settings_.max_far_error;
  certainty.trace = [this, cell, &answers](std::span<const Receiver> receivers) {
    count(answers, {0, receivers.size() * directions_.ray_count()});
    const PlacedScene scene = whole_city(cell);
    const CrownOccluder& crowns = city_->crowns(package_, settings_.further.canopy, stop_);
    return trace_svf_totals({scene.occluder, crowns}, scene.scene_from_cell_m, directions_, receivers, stop_);
  };
  return certainty;
}

void SkyEvaluator::store_packet(const PacketAnswer& packet, const CellReceivers& cell, std::span<const std::uint32_t> numbers,
                                const SkyAnswers& answers) const {
  if (packet.by_gap_rays != 0) require_rays_allowed(cell.cell);
  for (std::size_t l = 0; l < numbers.size(); ++l) store(packet.svf[l], cell.receivers[numbers[l]].index, answers);
  count(answers, {static_cast<std::uint64_t>(std::popcount(packet.by_rays)), packet.retraced_rays});
}

void SkyEvaluator::require_rays_allowed(Cell cell) const {
  if (method_for(cell) != EvaluationMethod::horizons_alone) return;
  throw PackageUnusable(
      "The engine horizon cannot tell how much sky is seen below bridges, balconies and projecting floors, and there is too "
      "much of it in sight of cell " +
      std::to_string(cell.i) + "," + std::to_string(cell.j) + ": use the engine auto.");
}

void SkyEvaluator::count_rays(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers) const {
  count(answers, {cell.receivers.size(), 0});
  const double most_open = settings_.max_far_error.value_or(1.0) * static_cast<double>(directions_.ray_count());
  const auto city = [&] { return whole_city(cell.cell); };
  std::vector<Receiver> receivers = cell.receivers;
  const auto by_normal = [](const Receiver& a, const Receiver& b) {
    return std::tie(a.normal.x, a.normal.y, a.normal.z) < std::tie(b.normal.x, b.normal.y, b.normal.z);
  };
  // Those of a raster all look up; to sort millions of them takes longer than a cancelled run may wait
  if (!std::is_sorted(receivers.begin(), receivers.end(), by_normal))
    std::stable_sort(receivers.begin(), receivers.end(), by_normal);
  for_each_normal(receivers, [&](std::span<const Receiver> group) {
    const std::vector<Point3d> directions = directions_.facing_as(group.front());
    if (directions.empty()) {
      for (const Receiver& r : group) store(SvfInterval{}, r.index, answers);
      return;
    }
    const DirectionSampling sampling(directions);
    RayEngine engine(sampling, geometry.far, geometry.silhouettes, geometry.overhangs, wants_bounds(answers), stop_);
    for (std::size_t first = 0; first < group.size(); first += ReceiverPacket::lanes) {
      throw_if_cancelled(stop_);
      const auto some = group.subspan(first, std::min(ReceiverPacket::lanes, group.size() - first));
      std::vector<FreeRays> free = engine.count(some);
      if (settings_.max_far_error) count(answers, {0, retrace_open_rays(most_open, some, engine, city, free)});
      for (std::size_t n = 0; n < some.size(); ++n) store(svf_of(free[n], directions_.ray_count()), some[n].index, answers);
    }
  });
}

EvaluationStatistics SkyEvaluator::statistics() const { return {{by_rays_, retraced_rays_}, scenes_s_, evaluate_s_}; }

}  // namespace farlod
