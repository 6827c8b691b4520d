// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/surfaces.hpp"

namespace farlod {

/// Where a receiver stands in a run: the number of its part (a cell), and its number therein. Receivers may come in another
/// order.
using PlaceInRun = std::pair<std::size_t, std::size_t>;

/// A mean weighted by area, over what has an answer.
struct AreaMean {
  double weighted = 0.0, area_m2 = 0.0;

  void add(double value, double area) {
    weighted += area * value;
    area_m2 += area;
  }
  [[nodiscard]] std::optional<double> value() const { return area_m2 > 0.0 ? std::optional(weighted / area_m2) : std::nullopt; }
};

/// The paper's façade averages: for each surface, the area-weighted mean over its receivers that have an answer; a surface whose
/// receivers have none keeps its row, without a value. A building's id and a surface's number together name a surface. Holds what
/// the surfaces need, and nothing of their receivers.
class SurfaceAverages {
 public:
  void add(PlaceInRun place, const SurfacePoint& receiver);
  /// In the order of the surfaces' first receivers in the run.
  [[nodiscard]] std::vector<SurfaceMean> rows() const;

 private:
  struct Surface {
    PlaceInRun first;
    SurfaceMean row;
    AreaMean mean;
    std::vector<AreaMean> further;
  };
  std::map<std::pair<std::string, std::uint32_t>, std::size_t> places_;
  std::vector<Surface> surfaces_;
};

/// The same for the roofs and for the walls of each building.
class BuildingAverages {
 public:
  void add(PlaceInRun place, const SurfacePoint& receiver);
  /// In the order of the buildings' first receivers in the run.
  [[nodiscard]] std::vector<BuildingMean> rows() const;

 private:
  struct Building {
    PlaceInRun first;
    BuildingMean row;
    AreaMean roofs, walls;
    std::set<std::uint32_t> numbers;
  };
  std::map<std::string, std::size_t> places_;
  std::vector<Building> buildings_;
};

}  // namespace farlod
