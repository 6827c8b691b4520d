// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_evaluator.hpp"

#include <chrono>
#include <mutex>
#include <optional>
#include <vector>

#include "evaluate/visibility.hpp"
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

void keep_open(std::vector<Point3d>& directions, const FarMap& far) {
  std::erase_if(directions, [&far](const Point3d& d) { return far.blocks(d); });
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
      city_(std::make_unique<WholeCityOnDemand>()) {}
SkyEvaluator::~SkyEvaluator() = default;

void SkyEvaluator::evaluate(const CellReceivers& cell, std::span<float> svf) const {
  if (cell.receivers.empty()) return;
  const auto start = Clock::now();
  const bool exact = settings_.engine == Engine::exact || !package_.grid().cells.contains(cell.cell);
  const WholeCity* city = exact ? &city_->get(package_) : nullptr;
  const std::optional<Occluder> near = exact ? std::nullopt : std::optional(near_scene(package_, cell.cell));
  const FarMap far = settings_.engine == Engine::rays && !exact ? package_.far_map(cell.cell) : FarMap();
  const auto scene_ready = Clock::now();
  for_each_run(cell.receivers, [&](std::span<const Receiver> run) {
    std::vector<Point3d> directions = directions_of(directions_, run.front().normal);
    // What the far city hides needs no ray: the map is looked up by direction alone, hence alike for the whole run
    keep_open(directions, far);
    std::vector<Point3f> origins;
    for (const Receiver& r : run) origins.push_back(exact ? city->scene_from_cell(r.p_cell, cell.cell) : r.p_cell);
    const std::vector<std::uint32_t> free = count_free(exact ? city->occluder() : *near, origins, directions);
    for (std::size_t n = 0; n < run.size(); ++n)
      svf[run[n].index] = static_cast<float>(static_cast<double>(free[n]) / static_cast<double>(directions_.ray_count()));
  });
  scenes_s_ += seconds_between(start, scene_ready);
  rays_s_ += seconds_between(scene_ready, Clock::now());
}

SkyEvaluator::Effort SkyEvaluator::effort() const { return {scenes_s_, rays_s_}; }

}  // namespace farlod
