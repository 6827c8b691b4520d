// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <regex>

#include "tests/acceptance/csv_table.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::acceptance {

using nlohmann::json;

using Corner = std::array<double, 3>;
using Corners = std::vector<Corner>;

/// A semantic surface of a file, as the one who wrote it knows it: where it stands, and which polygons it has in the level of
/// detail that is packed. A polygon is known by its area, which no other has.
struct WrittenSurface {
  std::string building;
  std::string name;           ///< its attribute `mark`
  std::vector<double> areas;  ///< of its polygons that have an answer of their own
};

/// Draws cities at random. The same seed draws the same city.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : random_(seed) {}
  [[nodiscard]] int below(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
  [[nodiscard]] bool one_in(int count) { return below(count) == 0; }

 private:
  std::mt19937 random_;
};

/// A wall or a roof.
struct Face {
  Corners corners;
  double area_m2 = 0.0;
};

/// Hands out walls and roofs, each at a place of its own. All areas differ by more than the digits of a table.
class Street {
 public:
  [[nodiscard]] Face next_wall() {
    const auto [x, y, width] = next_place();
    return {{{x, y, 0.0}, {x + width, y, 0.0}, {x + width, y, 3.5}, {x, y, 3.5}}, 3.5 * width};
  }
  [[nodiscard]] Face next_roof() {
    const auto [x, y, width] = next_place();
    return {{{x, y, 5.0}, {x + width, y, 5.0}, {x + width, y + 5.0, 5.0}, {x, y + 5.0, 5.0}}, 5.0 * width};
  }

 private:
  Corner next_place() {
    ++count_;
    return {500'000.0 + 30.0 * static_cast<double>(count_ % 40), 5'500'000.0 + 30.0 * static_cast<double>(count_ / 40),
            3.0 + 0.04 * static_cast<double>(count_)};
  }

  int count_ = 0;
};

inline std::string number(double value) {
  std::ostringstream text;
  text.precision(13);
  text << value;
  return text.str();
}

/// The values that a file has again, by the mark of the surface.
using FoundValues = std::map<std::string, std::map<std::string, std::string>>;

class EnrichedRandomCity : public testing::Test {
 protected:
  void run(const std::string& name, const std::string& options = "") const {
    const std::string spacing = " --surfaces all --spacing 3 --quiet";
    folder.must("farlod-pack " + name + " -o a.farlod --force --quiet --crs EPSG:25832 " + options);
    folder.must("farlod-svf a.farlod -o out_" + name + " --city " + name + spacing);
    folder.must("farlod-svf a.farlod -o a.csv" + spacing);
  }

  /// Each surface has the values of its own polygons in the table, and nothing else of the file has changed.
  void expect_own_values(const std::vector<WrittenSurface>& written, const FoundValues& found) const {
    const CsvTable table(folder.text_of("a.surfaces.csv"));
    std::map<std::pair<std::string, long>, std::size_t> rows;  // by building and area, in the digits of the table
    for (std::size_t n = 0; n < table.size(); ++n) {
      const double area_m2 = table.number(n, "area_m2") + table.number(n, "covered_area_m2");
      rows[{table.text(n, "building"), std::lround(100.0 * area_m2)}] = n;
    }
    std::size_t with_values = 0;
    for (const WrittenSurface& surface : written) {
      std::vector<std::size_t> own;
      for (const double area_m2 : surface.areas)
        if (const auto row = rows.find({surface.building, std::lround(100.0 * area_m2)}); row != rows.end())
          own.push_back(row->second);
      ASSERT_EQ(own.size(), surface.areas.size()) << "a polygon of " << surface.name << " is not in the table";
      const auto values = found.find(surface.name);
      if (own.empty()) {
        EXPECT_TRUE(values == found.end()) << surface.name << " has values that are not its own";
        continue;
      }
      ASSERT_TRUE(values != found.end()) << surface.name << " has no values";
      ++with_values;
      expect_values(values->second, table, own, surface.name);
    }
    EXPECT_EQ(with_values, found.size());
    EXPECT_GT(with_values, 10U);
  }

  WorkFolder folder;

 private:
  static void expect_values(const std::map<std::string, std::string>& values, const CsvTable& table,
                            const std::vector<std::size_t>& rows, const std::string& name) {
    double area_m2 = 0.0, covered_m2 = 0.0, weighted = 0.0, least = 2.0;
    for (const std::size_t row : rows) {
      area_m2 += table.number(row, "area_m2");
      covered_m2 += table.number(row, "covered_area_m2");
      if (table.text(row, "svf_mean").empty()) continue;
      weighted += table.number(row, "area_m2") * table.number(row, "svf_mean");
      least = std::min(least, table.number(row, "svf_min"));
    }
    constexpr double digit = 2e-3;  // tables have areas in thousandths
    EXPECT_NEAR(std::stod(values.at("svf_area_m2")), area_m2, digit * static_cast<double>(rows.size())) << name;
    EXPECT_NEAR(std::stod(values.at("covered_area_m2")), covered_m2, digit * static_cast<double>(rows.size())) << name;
    if (least > 1.0) return;
    EXPECT_NEAR(std::stod(values.at("svf_mean")), weighted / area_m2, 1e-4) << name;
    EXPECT_EQ(std::stod(values.at("svf_min")), least) << name;
    if (rows.size() > 1) return;
    EXPECT_EQ(std::stod(values.at("svf_mean")), table.number(rows.front(), "svf_mean")) << name;
  }
};

}  // namespace farlod::acceptance
