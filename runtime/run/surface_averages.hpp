// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
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

/// Where irradiation is among the further values of receivers, if it is, and how much of it is asked for.
struct WantedIrradiation {
  std::optional<std::size_t> column = {};
  std::optional<double> threshold_kwh_m2 = {};
};

/// What the receivers of a surface, or of the roofs or walls of a building, that have an answer come to.
class AreaAnswers {
 public:
  /// The receiver has an answer.
  void add(const SurfacePoint& receiver, const WantedIrradiation& wanted);

  [[nodiscard]] std::optional<double> svf() const { return svf_.value(); }
  /// NaN where no receiver has a value; empty where no receiver was added.
  [[nodiscard]] std::vector<double> further() const;
  [[nodiscard]] const std::optional<AreaIrradiation>& irradiation() const { return irradiation_; }

 private:
  AreaMean svf_;
  std::vector<AreaMean> further_;
  std::optional<AreaIrradiation> irradiation_;
};

/// The paper's façade averages: for each surface, the area-weighted mean over its receivers that have an answer; a surface whose
/// receivers have none keeps its row, without a value. A building's id and a surface's number together name a surface. Holds what
/// the surfaces need, and nothing of their receivers.
class SurfaceAverages {
 public:
  explicit SurfaceAverages(const WantedIrradiation& wanted = {}) : wanted_(wanted) {}
  void add(PlaceInRun place, const SurfacePoint& receiver);
  /// In the order of the surfaces' first receivers in the run.
  [[nodiscard]] std::vector<SurfaceMean> rows() const;

 private:
  struct Surface {
    PlaceInRun first;
    SurfaceMean row;
    AreaAnswers answers;
  };
  WantedIrradiation wanted_;
  std::map<std::pair<std::string, std::uint32_t>, std::size_t> places_;
  std::vector<Surface> surfaces_;
};

/// The same for the roofs and for the walls of each building.
class BuildingAverages {
 public:
  explicit BuildingAverages(const WantedIrradiation& wanted = {}) : wanted_(wanted) {}
  void add(PlaceInRun place, const SurfacePoint& receiver);
  /// In the order of the buildings' first receivers in the run.
  [[nodiscard]] std::vector<BuildingMean> rows() const;

 private:
  struct Building {
    PlaceInRun first;
    BuildingMean row;
    AreaAnswers roofs, walls;
    std::set<std::uint32_t> numbers;
  };
  WantedIrradiation wanted_;
  std::map<std::string, std::size_t> places_;
  std::vector<Building> buildings_;
};

}  // namespace farlod
