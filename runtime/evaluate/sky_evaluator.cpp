// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_evaluator.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <vector>

#include "evaluate/horizon_packets.hpp"
#include "evaluate/visibility.hpp"
#include "farlod/expects.hpp"
#include "scene/near_scene.hpp"
#include "scene/whole_city.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

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

void answer(const SkyAnswers& answers, std::size_t index, const FreeRays& free, std::size_t ray_count) {
  const auto share = [ray_count](std::uint32_t n) {
    return static_cast<float>(static_cast<double>(n) / static_cast<double>(ray_count));
  };
  answers.svf[index] = share(free.likely);
  if (answers.low.empty()) return;
  answers.low[index] = share(free.low);
  answers.high[index] = share(free.high);
}

}  // namespace

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
      directions_(settings.weight, settings.rays, package.grid().rotation),
      city_(std::make_unique<WholeCityOnDemand>()) {
  FARLOD_EXPECTS(!settings.max_far_error || settings.engine != Engine::rays || !package.manifest().far_map.is_box());
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
      answer(answers, run[n].index, {free[n], free[n], free[n]}, directions_.ray_count());
  });
  scenes_s_ += seconds_between(start, scene_ready);
  rays_s_ += seconds_between(scene_ready, Clock::now());
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
      answer(answers, run[n].index, {free[n], free[n], free[n]}, directions_.ray_count());
  });
  scenes_s_ += seconds_between(start, scene_ready);
  rays_s_ += seconds_between(scene_ready, Clock::now());
}

void SkyEvaluator::evaluate_with_horizon(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = Clock::now();
  const FarHorizon far = package_.far_horizon(cell.cell);
  const Occluder near = near_scene(package_, cell.cell, far.named);
  const auto scene_ready = Clock::now();
  const bool wants_bounds = !answers.low.empty() || settings_.max_far_error.has_value();
  for_each_run(cell.receivers, [&](std::span<const Receiver> run) {
    HorizonPackets packets(far, near, directions_of(directions_, run.front().normal), wants_bounds);
    for (std::size_t first = 0; first < run.size(); first += origins_per_packet) {
      const auto some = run.subspan(first, std::min(origins_per_packet, run.size() - first));
      std::vector<FreeRays> free = packets.count(places_of(some));
      if (settings_.max_far_error) settle(cell.cell, some, packets, free);
      for (std::size_t n = 0; n < some.size(); ++n) answer(answers, some[n].index, free[n], directions_.ray_count());
    }
  });
  scenes_s_ += seconds_between(start, scene_ready);
  rays_s_ += seconds_between(scene_ready, Clock::now());
}

void SkyEvaluator::settle(Cell cell, std::span<const Receiver> receivers, HorizonPackets& packets,
                          std::vector<FreeRays>& free) const {
  const double most = *settings_.max_far_error * static_cast<double>(directions_.ray_count());
  std::vector<bool> doubtful;
  for (const FreeRays& f : free) doubtful.push_back(std::max(f.high - f.likely, f.likely - f.low) > most);
  if (std::none_of(doubtful.begin(), doubtful.end(), [](bool b) { return b; })) return;
  const WholeCity& city = city_->get(package_);
  std::vector<Point3f> origins;
  for (const Receiver& r : receivers) origins.push_back(city.scene_from_cell(r.p_cell, cell));
  settled_rays_ += packets.settle(city.occluder(), origins, doubtful, free);
}

SkyEvaluator::Effort SkyEvaluator::effort() const { return {scenes_s_, rays_s_, settled_rays_}; }

}  // namespace farlod
