// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sky_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "evaluate/building_view.hpp"
#include "evaluate/error_budget.hpp"
#include "evaluate/sky_method.hpp"
#include "evaluate/traced_patches.hpp"
#include "evaluate/view_factors.hpp"
#include "evaluate/views_around.hpp"
#include "horizon/far_terrain_edges.hpp"
#include "package/pixel_heights.hpp"
#include "scene/canopy_around.hpp"
#include "scene/ray_scenes.hpp"

namespace farlod {

FarMapOfCell far_map_outside_of_grid(const PackageReader& package) {
  // Each cell collects all edges of the city there, and those of the far terrain: some hundredths of a second. Pixels have none
  constexpr std::uint64_t most_triangles = 1'000'000;
  const package::Manifest& m = package.manifest();
  const bool is_drawn = m.triangles <= most_triangles && !m.far_map.is_box() && !m.heights();
  return is_drawn ? FarMapOfCell::all_is_near : FarMapOfCell::outside_of_grid;
}

FarMapOfCell far_map_of(const PackageReader& package, Cell cell) {
  if (!package.grid().cells.contains(cell)) return far_map_outside_of_grid(package);
  if (!package.has_far_map(cell))
    return package::has_rough_surface(package.manifest()) ? FarMapOfCell::needless : FarMapOfCell::missing;
  return package.manifest().far_map.is_box() ? FarMapOfCell::box : FarMapOfCell::horizon;
}

EvaluationMethod method_of(Engine engine, FarMapOfCell far_map) {
  using enum EvaluationMethod;
  if (far_map == FarMapOfCell::all_is_near && (engine == Engine::automatic || engine == Engine::horizon)) return horizons;
  if (far_map == FarMapOfCell::outside_of_grid || far_map == FarMapOfCell::all_is_near || engine == Engine::exact)
    return whole_city;
  if (engine == Engine::near_only) return near_scene_alone;
  if (far_map == FarMapOfCell::missing) return engine == Engine::horizon ? horizons : whole_city;
  if (far_map == FarMapOfCell::needless) return engine == Engine::rays ? whole_city : pixels_and_whole_city;
  if (far_map == FarMapOfCell::box) return near_scene_and_box;
  return engine == Engine::rays ? rays_against_horizons : horizons;
}

double sampling_error_of(const SkySettings& settings, FarMapOfCell far_map) {
  const EvaluationMethod method = method_of(settings.engine, far_map);
  const bool has_horizons = method == EvaluationMethod::horizons || method == EvaluationMethod::pixels_and_whole_city;
  const bool has_rays = method != EvaluationMethod::horizons;
  // Bounds keep an allowed error, whatever lies between the samples; but crowns are seen at the samples alone
  if (settings.allowed_error && !settings.further.svf_total) return 0.0;
  return std::max(has_rays ? sampling_error(settings.rays) : 0.0, has_horizons ? azimuth_error(settings.azimuths) : 0.0);
}

void EvaluationCounter::add(const RayCounts& counts, const SkyAnswers& answers) {
  by_rays_ += counts.by_rays;
  retraced_rays_ += counts.retraced_rays;
  if (answers.counts == nullptr) return;
  answers.counts->by_rays += counts.by_rays;
  answers.counts->retraced_rays += counts.retraced_rays;
}

void EvaluationCounter::add_times(Clock::time_point start, Clock::time_point scene_ready) {
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  scenes_s_ += seconds(scene_ready - start);
  evaluate_s_ += seconds(Clock::now() - scene_ready);
}

Evaluation::Evaluation(const PackageReader& p, const SkySettings& s, std::stop_token t, City c,
                       std::shared_ptr<const LightOfPeriod> light)
    : package(p),
      settings(s),
      stop(std::move(t)),
      directions(s.weight, s.rays, p.grid().rotation, s.directions, stop),
      further(s.further, s.azimuths, p.manifest(), std::move(light)),
      city(std::move(c)) {
  FARLOD_EXPECTS(!s.allowed_error || s.engine == Engine::exact || s.engine == Engine::near_only ||
                 !p.manifest().far_map.is_box());
  if (!further.needs_crowns() || s.further.canopy.rule != CanopyRule::once || !p.has_crowns()) return;
  const package::CrownCellRecord& first = p.crowns().cells().front();
  canopy_lattice_ = CanopyLattice::of(p.grid(), {first.i, first.j}, p.crowns().crowns_of(first).front());
}

const CanopyCity* Evaluation::canopy_pixels(const CellReceivers& cell, const SkyAnswers& answers) const {
  if (wants_bounds(answers) || !canopy_lattice_) return nullptr;
  const auto is_at_centre = [&](const Receiver& r) {
    return canopy_lattice_->centre_at(package.grid(), cell.cell, r.p_cell).has_value();
  };
  if (std::ranges::none_of(cell.receivers, is_at_centre)) return nullptr;
  std::call_once(canopy_->once, [this] { make_canopy_city(); });
  return canopy_->city ? &*canopy_->city : nullptr;
}

void Evaluation::make_canopy_city() const {
  std::vector<CellCrowns> crowns;
  for (const package::CrownCellRecord& record : package.crowns().cells())
    crowns.push_back({{record.i, record.j}, package.crowns().crowns_of(record)});
  const Quantities& q = settings.further;
  const bool wants_solids = q.svfaveg || q.directional_vegetation || q.sky_shares;
  const PixelHeightsFile* const heights = wants_solids ? package.pixel_heights() : nullptr;
  std::optional<CanopyField> field =
      CanopyField::of(*canopy_lattice_, package.manifest(), crowns,
                      heights == nullptr ? SolidPixels() : SolidPixels{heights->height_m(), heights->joined()});
  package.crowns().let_go();
  if (heights != nullptr) heights->let_go();
  if (field) canopy_->city.emplace(package.manifest(), *canopy_lattice_, std::move(*field), further.azimuths());
}

const PixelCity* Evaluation::pixels(const SkyAnswers& answers) const {
  if (wants_bounds(answers) || further.needs_near_sky() || !package::has_rough_surface(package.manifest())) return nullptr;
  std::call_once(pixels_->once, [this] {
    const PixelHeightsFile* const file = package.pixel_heights();
    // A package in memory has none
    if (file == nullptr) return;
    pixels_->city.emplace(package.manifest(), file->height_m(), file->joined(), further.azimuths());
    file->let_go();
  });
  return pixels_->city ? &*pixels_->city : nullptr;
}

SeenScene Evaluation::seen_from(Cell cell) const {
  return {city->seen_from(cell), city->surfaces(), package.has_crowns() ? &city->crowns(settings.further.canopy) : nullptr};
}

std::span<const HorizonEdge> Evaluation::far_terrain_edges() const {
  std::call_once(far_terrain_->once, [this] { far_terrain_->edges = horizon_edges_of(package.far_terrain()); });
  return far_terrain_->edges;
}

bool Evaluation::is_unbroken_relief() const {
  const PixelHeightsFile* const file = package::has_rough_surface(package.manifest()) ? package.pixel_heights() : nullptr;
  return file != nullptr && std::ranges::none_of(file->height_m(), [](float height_m) { return std::isnan(height_m); });
}

SkyEvaluator::SkyEvaluator(const PackageReader& package, const SkySettings& settings, const std::stop_token& stop)
    : SkyEvaluator(
          std::make_unique<Evaluation>(package, settings, stop, std::make_shared<const WholeCityOnDemand>(package, stop))) {}

SkyEvaluator::SkyEvaluator(const SkyEvaluator& other, const SkySettings& settings)
    : SkyEvaluator(std::make_unique<Evaluation>(other.package(), settings, other.evaluation_->stop, other.evaluation_->city)) {}

SkyEvaluator::SkyEvaluator(std::unique_ptr<const Evaluation> evaluation) : evaluation_(std::move(evaluation)) {
  using enum EvaluationMethod;
  const auto method = [this](EvaluationMethod m) -> auto& { return methods_[static_cast<std::size_t>(m)]; };
  method(horizons) = pixel_method(*evaluation_, horizon_method(*evaluation_));
  method(rays_against_horizons) = ray_method(*evaluation_);
  method(near_scene_and_box) = near_scene_method(*evaluation_, true);
  method(near_scene_alone) = near_scene_method(*evaluation_, false);
  method(whole_city) = whole_city_method(*evaluation_);
  method(pixels_and_whole_city) = pixel_method(*evaluation_, whole_city_method(*evaluation_));
  const Quantities& further = settings().further;
  if (further.view_cube || further.view_sphere) around_ = std::make_unique<const ViewsAround>(*this);
  if (further.view_eye) eye_directions_ = eye_directions(further.eye_field_deg, settings().rays, this->package().grid().rotation);
}

SkyEvaluator::~SkyEvaluator() = default;

EvaluationStatistics SkyEvaluator::statistics() const { return evaluation_->counter->statistics(); }
const PackageReader& SkyEvaluator::package() const { return evaluation_->package; }
const SkySettings& SkyEvaluator::settings() const { return evaluation_->settings; }
std::size_t SkyEvaluator::further_columns() const { return evaluation_->further.size(); }

const SkyMethod& SkyEvaluator::method_for(Cell cell) const {
  return *methods_[static_cast<std::size_t>(method_of(settings().engine, far_map_of(package(), cell)))];
}

void SkyEvaluator::evaluate(const CellReceivers& cell, const SkyAnswers& answers) const {
  if (cell.receivers.empty()) return;
  throw_if_cancelled(evaluation_->stop);
  method_for(cell.cell).evaluate(cell, answers);
  const Quantities& further = settings().further;
  if (further.horizon_distances) find_horizon_distances(cell, answers);
  if (further.shadow_patches) find_shadow_patches(cell, answers);
  if (further.any_of_places()) find_views(cell, answers);
  if (further.seen_building) find_building(cell, answers);
}

void SkyEvaluator::find_horizon_distances(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = EvaluationCounter::Clock::now();
  const WholeCity& city = evaluation_->city->city();
  const auto scene_ready = EvaluationCounter::Clock::now();
  const HorizonColumns wanted = evaluation_->further.horizon_columns();
  const std::size_t columns = further_columns();
  for (const Receiver& r : cell.receivers) {
    throw_if_cancelled(evaluation_->stop);
    trace_horizon_distances(city.occluder(), city.scene_from_cell(r.p_cell, cell.cell), wanted,
                            answers.further.subspan(r.index * columns, columns));
  }
  evaluation_->counter->add_times(start, scene_ready);
}

void SkyEvaluator::find_shadow_patches(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = EvaluationCounter::Clock::now();
  const WholeCityOnDemand& city = *evaluation_->city;
  PatchScene scene{city.seen_from(cell.cell)};
  if (package().has_crowns()) scene.crowns = &city.crowns(settings().further.canopy);
  const auto scene_ready = EvaluationCounter::Clock::now();
  store_shadow_patches(cell, scene, patch_directions(package().manifest()), evaluation_->further.shadow_columns(),
                       further_columns(), answers, evaluation_->stop);
  evaluation_->counter->add_times(start, scene_ready);
}

void SkyEvaluator::find_views(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = EvaluationCounter::Clock::now();
  const Evaluation& e = *evaluation_;
  const SeenScene scene = e.seen_from(cell.cell);
  const auto scene_ready = EvaluationCounter::Clock::now();
  if (around_) around_->store(cell, e.further, answers);
  if (settings().further.view_eye) store_views_of_eye(cell, scene, eye_directions_, e.further, answers, e.stop);
  e.counter->add_times(start, scene_ready);
}

void SkyEvaluator::find_building(const CellReceivers& cell, const SkyAnswers& answers) const {
  const auto start = EvaluationCounter::Clock::now();
  const Evaluation& e = *evaluation_;
  const SkySettings& s = e.settings;
  BuildingScene scene{e.city->seen_from(cell.cell), e.city->building(*s.further.seen_building)};
  if (package().has_crowns()) scene.crowns = &e.city->crowns(s.further.canopy);
  const auto scene_ready = EvaluationCounter::Clock::now();
  store_building_views(cell, scene, {s.rays, s.weight, s.on_surfaces}, e.further, answers, e.stop);
  e.counter->add_times(start, scene_ready);
}

SkyParts SkyEvaluator::parts_of_sky(const CellReceivers& cell, const HemisphereDirections& directions) const {
  FARLOD_EXPECTS(cell.receivers.size() == 1);
  const Receiver& receiver = cell.receivers.front();
  const Occluder near = near_scene(package(), cell.cell);
  SkyParts seen = method_for(cell.cell).parts(cell, directions, near);
  if (!package().has_crowns()) return seen;
  const CrownOccluder crowns(canopy_around(package(), cell.cell, receiver.p_cell.z), settings().further.canopy,
                             evaluation_->stop);
  mark_crowns(directions, receiver, {near, crowns}, evaluation_->stop, seen);
  return seen;
}

}  // namespace farlod
