// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_evaluator.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "evaluate/error_budget.hpp"
#include "evaluate/visibility.hpp"
#include "farlod/expects.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/horizon_engine.hpp"
#include "horizon/overhang_geometry.hpp"
#include "horizon/ray_engine.hpp"
#include "horizon/receiver_packets.hpp"
#include "package/package_error.hpp"
#include "scene/near_scene.hpp"
#include "scene/whole_city.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

/// An index of the whole city takes some 150 bytes a triangle: 45 MB.
constexpr std::uint64_t most_triangles_indexed_whole = 300'000;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

/// Calls `visit` for each run of receivers that look the same way: they share their directions.
template <class Visit>
void for_each_run(std::span<const Receiver> receivers, const Visit& visit) {
  for (std::size_t first = 0; first < receivers.size();) {
    std::size_t end = first + 1;
    while (end < receivers.size() && receivers[end].normal == receivers[first].normal) ++end;
    visit(receivers.subspan(first, end - first));
    first = end;
  }
}

std::vector<Point3d> directions_of(const SkyDirections& all, const Point3f& normal) {
  if (normal == Point3f{0.0F, 0.0F, 1.0F}) return {all.horizontal().begin(), all.horizontal().end()};
  return all.around(normalized(Point3d{normal.x, normal.y, normal.z}));
}

std::vector<Point3f> places_of(std::span<const Receiver> receivers) {
  std::vector<Point3f> places;
  for (const Receiver& r : receivers) places.push_back(r.p_cell);
  return places;
}

SvfInterval shares_of(const FreeRays& free, std::size_t ray_count) {
  const auto share = [ray_count](std::uint32_t n) {
    return static_cast<float>(static_cast<double>(n) / static_cast<double>(ray_count));
  };
  return {share(free.low), share(free.estimate), share(free.high)};
}

void answer(const SkyAnswers& answers, std::size_t index, const SvfInterval& share) {
  answers.svf[index] = share.estimate;
  if (answers.low.empty()) return;
  answers.low[index] = share.low;
  answers.high[index] = share.high;
}

}  // namespace

double sampling_error_of(const SkySettings& settings) {
  const double of_rays = settings.engine == Engine::horizon ? 0.0 : sampling_error(settings.rays);
  const bool has_horizons = settings.engine == Engine::horizon || settings.engine == Engine::automatic;
  return std::max(of_rays, has_horizons ? azimuth_error(settings.azimuths) : 0.0);
}

struct SkyEvaluator::WholeCityOnDemand {
  std::once_flag once;
  std::optional<WholeCity> city;

  const WholeCity& get(const Package& package) {
    std::call_once(once, [&] { city.emplace(package); });
    return *city;
  }
};

SkyEvaluator::SkyEvaluator(const Package& package, const SkySettings& settings)
    : package_(package),
      settings_(settings),
      directions_(settings.weight, settings.rays, package.grid().rotation, settings.directions),
      ring_(AzimuthRing::even(settings.azimuths, package.grid().rotation)),
      city_(std::make_unique<WholeCityOnDemand>()) {
  FARLOD_EXPECTS(!settings.max_far_error || settings.engine == Engine::exact || settings.engine == Engine::near_only ||
                 !package.manifest().far_map.is_box());
}
SkyEvaluator::~SkyEvaluator() = default;

void SkyEvaluator::evaluate(const CellReceivers& cell, const SkyAnswers& answers) const {
  if (cell.receivers.empty()) return;
  if (settings_.engine == Engine::exact || !package_.grid().cells.contains(cell.cell)) return evaluate_exactly(cell, answers);
  if (settings_.engine == Engine::near_only || package_.manifest().far_map.is_box()) return evaluate_with_box(cell, answers);
  evaluate_with_horizon(cell, answers);
}

void SkyEvaluator::evaluate_exactly(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  const WholeCity& city = city_->get(package_);
  const auto scene_ready = Clock::now();
  for_each_run(cell.receivers, [&](std::span<const Receiver> run) {
    std::vector<Point3f> origins;
    for (const Receiver& r : run) origins.push_back(city.scene_from_cell(r.p_cell, cell.cell));
    const auto free = count_free(city.occluder(), origins, directions_of(directions_, run.front().normal));
    for (std::size_t n = 0; n < run.size(); ++n)
      answer(answers, run[n].index, shares_of({free[n], free[n], free[n]}, directions_.ray_count()));
  });
  scenes_s_ += seconds_between(start, scene_ready);
  evaluate_s_ += seconds_between(scene_ready, Clock::now());
}

void SkyEvaluator::evaluate_with_box(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  const Occluder near = near_scene(package_, cell.cell);
  const BoxFarMap far = settings_.engine == Engine::near_only ? BoxFarMap() : package_.box_far_map(cell.cell);
  const auto scene_ready = Clock::now();
  for_each_run(cell.receivers, [&](std::span<const Receiver> run) {
    std::vector<Point3d> directions = directions_of(directions_, run.front().normal);
    // What the far city hides needs no ray: the map is looked up by direction alone, hence alike for the whole run
    std::erase_if(directions, [&far](const Point3d& d) { return far.blocks(d); });
    const std::vector<std::uint32_t> free = count_free(near, places_of(run), directions);
    for (std::size_t n = 0; n < run.size(); ++n)
      answer(answers, run[n].index, shares_of({free[n], free[n], free[n]}, directions_.ray_count()));
  });
  scenes_s_ += seconds_between(start, scene_ready);
  evaluate_s_ += seconds_between(scene_ready, Clock::now());
}

/// What the receivers of a cell may see.
struct SkyEvaluator::CellSight {
  CellSight(const Package& package, const CellReceivers& cell, OverhangGeometry::WholeScene whole_scene)
      : far(package.far_horizon(cell.cell)),
        silhouettes(cell_silhouettes(package, cell.cell, far, bounding_box(cell.receivers))),
        overhangs(package, cell.cell, std::move(whole_scene)) {}
  FarHorizon far;
  CellSilhouettes silhouettes;
  OverhangGeometry overhangs;
};

void SkyEvaluator::evaluate_with_horizon(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  // A small city is indexed once; of a large one, what a cell needs
  OverhangGeometry::WholeScene whole_scene;
  if (package_.manifest().triangles <= most_triangles_indexed_whole)
    whole_scene = [this](Cell c) {
      const WholeCity& city = city_->get(package_);
      return PlacedScene{city.occluder(), city.scene_from_cell_m(c)};
    };
  CellSight sight(package_, cell, std::move(whole_scene));
  const auto scene_ready = Clock::now();
  Numbers by_rays;
  if (settings_.engine == Engine::rays) {
    by_rays.resize(cell.receivers.size());
    std::iota(by_rays.begin(), by_rays.end(), 0U);
  } else {
    by_rays = answer_by_horizons(sight, cell, answers);
  }
  if (!by_rays.empty()) answer_by_rays(sight, cell, by_rays, answers);
  scenes_s_ += seconds_between(start, scene_ready);
  evaluate_s_ += seconds_between(scene_ready, Clock::now());
}

/// Returns the numbers of those that horizons are not enough for.
SkyEvaluator::Numbers SkyEvaluator::answer_by_horizons(CellSight& sight, const CellReceivers& cell,
                                                       const SkyAnswers& answers) const {
  const std::size_t rays_per_azimuth = std::max<std::size_t>(1, (settings_.rays + settings_.azimuths / 2) / settings_.azimuths);
  HorizonEngine engine(ring_, settings_.weight, sight.far, sight.silhouettes, sight.overhangs,
                       {static_cast<float>(azimuth_error(settings_.azimuths)), rays_per_azimuth});
  Numbers by_rays;
  const auto answer_packet = [&](const ReceiverPacket& packet, std::span<const std::uint32_t> numbers) {
    std::array<SvfInterval, ReceiverPacket::lanes> room;
    const std::span shares = std::span(room).first(numbers.size());
    const bool bounds = wants_bounds(answers);
    const std::uint32_t traced = bounds ? engine.evaluate_with_bounds(packet, shares) : engine.evaluate(packet, shares);
    if (traced != 0) require_rays_allowed(cell.cell);
    for (std::size_t l = 0; l < numbers.size(); ++l) {
      answer(answers, cell.receivers[numbers[l]].index, shares[l]);
      if (is_doubtful(shares[l])) {
        by_rays.push_back(numbers[l]);
      } else {
        by_rays_ += (traced >> l) & 1U;
      }
    }
  };
  for_each_packet(cell.receivers, packet_order(cell.receivers), answer_packet);
  return by_rays;
}

/// Whether the far map leaves an answer more uncertain than the user wants.
bool SkyEvaluator::is_doubtful(const SvfInterval& s) const {
  return settings_.max_far_error && std::max(s.high - s.estimate, s.estimate - s.low) > *settings_.max_far_error;
}

void SkyEvaluator::require_rays_allowed(Cell cell) const {
  if (settings_.engine != Engine::horizon) return;
  throw PackageUnusable(
      "The engine horizon cannot tell how much sky is seen below bridges, balconies and projecting floors, and there is too "
      "much of it in sight of cell " +
      std::to_string(cell.i) + "," + std::to_string(cell.j) + ": use --engine auto.");
}

void SkyEvaluator::answer_by_rays(CellSight& sight, const CellReceivers& cell, const Numbers& numbers,
                                  const SkyAnswers& answers) const {
  by_rays_ += numbers.size();
  std::vector<Receiver> receivers;
  for (const std::uint32_t n : numbers) receivers.push_back(cell.receivers[n]);
  std::stable_sort(receivers.begin(), receivers.end(), [](const Receiver& a, const Receiver& b) {
    return std::tie(a.normal.x, a.normal.y, a.normal.z) < std::tie(b.normal.x, b.normal.y, b.normal.z);
  });
  for_each_run(receivers, [&](std::span<const Receiver> run) {
    const std::vector<Point3d> directions = directions_of(directions_, run.front().normal);
    if (directions.empty()) {
      for (const Receiver& r : run) answer(answers, r.index, SvfInterval{});
      return;
    }
    const RayFan fan(directions);
    RayEngine engine(fan, sight.far, sight.silhouettes, sight.overhangs, wants_bounds(answers));
    for (std::size_t first = 0; first < run.size(); first += ReceiverPacket::lanes) {
      const auto some = run.subspan(first, std::min(ReceiverPacket::lanes, run.size() - first));
      std::vector<FreeRays> free = engine.count(some);
      if (settings_.max_far_error) retrace(cell.cell, some, engine, free);
      for (std::size_t n = 0; n < some.size(); ++n) answer(answers, some[n].index, shares_of(free[n], directions_.ray_count()));
    }
  });
}

void SkyEvaluator::retrace(Cell cell, std::span<const Receiver> receivers, const RayEngine& engine,
                          std::span<FreeRays> free) const {
  const double most = *settings_.max_far_error * static_cast<double>(directions_.ray_count());
  std::uint32_t doubtful = 0;
  for (std::size_t l = 0; l < free.size(); ++l)
    if (std::max(free[l].high - free[l].estimate, free[l].estimate - free[l].low) > most) doubtful |= 1U << l;
  if (doubtful == 0) return;
  const WholeCity& city = city_->get(package_);
  RayOrigins origins;
  for (std::size_t l = 0; l < receivers.size(); ++l) {
    const Point3f p = city.scene_from_cell(receivers[l].p_cell, cell);
    origins.x[l] = p.x;
    origins.y[l] = p.y;
    origins.z[l] = p.z;
  }
  retraced_rays_ += engine.retrace(city.occluder(), origins, doubtful, free);
}

SkyEvaluator::Effort SkyEvaluator::effort() const { return {scenes_s_, evaluate_s_, by_rays_, retraced_rays_}; }

}  // namespace farlod
