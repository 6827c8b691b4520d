// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "evaluate/error_budget.hpp"
#include "evaluate/further_answers.hpp"
#include "evaluate/light_of_little_sky.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/sky_method.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/horizon_engine.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/receiver_packet.hpp"
#include "package/package_folder.hpp"
#include "rays/ray_engine.hpp"

namespace farlod {
namespace {

/// An index of the whole city takes some 150 bytes a triangle: 45 MB.
constexpr std::uint64_t most_triangles_indexed_whole = 300'000;

std::string text_of(Cell cell) { return std::to_string(cell.i) + "," + std::to_string(cell.j); }

/// What the receivers of a cell may see.
struct CellGeometry {
  CellGeometry(const Evaluation& e, const CellReceivers& cell)
      : far(far_map_of(e.package, cell.cell) == FarMapOfCell::all_is_near ? without_far_map(e.package.grid())
                                                                          : e.package.far_horizon(cell.cell)),
        silhouettes(cell_silhouettes(
            e.package, cell.cell, far, bounding_box(cell.receivers),
            e.package.grid().cells.contains(cell.cell) ? std::span<const HorizonEdge>() : e.far_terrain_edges())),
        overhangs(e.package, cell.cell, is_small(e.package) ? e.city.get() : nullptr) {}
  CellGeometry(FarHorizon f, CellSilhouettes s, OverhangGeometry o)
      : far(std::move(f)), silhouettes(std::move(s)), overhangs(std::move(o)) {}
  FarHorizon far;
  CellSilhouettes silhouettes;
  OverhangGeometry overhangs;

  /// Nothing: horizons are those of pixels.
  static CellGeometry of_pixels(const Evaluation& e, Cell cell) {
    return {without_far_map(e.package.grid()), CellSilhouettes(), OverhangGeometry(e.package, cell)};
  }
  /// A far map with nothing in it.
  static FarHorizon without_far_map(const Grid& grid) {
    // No receiver lies below its only level, where bounds would be unknown: a slope may fall beyond the grid
    constexpr float below_all_m = -2e5F;
    const ReceiverPatches one_patch(grid.cell_edge_m, 1, {below_all_m});
    return {one_patch, AzimuthBins{1}, {0.0F}, {0.0F}, {0.0F}, {0.0F}, {}};
  }

  /// A small city is indexed once for all cells; of a large one, each cell indexes what it needs.
  static bool is_small(const PackageReader& package) { return package.manifest().triangles <= most_triangles_indexed_whole; }
};

/// What both methods share: horizons, and what is made of them.
class MethodWithHorizons : public SkyMethod {
 public:
  explicit MethodWithHorizons(const Evaluation& evaluation) : evaluation_(evaluation) {}

  [[nodiscard]] SkyParts parts(const CellReceivers& cell, const HemisphereDirections& directions,
                               const Occluder& near) const override {
    CellGeometry g(evaluation_, cell);
    return parts_by_horizons(directions, cell.receivers.front(), g.far, g.silhouettes, g.overhangs, near, evaluation_.stop);
  }

 protected:
  /// Draws horizons, and tells `on_packet(answer, numbers)` of each packet, whose receivers have these numbers in the cell: it
  /// stores svf. What is asked for besides is stored afterwards.
  template <class OnPacket>
  void draw(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers, const OnPacket& on_packet) const {
    const CanopyCity* const canopy = evaluation_.canopy_pixels(cell, answers);
    const std::stop_token& stop = evaluation_.stop;
    draw(geometry, nullptr,
         canopy == nullptr ? packet_order(cell.receivers, stop)
                           : order_on_pixels(canopy->lattice, evaluation_.package.grid(), cell.cell, cell.receivers, stop),
         cell, answers, on_packet);
  }
  /// The same for the packets of an order, whose horizons are those of pixels unless these are null.
  template <class OnPacket>
  void draw(CellGeometry& geometry, PixelHorizon* pixels, const PacketOrder& order, const CellReceivers& cell,
            const SkyAnswers& answers, const OnPacket& on_packet) const;

  void store(const PacketAnswer& packet, std::span<const std::uint32_t> numbers, const CellReceivers& cell,
             const SkyAnswers& answers) const {
    for (std::size_t l = 0; l < numbers.size(); ++l) answers.store(cell.receivers[numbers[l]].index, packet.svf[l]);
    evaluation_.counter->add({static_cast<std::uint64_t>(std::popcount(packet.by_rays)), packet.decided_wedges}, answers);
  }

  const Evaluation& evaluation_;

 private:
  [[nodiscard]] CanopyCertainty certainty_of_canopies() const {
    const Quantities& wanted = evaluation_.settings.further;
    CanopyCertainty certainty;
    if (!wanted.svf_total) return certainty;
    certainty.max_error = evaluation_.settings.allowed_error;
    certainty.bounds = wanted.svf_total_bounds || certainty.max_error;
    certainty.city = evaluation_.city.get();
    certainty.directions = &evaluation_.directions;
    return certainty;
  }
  void begin_further(FurtherAnswers& further, HorizonEngine& engine, Cell cell, const FarHorizon& far,
                     const CanopyCity* canopy) const {
    const FurtherQuantities& wanted = evaluation_.further;
    if (!wanted.empty()) further.listen_to(engine);
    if (wanted.needs_near_sky()) further.draw_near_sky(evaluation_.package, far);
    if (wanted.needs_view_factors())
      further.find_view_factors(evaluation_.seen_from(cell), evaluation_.directions, evaluation_.settings.weight,
                                evaluation_.stop);
    if (wanted.canopy_columns().count > 0 || (wanted.needs_dimmed_sky() && evaluation_.package.has_crowns()))
      further.draw_canopies(evaluation_.package, certainty_of_canopies(), canopy, evaluation_.stop);
  }
};

template <class OnPacket>
void MethodWithHorizons::draw(CellGeometry& geometry, PixelHorizon* pixels, const PacketOrder& order, const CellReceivers& cell,
                              const SkyAnswers& answers, const OnPacket& on_packet) const {
  const Evaluation& e = evaluation_;
  HorizonEngine engine(e.further.azimuths(), e.settings.weight, geometry.far, geometry.silhouettes, geometry.overhangs,
                       gap_tolerance(e.further.azimuths().size()));
  if (pixels != nullptr) engine.see(*pixels);
  // Where crowns are counted above the sky, half of the error is left to them
  const double share = e.settings.further.svf_total ? 0.5 : 1.0;
  if (e.settings.allowed_error) engine.keep({share * *e.settings.allowed_error, *e.city, cell.cell, e.stop});
  FurtherAnswers further(e.further, cell, answers);
  begin_further(further, engine, cell.cell, geometry.far, e.canopy_pixels(cell, answers));
  std::vector<PacketAnswer> of_packets;
  for_each_group(cell.receivers, order, [&](std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers) {
    throw_if_cancelled(e.stop);
    of_packets.resize(packets.size());
    e.wants_bounds(answers) ? engine.evaluate_with_bounds(packets, of_packets) : engine.evaluate(packets, of_packets);
    std::span<const std::uint32_t> left = numbers;
    for (std::size_t n = 0; n < packets.size(); ++n) {
      on_packet(of_packets[n], left.first(packets[n].count));
      left = left.subspan(packets[n].count);
    }
    if (!e.further.empty()) further.store(packets, numbers, of_packets);
  });
  e.counter->add({0, further.retraced_rays()}, answers);
}

class HorizonMethod final : public MethodWithHorizons {
 public:
  explicit HorizonMethod(const Evaluation& evaluation)
      : MethodWithHorizons(evaluation), light_of_little_sky_(LightOfLittleSky::of(evaluation)) {}

  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const override {
    const auto start = EvaluationCounter::Clock::now();
    require_far_map(cell.cell);
    CellGeometry geometry(evaluation_, cell);
    const auto scene_ready = EvaluationCounter::Clock::now();
    answer(geometry, cell, answers);
    if (light_of_little_sky_)
      light_of_little_sky_->improve(cell, answers, [&](const Evaluation& finer, const CellReceivers& some, const SkyAnswers& a) {
        HorizonMethod(finer).answer(geometry, some, a);
      });
    evaluation_.counter->add_times(start, scene_ready);
  }

 private:
  void answer(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers) const {
    draw(geometry, cell, answers,
         [&](const PacketAnswer& packet, std::span<const std::uint32_t> numbers) { store(packet, numbers, cell, answers); });
  }
  void require_far_map(Cell cell) const {
    if (far_map_of(evaluation_.package, cell) != FarMapOfCell::missing) return;
    throw PackageUnusable("The engine horizon needs a far map, and cell " + text_of(cell) +
                          " has none, since far maps were made for a part of the city: add those that are missing (farlod-pack "
                          "--area), or use the engine auto.");
  }

  std::unique_ptr<const LightOfLittleSky> light_of_little_sky_;  ///< null where no light is asked for
};

class PixelMethod final : public MethodWithHorizons {
 public:
  PixelMethod(const Evaluation& evaluation, std::unique_ptr<const SkyMethod> others)
      : MethodWithHorizons(evaluation), others_(std::move(others)) {}

  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const override {
    const PixelCity* const pixels = evaluation_.pixels(answers);
    if (pixels == nullptr) return others_->evaluate(cell, answers);
    const CellReceivers others = evaluate_by_pixels(*pixels, cell, answers);
    if (!others.receivers.empty()) others_->evaluate(others, answers);
  }
  [[nodiscard]] SkyParts parts(const CellReceivers& cell, const HemisphereDirections& directions,
                               const Occluder& near) const override {
    return others_->parts(cell, directions, near);
  }

 private:
  /// Answers the receivers above pixels, and returns the others.
  [[nodiscard]] CellReceivers evaluate_by_pixels(const PixelCity& city, const CellReceivers& cell,
                                                 const SkyAnswers& answers) const {
    const auto start = EvaluationCounter::Clock::now();
    PixelHorizon pixels(city, cell.cell,
                        evaluation_.further.needs_profiles() || evaluation_.further.needs_view_factors()
                            ? HorizonUse::each_azimuth
                            : HorizonUse::sum);
    const ReceiversOnPixels found = pixels.packets_of(cell.receivers);
    CellGeometry geometry = CellGeometry::of_pixels(evaluation_, cell.cell);
    draw(geometry, &pixels, found.on_pixels, cell, answers,
         [&](const PacketAnswer& packet, std::span<const std::uint32_t> numbers) { store(packet, numbers, cell, answers); });
    evaluation_.counter->add_times(start, start);
    CellReceivers others{cell.cell, {}};
    for (const std::uint32_t n : found.others) others.receivers.push_back(cell.receivers[n]);
    return others;
  }

  std::unique_ptr<const SkyMethod> others_;
};

class RayMethod final : public MethodWithHorizons {
 public:
  using MethodWithHorizons::MethodWithHorizons;

  void evaluate(const CellReceivers& cell, const SkyAnswers& answers) const override {
    const auto start = EvaluationCounter::Clock::now();
    CellGeometry geometry(evaluation_, cell);
    const auto scene_ready = EvaluationCounter::Clock::now();
    count_rays(geometry, cell, answers);
    // Rays of a sample know no bounds: those are of horizons, and answers keep within them
    const bool wants_bounds = evaluation_.wants_bounds(answers);
    if (wants_bounds || !evaluation_.further.empty())
      draw(geometry, cell, answers, [&](const PacketAnswer& packet, std::span<const std::uint32_t> numbers) {
        for (std::size_t l = 0; wants_bounds && l < numbers.size(); ++l)
          store_within(packet.svf[l], cell.receivers[numbers[l]].index, answers);
        evaluation_.counter->add({0, packet.decided_wedges}, answers);
      });
    evaluation_.counter->add_times(start, scene_ready);
  }

 private:
  void count_rays(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers) const;
  void count_packet(RayEngine& engine, std::span<const Receiver> receivers, const SkyAnswers& answers) const;
  void store_within(const SvfInterval& bounds, std::size_t index, const SkyAnswers& answers) const {
    const auto error = static_cast<float>(evaluation_.settings.allowed_error.value_or(1.0));
    answers.store(index, within_error({bounds.low, std::clamp(answers.svf[index], bounds.low, bounds.high), bounds.high}, error));
  }
};

void RayMethod::count_rays(CellGeometry& geometry, const CellReceivers& cell, const SkyAnswers& answers) const {
  evaluation_.counter->add({cell.receivers.size(), 0}, answers);
  std::vector<Receiver> receivers = cell.receivers;
  const auto by_normal = [](const Receiver& a, const Receiver& b) {
    return std::tie(a.normal.x, a.normal.y, a.normal.z) < std::tie(b.normal.x, b.normal.y, b.normal.z);
  };
  // Those of a raster all look up; to sort millions of them takes longer than a cancelled run may wait
  if (!std::is_sorted(receivers.begin(), receivers.end(), by_normal))
    std::stable_sort(receivers.begin(), receivers.end(), by_normal);
  for_each_normal(receivers, [&](std::span<const Receiver> group) {
    const std::vector<Point3d> directions = evaluation_.directions.facing_as(group.front());
    if (directions.empty()) {
      for (const Receiver& r : group) answers.store(r.index, SvfInterval{});
      return;
    }
    const DirectionSampling sampling(directions);
    RayEngine engine(sampling, geometry.far, geometry.silhouettes, geometry.overhangs, evaluation_.settings.bounds_of_same_rays,
                     evaluation_.stop);
    for (std::size_t first = 0; first < group.size(); first += ReceiverPacket::lanes)
      count_packet(engine, group.subspan(first, std::min(ReceiverPacket::lanes, group.size() - first)), answers);
  });
}

void RayMethod::count_packet(RayEngine& engine, std::span<const Receiver> receivers, const SkyAnswers& answers) const {
  throw_if_cancelled(evaluation_.stop);
  const std::vector<FreeRays> free = engine.count(receivers);
  const double ray_count = static_cast<double>(evaluation_.directions.ray_count());
  const auto part = [ray_count](std::uint32_t n) { return static_cast<float>(static_cast<double>(n) / ray_count); };
  for (std::size_t n = 0; n < receivers.size(); ++n)
    answers.store(receivers[n].index, {part(free[n].low), part(free[n].estimate), part(free[n].high)});
}

}  // namespace

std::unique_ptr<const SkyMethod> horizon_method(const Evaluation& evaluation) {
  return std::make_unique<HorizonMethod>(evaluation);
}

std::unique_ptr<const SkyMethod> pixel_method(const Evaluation& evaluation, std::unique_ptr<const SkyMethod> others) {
  return std::make_unique<PixelMethod>(evaluation, std::move(others));
}

std::unique_ptr<const SkyMethod> ray_method(const Evaluation& evaluation) { return std::make_unique<RayMethod>(evaluation); }

}  // namespace farlod
