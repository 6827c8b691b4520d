// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod::scenes {

/// A file of GeoJSON, polygon by polygon.
class FootprintsText {
 public:
  /// Places are in the CRS of this name, or in degrees.
  explicit FootprintsText(const std::string& crs = "EPSG:32632") {
    text_ << std::fixed << std::setprecision(9) << R"({"type":"FeatureCollection",)";
    if (!crs.empty()) text_ << R"("crs":{"type":"name","properties":{"name":")" << crs << R"("}},)";
    text_ << R"("features":[)";
  }
  /// A ring whose end is not its begin; `properties` as JSON has them between its braces.
  FootprintsText& add(const std::string& properties, const std::vector<Point2d>& ring) {
    text_ << separator_ << R"({"type":"Feature","properties":{)" << properties
          << R"(},"geometry":{"type":"Polygon","coordinates":[[)";
    for (const Point2d& p : ring) text_ << '[' << p.x << ',' << p.y << "],";
    text_ << '[' << ring.front().x << ',' << ring.front().y << "]]]}}";
    separator_ = ",\n";
    return *this;
  }
  FootprintsText& add(const std::string& properties, const Box2d& box) {
    return add(properties, {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}});
  }
  [[nodiscard]] std::string text() const { return text_.str() + "]}\n"; }

 private:
  std::ostringstream text_;
  const char* separator_ = "";
};

/// What a footprint says of a building.
inline std::string building(const std::string& id, double height_m) {
  return R"("id":")" + id + R"(","height":)" + std::to_string(height_m);
}

}  // namespace farlod::scenes
