// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles::test {

/// A convex polygon of a body.
using Face = std::vector<Point3d>;

/// Roof, four walls, floor: the last is the floor.
inline std::vector<Face> box(double x0, double y0, double x1, double y1, double low_m, double high_m) {
  return {{{x0, y0, high_m}, {x1, y0, high_m}, {x1, y1, high_m}, {x0, y1, high_m}},
          {{x0, y0, low_m}, {x1, y0, low_m}, {x1, y0, high_m}, {x0, y0, high_m}},
          {{x1, y0, low_m}, {x1, y1, low_m}, {x1, y1, high_m}, {x1, y0, high_m}},
          {{x1, y1, low_m}, {x0, y1, low_m}, {x0, y1, high_m}, {x1, y1, high_m}},
          {{x0, y1, low_m}, {x0, y0, low_m}, {x0, y0, high_m}, {x0, y1, high_m}},
          {{x0, y0, low_m}, {x0, y1, low_m}, {x1, y1, low_m}, {x1, y0, low_m}}};
}

/// A closed house from (10, 10) to (20, 20), 6 m high, with a window that is set back: from x = `west` to 17, from 1 m to
/// `top_m`, and up to y = `back`. It is open to the south, and with a `back` of 20 to the north.
inline std::vector<Face> house_with_recess(double back, double west = 14, double top_m = 3) {
  const double w = west, t = top_m;
  std::vector<Face> faces{{{10, 10, 0}, {10, 20, 0}, {20, 20, 0}, {20, 10, 0}, {17, 10, 0}, {w, 10, 0}},
                          {{10, 10, 6}, {w, 10, 6}, {17, 10, 6}, {20, 10, 6}, {20, 20, 6}, {10, 20, 6}},
                          {{10, 10, 0}, {w, 10, 0}, {w, 10, 1}, {w, 10, t}, {w, 10, 6}, {10, 10, 6}},
                          {{17, 10, 0}, {20, 10, 0}, {20, 10, 6}, {17, 10, 6}, {17, 10, t}, {17, 10, 1}},
                          {{w, 10, 0}, {17, 10, 0}, {17, 10, 1}, {w, 10, 1}},
                          {{w, 10, t}, {17, 10, t}, {17, 10, 6}, {w, 10, 6}},
                          {{w, 10, 1}, {w, back, 1}, {w, back, t}, {w, 10, t}},
                          {{17, back, 1}, {17, 10, 1}, {17, 10, t}, {17, back, t}},
                          {{w, 10, 1}, {17, 10, 1}, {17, back, 1}, {w, back, 1}},
                          {{w, back, t}, {17, back, t}, {17, 10, t}, {w, 10, t}},
                          {{20, 10, 0}, {20, 20, 0}, {20, 20, 6}, {20, 10, 6}},
                          {{10, 20, 0}, {10, 10, 0}, {10, 10, 6}, {10, 20, 6}}};
  if (back < 20) {
    faces.push_back({{w, back, 1}, {17, back, 1}, {17, back, t}, {w, back, t}});
    faces.push_back({{20, 20, 0}, {10, 20, 0}, {10, 20, 6}, {20, 20, 6}});
    return faces;
  }
  // The way through the house
  faces.push_back({{20, 20, 0}, {17, 20, 0}, {17, 20, 1}, {17, 20, t}, {17, 20, 6}, {20, 20, 6}});
  faces.push_back({{17, 20, 0}, {w, 20, 0}, {w, 20, 1}, {17, 20, 1}});
  faces.push_back({{17, 20, t}, {w, 20, t}, {w, 20, 6}, {17, 20, 6}});
  faces.push_back({{w, 20, 0}, {10, 20, 0}, {10, 20, 6}, {w, 20, 6}, {w, 20, t}, {w, 20, 1}});
  return faces;
}

/// 20 × 10 m, eaves at 6 m, ridge at 9 m.
inline std::vector<Face> gabled_house() {
  return {{{0, 0, 6}, {20, 0, 6}, {20, 5, 9}, {0, 5, 9}},    // roof, south
          {{0, 5, 9}, {20, 5, 9}, {20, 10, 6}, {0, 10, 6}},  // roof, north
          {{0, 0, 0}, {20, 0, 0}, {20, 0, 6}, {0, 0, 6}},    // walls: south, north
          {{20, 10, 0}, {0, 10, 0}, {0, 10, 6}, {20, 10, 6}},
          {{20, 0, 0}, {20, 10, 0}, {20, 10, 6}, {20, 5, 9}, {20, 0, 6}},  // gables: east, west
          {{0, 10, 0}, {0, 0, 0}, {0, 0, 6}, {0, 5, 9}, {0, 10, 6}},
          {{0, 0, 0}, {0, 10, 0}, {20, 10, 0}, {20, 0, 0}}};
}

/// One body of two steps: 5 m high west of x = 10, 12 m high east of it.
inline std::vector<Face> stepped_box() {
  return {
      {{0, 0, 5}, {10, 0, 5}, {10, 10, 5}, {0, 10, 5}},     {{10, 0, 12}, {20, 0, 12}, {20, 10, 12}, {10, 10, 12}},
      {{10, 10, 5}, {10, 0, 5}, {10, 0, 12}, {10, 10, 12}},  // the step
      {{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}},       {{10, 0, 0}, {20, 0, 0}, {20, 0, 12}, {10, 0, 12}, {10, 0, 5}},
      {{10, 10, 0}, {0, 10, 0}, {0, 10, 5}, {10, 10, 5}},   {{20, 10, 0}, {10, 10, 0}, {10, 10, 5}, {10, 10, 12}, {20, 10, 12}},
      {{0, 10, 0}, {0, 0, 0}, {0, 0, 5}, {0, 10, 5}},       {{20, 0, 0}, {20, 10, 0}, {20, 10, 12}, {20, 0, 12}},
      {{0, 0, 0}, {0, 10, 0}, {10, 10, 0}, {10, 0, 0}},     {{10, 0, 0}, {10, 10, 0}, {20, 10, 0}, {20, 0, 0}}};
}

/// A box whose south wall is drawn in three strips and whose roof in two halves, while its other faces know nothing of it.
inline std::vector<Face> box_with_t_junctions() {
  auto faces = box(0, 0, 12, 8, 0, 6);
  faces.erase(faces.begin(), faces.begin() + 2);
  for (const double x : {0.0, 4.0, 8.0}) faces.push_back({{x, 0, 0}, {x + 4, 0, 0}, {x + 4, 0, 6}, {x, 0, 6}});
  faces.push_back({{0, 0, 6}, {12, 0, 6}, {12, 3, 6}, {0, 3, 6}});
  faces.push_back({{0, 3, 6}, {12, 3, 6}, {12, 8, 6}, {0, 8, 6}});
  return faces;
}

/// Adds a body as a building.
inline void add_building(CityModel& city, const std::string& id, const std::vector<Face>& faces) {
  city.begin_building(id);
  std::uint32_t surface = 0;
  for (const Face& face : faces) {
    city.begin_facet(SurfaceKind::unknown, surface++);
    city.add_ring(face);
  }
}

}  // namespace farlod::tiles::test
