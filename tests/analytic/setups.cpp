// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/analytic/setups.hpp"

#include <algorithm>
#include <array>

namespace farlod::analytic {
namespace {

/// The pairs of values that occur so far.
class SeenPairs {
 public:
  SeenPairs(std::size_t parameters, std::size_t values)
      : parameters_(parameters), values_(values), seen_(parameters * values * parameters * values) {}

  void add(const Row& row) {
    for (const std::size_t pair : pairs_of(row)) seen_[pair] = true;
  }
  [[nodiscard]] std::ptrdiff_t new_pairs(const Row& row) const {
    return std::ranges::count_if(pairs_of(row), [this](std::size_t pair) { return !seen_[pair]; });
  }

 private:
  [[nodiscard]] std::vector<std::size_t> pairs_of(const Row& row) const {
    std::vector<std::size_t> pairs;
    for (std::size_t a = 0; a < parameters_; ++a)
      for (std::size_t b = a + 1; b < parameters_; ++b)
        pairs.push_back(((a * values_ + row[a]) * parameters_ + b) * values_ + row[b]);
    return pairs;
  }

  std::size_t parameters_, values_;
  std::vector<bool> seen_;
};

}  // namespace

std::vector<Row> with_all_pairs(std::vector<Row> first, std::vector<Row> possible) {
  std::size_t values = 0;
  for (const std::vector<Row>* rows : {&first, &possible})
    for (const Row& row : *rows) values = std::max(values, *std::ranges::max_element(row) + 1);
  SeenPairs seen(possible.empty() ? 0 : possible.front().size(), values);
  for (const Row& row : first) seen.add(row);
  while (true) {
    std::erase_if(possible, [&](const Row& row) { return seen.new_pairs(row) == 0; });
    if (possible.empty()) return first;
    first.push_back(*std::ranges::max_element(possible, {}, [&](const Row& row) { return seen.new_pairs(row); }));
    seen.add(first.back());
  }
}

namespace {

constexpr std::array shares{Share::all_near, Share::all_far, Share::split};
constexpr std::array kinds{FarMapKind::horizon, FarMapKind::box};
constexpr std::array wall_kinds{Walls::sheets, Walls::houses};
/// Along the axes, along no axis, and where both axes are alike.
constexpr std::array bearings_deg{0.0, 17.0, 45.0};

const char* name_of(Share share) {
  switch (share) {
    case Share::all_near:
      return "Near";
    case Share::all_far:
      return "Far";
    case Share::split:
      break;
  }
  return "Split";
}

bool has_known_answer(const Scene& scene, const Setup& setup) {
  // What is overhead is drawn from polygons, whatever walls are made of
  if (scene.is_overhead && setup.walls == Walls::houses) return false;
  // From below, a roof has no horizon whose texels could be counted
  return !(scene.is_overhead && setup.kind == FarMapKind::box && setup.share == Share::all_far);
}

Case case_of(const std::vector<Scene>& scenes, const Row& row) {
  return {scenes[row[0]], {shares[row[1]], kinds[row[2]], wall_kinds[row[3]], bearings_deg[row[4]]}};
}

std::vector<Row> all_rows(const std::vector<Scene>& scenes) {
  std::vector<Row> rows;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene)
    for (std::size_t share = 0; share < shares.size(); ++share)
      for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::size_t walls = 0; walls < wall_kinds.size(); ++walls)
          for (std::size_t bearing = 0; bearing < bearings_deg.size(); ++bearing) {
            const Row row{scene, share, kind, walls, bearing};
            const Case c = case_of(scenes, row);
            if (has_known_answer(c.scene, c.setup)) rows.push_back(row);
          }
  return rows;
}

bool was_wrong_once(const Case& c) {
  return c.scene.is_overhead && c.setup.kind == FarMapKind::horizon && c.setup.bearing_deg == bearings_deg[1];
}

std::vector<Case> cases_of(const std::vector<Scene>& scenes, const std::vector<Row>& rows) {
  std::vector<Case> cases;
  for (const Row& row : rows) cases.push_back(case_of(scenes, row));
  return cases;
}

}  // namespace

std::string name_of(const Case& c) {
  const char* walls = c.setup.walls == Walls::houses ? "Houses" : "Sheets";
  return c.scene.name + name_of(c.setup.share) + scenes::name_of(c.setup.kind) + walls +
         std::to_string(static_cast<int>(c.setup.bearing_deg));
}

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::automatic:
      return "automatic";
    case Engine::horizon:
      return "horizon";
    case Engine::rays:
      return "rays";
    case Engine::exact:
      return "exact";
    case Engine::near_only:
      break;
  }
  return "near_only";
}

std::vector<Engine> engines_for(FarMapKind kind) {
  if (kind == FarMapKind::horizon) return {Engine::automatic, Engine::horizon, Engine::rays};
  // `automatic` and `horizon` are as `rays` here; `exact` knows neither near nor far, and is asked once
  return {Engine::rays, Engine::exact};
}

std::vector<Case> all_cases() {
  const std::vector<Scene> scenes = all_scenes();
  return cases_of(scenes, all_rows(scenes));
}

std::vector<Case> chosen_cases() {
  const std::vector<Scene> scenes = all_scenes();
  const std::vector<Row> rows = all_rows(scenes);
  std::vector<Row> first;
  std::ranges::copy_if(rows, std::back_inserter(first), [&](const Row& row) { return was_wrong_once(case_of(scenes, row)); });
  return cases_of(scenes, with_all_pairs(first, rows));
}

}  // namespace farlod::analytic
