// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "farlod/box.hpp"
#include "farlod/package.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/footprints_text.hpp"

namespace farlod::library {

/// East of the central meridian of the zone, so that grid north and true north differ.
inline constexpr Point2d form_corner{560000.0, 5500000.0};

/// Coordinates relative to a cell are floats of some micrometres; surfaces are 100 m long.
inline constexpr double form_rounding_m2 = 1e-3;

/// Footprints, packed in cells of any size.
class FormTown {
 public:
  explicit FormTown(const scenes::FootprintsText& footprints) : text_(footprints.text()) {}

  [[nodiscard]] std::vector<CellMorphology> cells(double cell_edge_m, AlignMode align = AlignMode::none) const {
    return morphology_of_cells(packed(cell_edge_m, align));
  }
  [[nodiscard]] Package packed(double cell_edge_m, AlignMode align, Assign assign = Assign::clip) const {
    return Package(folder_of(cell_edge_m, align, assign));
  }
  /// The folder of a new package.
  [[nodiscard]] std::filesystem::path folder_of(double cell_edge_m, AlignMode align, Assign assign = Assign::clip) const {
    std::ofstream(folder_.file("town.geojson")) << text_;
    PackSettings settings;
    settings.inputs = {folder_.file("town.geojson")};
    settings.output = folder_.file("town" + std::to_string(++packages_));
    settings.cell_edge_m = cell_edge_m;
    settings.align = align;
    settings.assign = assign;
    Report report;
    (void)pack(settings, report);
    return settings.output;
  }

 private:
  std::string text_;
  scenes::TemporaryFolder folder_;
  mutable int packages_ = 0;
};

inline Box2d form_box(double west, double south, double east, double north) {
  return {form_corner + Point2d{west, south}, form_corner + Point2d{east, north}};
}

/// A house of 40 m × 20 m × 10 m, whose long sides face south and north of the map.
inline FormTown form_house() {
  return FormTown(scenes::FootprintsText().add(scenes::building("a", 10.0), form_box(0, 0, 40, 20)));
}

}  // namespace farlod::library
