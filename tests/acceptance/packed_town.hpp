// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "tests/acceptance/csv_table.hpp"
#include "tests/acceptance/raster_file.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {

/// The small town, packed with default settings as `a.farlod`.
class PackedTown : public testing::Test {
 protected:
  PackedTown() { add_packed_town(folder, "small_town", small_town()); }
  [[nodiscard]] CsvTable table(const std::string& name) const { return CsvTable(folder.text_of(name)); }
  [[nodiscard]] RasterFile raster(const std::string& name) const { return read_raster(folder.path(name)); }
  /// The answer at one point: of the package, and with the further arguments, that are given.
  [[nodiscard]] double svf_at(const std::string& place, const std::string& arguments = "",
                              const std::string& package = "a.farlod") const {
    folder.must("farlod-svf " + package + " -o at.csv --at " + place + " " + arguments);
    const CsvTable answer = table("at.csv");
    return answer.number(0, answer.header().back());
  }

  WorkFolder folder;
};

/// Default number of rays. A share of them is printed with all its digits.
inline constexpr std::size_t default_rays = 1000;

/// Tables print six digits behind the point.
inline constexpr double half_of_last_digit = 0.5e-6;

/// The paper's own claim for the error of a far map that is looked up by direction alone, with 3 × 3 cells near.
inline constexpr double paper_error = 0.10;

}  // namespace farlod::acceptance
