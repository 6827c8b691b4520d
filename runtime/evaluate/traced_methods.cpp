// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "evaluate/canopy_answers.hpp"
#include "evaluate/further_answers.hpp"
#include "evaluate/sky_method.hpp"
#include "evaluate/view_factors.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/exact_sky.hpp"
#include "horizon/receiver_packet.hpp"
#include "occlusion/crown_occluder.hpp"
#include "scene/canopy_around.hpp"
#include "scene/ray_scenes.hpp"

namespace farlod {
namespace {

/// What both methods share: rays against a scene.
class TracedMethod : public SkyMethod {
 public:
  explicit TracedMethod(const Evaluation& evaluation) : evaluation_(evaluation) {}

 protected:
  /// Everything but canopies.
  void trace(const CellReceivers& cell, const RayScene& scene, const SkyAnswers& answers) const {
    trace_svf(cell, scene, [&](const Receiver& r, float svf) { answers.store(r.index, {svf, svf, svf}); });
    if (!evaluation_.further.needs_profiles()) return;
    FurtherAnswers further(evaluation_.further, cell, answers);
    if (evaluation_.further.needs_near_sky()) further.set_near_sky(trace_near_sky(cell));
    if (evaluation_.further.needs_dimmed_sky() && evaluation_.package.has_crowns())
      further.draw_canopies(evaluation_.package, {}, nullptr, evaluation_.stop);
    for_each_group(cell.receivers, packet_order(cell.receivers, evaluation_.stop),
                   [&](std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers) {
                     further.trace(packets, scene, evaluation_.stop);
                     further.store(packets, numbers);
                   });
  }
  /// What is seen besides the sky, once svf is stored.
  void find_view_factors(const CellReceivers& cell, const SkyAnswers& answers) const {
    const Evaluation& e = evaluation_;
    if (!e.further.needs_view_factors()) return;
    ViewFactors(e.seen_from(cell.cell), e.directions, e.settings.weight, e.further, answers, e.stop).store(cell);
  }
  [[nodiscard]] bool wants_canopies() const { return evaluation_.further.canopy_columns().count > 0; }
  void trace_canopies(const CellReceivers& cell, const RayScene& scene, const CrownOccluder& crowns,
                      const SkyAnswers& answers) const {
    store_traced_canopies(cell, {scene.solid.occluder, crowns, scene.far}, scene.solid.scene_from_cell_m, evaluation_.directions,
                          evaluation_.further, answers, evaluation_.stop);
  }

  const Evaluation& evaluation_;

 private:
  /// Calls `store(receiver, svf)` for each receiver, in their order.
  template <class Store>
  void trace_svf(const CellReceivers& cell, const RayScene& scene, const Store& store) const {
    const auto ray_count = static_cast<double>(evaluation_.directions.ray_count());
    for_each_normal(cell.receivers, [&](std::span<const Receiver> group) {
      std::vector<Point3f> origins;
      for (const Receiver& r : group) origins.push_back(placed(r.p_cell, scene.solid.scene_from_cell_m));
      std::vector<Point3d> directions = evaluation_.directions.facing_as(group.front());
      // A box map is looked up by direction alone: what it blocks is blocked for the whole group, and needs no ray
      std::erase_if(directions, [&](const Point3d& d) { return scene.is_far_blocked(d); });
      const std::vector<std::uint32_t> free = count_free(scene.solid.occluder, origins, directions, evaluation_.stop);
      for (std::size_t n = 0; n < group.size(); ++n)
        store(group[n], static_cast<float>(static_cast<double>(free[n]) / ray_count));
    });
  }
  /// The sky above the near geometry alone, of each receiver.
  [[nodiscard]] std::vector<float> trace_near_sky(const CellReceivers& cell) const {
    const Occluder near = near_scene(evaluation_.package, cell.cell);
    std::vector<float> sky;
    trace_svf(cell, {{near, {}}}, [&](const Receiver&, float svf) { sky.push_back(svf); });
    return sky;
  }
};

/// More of them see fewer triangles each.
constexpr std::size_t wedges_of_exact_sky = 256;

class NearSceneMethod final : public TracedMethod {
 public:
  NearSceneMethod(const Evaluation& evaluation, bool has_box) : TracedMethod(evaluation), has_box_(has_box) {}

  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const override {
    const auto start = EvaluationCounter::Clock::now();
    const Occluder near = near_scene(evaluation_.package, cell.cell);
    const BoxFarMap far = far_map(cell.cell);
    const auto scene_ready = EvaluationCounter::Clock::now();
    const RayScene scene{{near, {}}, &far};
    trace(cell, scene, answers);
    find_view_factors(cell, answers);
    if (wants_canopies()) {
      const std::vector<Crown> crowns = canopy_around(evaluation_.package, cell.cell, bounding_box(cell.receivers).low.z);
      trace_canopies(cell, scene, CrownOccluder(crowns, evaluation_.settings.further.canopy, evaluation_.stop), answers);
    }
    evaluation_.counter->add_times(start, scene_ready);
  }

  [[nodiscard]] SkyParts parts(const CellReceivers& cell, const HemisphereDirections& directions,
                               const Occluder& near) const override {
    const BoxFarMap far = far_map(cell.cell);
    return parts_by_rays(directions, cell.receivers.front(), near, {{near, {}}, &far}, evaluation_.stop);
  }

 private:
  [[nodiscard]] BoxFarMap far_map(Cell cell) const { return has_box_ ? evaluation_.package.box_far_map(cell) : BoxFarMap(); }

  bool has_box_;
};

class WholeCityMethod final : public TracedMethod {
 public:
  using TracedMethod::TracedMethod;

  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const override {
    const auto start = EvaluationCounter::Clock::now();
    const RayScene scene{evaluation_.city->seen_from(cell.cell)};
    const auto scene_ready = EvaluationCounter::Clock::now();
    trace(cell, scene, answers);
    if (evaluation_.wants_bounds(answers)) store_exact_sky(cell, answers);
    find_view_factors(cell, answers);
    if (wants_canopies()) trace_canopies(cell, scene, evaluation_.city->crowns(evaluation_.settings.further.canopy), answers);
    evaluation_.counter->add_times(start, scene_ready);
  }

  [[nodiscard]] SkyParts parts(const CellReceivers& cell, const HemisphereDirections& directions,
                               const Occluder& near) const override {
    return parts_by_rays(directions, cell.receivers.front(), near, {evaluation_.city->seen_from(cell.cell)}, evaluation_.stop);
  }

 private:
  /// Rays of a sample know no bounds; the triangles that are seen tell the value itself.
  void store_exact_sky(const CellReceivers& cell, const SkyAnswers& answers) const {
    ExactSky sky(evaluation_.city->triangles(),
                 evaluation_.is_unbroken_relief() ? ExactSky::Triangles::of_unbroken_surface : ExactSky::Triangles::any);
    for (const Receiver& r : cell.receivers) {
      throw_if_cancelled(evaluation_.stop);
      const Point3d place = evaluation_.city->scene_from_cell(r.p_cell, cell.cell);
      const double share = sky.share_of_sky(wedges_of_exact_sky, place, r.normal, evaluation_.settings.weight);
      const auto svf = static_cast<float>(std::clamp(share, 0.0, 1.0));
      answers.store(r.index, {svf, svf, svf});
    }
  }
};

}  // namespace

std::unique_ptr<const SkyMethod> near_scene_method(const Evaluation& evaluation, bool has_box) {
  return std::make_unique<NearSceneMethod>(evaluation, has_box);
}

std::unique_ptr<const SkyMethod> whole_city_method(const Evaluation& evaluation) {
  return std::make_unique<WholeCityMethod>(evaluation);
}

}  // namespace farlod
