// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/analytic/analytic_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "farlod/angle.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::analytic {
namespace {

constexpr double no_closed_form = std::numeric_limits<double>::quiet_NaN();

/// A wall that is drawn from −a1 to a2 at distance d; "endless" ones end six distances away, and the oracle knows.
Scene finite_wall(const std::string& name, double H, double d, double a1, double a2) {
  return {name,
          [=](Stage& s) {
            s.add_wall({-a1, d}, {a2, d}, H);
          },
          oracles::finite_wall_cos(H, d, a1, a2),
          oracles::finite_wall_solid(H, d, a1, a2),
          d,
          std::hypot(d, std::max(a1, a2)),
          2 * H / d};
}

Scene canyon(double H1, double H2, double W, double x) {
  const double a = 4 * W;
  const auto hidden = [&](double svf_wall_1, double svf_wall_2) { return 1.0 - (1.0 - svf_wall_1) - (1.0 - svf_wall_2); };
  return {"Canyon",
          [=](Stage& s) {
            s.add_wall({-x, -a}, {-x, a}, H1);
            s.add_wall({W - x, -a}, {W - x, a}, H2);
          },
          hidden(oracles::finite_wall_cos(H1, x, a, a), oracles::finite_wall_cos(H2, W - x, a, a)),
          hidden(oracles::finite_wall_solid(H1, x, a, a), oracles::finite_wall_solid(H2, W - x, a, a)),
          std::min(x, W - x),
          std::hypot(a, W),
          2 * H1 / x + 2 * H2 / (W - x)};
}

/// A polygon of n sides around the circle: its sides come nearer than the circle by 1 − cos(π/n) of the radius, which raises tan
/// β by that share of at most H over the least distance.
Scene round_court(const std::string& name, double R, double H, double r) {
  constexpr int n = 360;
  const double nearest = R - std::abs(r);
  const double polygon_error = steepest_solid * H / nearest * (1 - std::cos(std::numbers::pi / n)) * R / nearest;
  return {name,
          [=](Stage& s) {
            const auto corner = [=](int k) {
              return Point2d{r + R * std::cos(2 * std::numbers::pi * k / n), R * std::sin(2 * std::numbers::pi * k / n)};
            };
            for (int k = 0; k < n; ++k) s.add_wall(corner(k), corner(k + 1), H);
          },
          oracles::round_court_cos(R, H, r),
          r == 0 ? oracles::basin_solid(std::atan(H / R)) : no_closed_form,
          nearest,
          R + std::abs(r),
          2 * (H / nearest - H / (R + std::abs(r))),
          polygon_error};
}

Scene rectangular_court(double west, double east, double south, double north, double H) {
  double cos = 0, solid = 0;
  for (const double a : {west, east})
    for (const double b : {south, north}) {
      cos += oracles::court_quadrant_cos(a, b, H);
      solid += oracles::court_quadrant_solid(a, b, H);
    }
  return {"RectangularCourt",
          [=](Stage& s) {
            const std::vector<Point2d> c{{-west, -south}, {east, -south}, {east, north}, {-west, north}};
            for (std::size_t k = 0; k < 4; ++k) s.add_wall(c[k], c[(k + 1) % 4], H);
          },
          cos,
          solid,
          std::min({west, east, south, north}),
          std::hypot(std::max(west, east), std::max(south, north)),
          2 * (H / west + H / east + H / south + H / north)};
}

/// A point of a canyon's wall looks across at a wall whose top is q higher; its own wall is behind it.
Scene wall_point(double q, double W) {
  const double a = 6 * W;
  // The opposite wall is finite: what it hides is, as for a horizontal receiver, below the tail of an endless one
  const double tail = q / W * std::pow(W / a, 2) / 2;
  return {"WallPoint",
          [=](Stage& s) {
            s.add_wall({W, -a}, {W, a}, q);
          },
          oracles::wall_point_cos(q, W),
          oracles::wall_point_solid(q, W),
          W,
          std::hypot(a, W),
          2 * q / W,
          tail,
          {1.0, 0.0, 0.0}};
}

Scene tilted_in_the_open(double tilt_deg) {
  const Angle t = Angle::degrees(tilt_deg);
  return {"Tilted" + std::to_string(static_cast<int>(tilt_deg)),
          [](Stage&) {},
          oracles::tilted_cos(t.radians()),
          1.0 - t.radians() / std::numbers::pi,
          1.0,
          1.0,
          0.0,
          0.0,
          {sin(t), 0.0, cos(t)}};
}

/// A scene of what is overhead: it has no horizon whose variation would count, and its receiver looks up.
Scene overhead(const std::string& name, const std::function<void(Stage&)>& build, double svf_cos, double svf_solid,
               double nearest_m, double farthest_m, double extra_error = 0.0) {
  return {name, build, svf_cos, svf_solid, nearest_m, farthest_m, 0.0, extra_error, {0.0, 0.0, 1.0}, true};
}

/// A half plane overhead, cut off far away: what lies beyond hides no more than an endless wall of its height there.
Scene overhang(const std::string& name, double h, double e, bool under) {
  const double far = 60 * h, edge = under ? e : -e;
  return overhead(
      name,
      [=](Stage& s) {
        s.add_polygon({{edge - far, -far, h}, {edge, -far, h}, {edge, far, h}, {edge - far, far, h}});
      },
      oracles::overhang_cos(h, e, under), no_closed_form, 4 * h, far * 1.5, 4 * (1 - oracles::wall_cos(h, far - e)));
}

/// What a level rectangle h above the eye hides, from the signed parts of its quadrants.
template <class Quadrant>
double hidden_by_rectangle(Point2d low, Point2d high, double h, const Quadrant& quadrant) {
  const auto part = [&](double a, double b) {
    const double size = quadrant(std::abs(a), std::abs(b), h);
    return (a < 0.0) != (b < 0.0) ? -size : size;
  };
  return part(high.x, high.y) - part(low.x, high.y) - part(high.x, low.y) + part(low.x, low.y);
}

/// A slab that floats; places are relative to the eye.
Scene floating_slab(const std::string& name, Point2d low, Point2d high, double h) {
  return overhead(
      name,
      [=](Stage& s) {
        s.add_polygon({{low.x, low.y, h}, {high.x, low.y, h}, {high.x, high.y, h}, {low.x, high.y, h}});
      },
      1.0 - hidden_by_rectangle(low, high, h, oracles::court_quadrant_cos),
      1.0 - hidden_by_rectangle(low, high, h, oracles::court_quadrant_solid), h,
      std::hypot(std::max(-low.x, high.x), std::max(-low.y, high.y)));
}

/// A roof h overhead from a wall behind the eye to an open front, e away. It is cut off far to both sides: through an end no more
/// is seen than an endless wall of its height hides there.
Scene arcade(double h, double back, double e) {
  const double far = 60 * h;
  return overhead(
      "Arcade",
      [=](Stage& s) {
        s.add_polygon({{-back, -far, h}, {e, -far, h}, {e, far, h}, {-back, far, h}});
        s.add_wall({-back, -far}, {-back, far}, h);
      },
      oracles::overhang_cos(h, e, true), no_closed_form, std::min(back, e), far, 2 * (1 - oracles::wall_cos(h, far)));
}

/// Three walls and a roof; in the south, d away, it is open: the sky is seen where a wall in the place of the opening would hide
/// it.
Scene open_shell(double west, double east, double north, double d, double h) {
  return overhead(
      "OpenShell",
      [=](Stage& s) {
        s.add_polygon({{-west, -d, h}, {east, -d, h}, {east, north, h}, {-west, north, h}});
        s.add_wall({-west, -d}, {-west, north}, h);
        s.add_wall({east, -d}, {east, north}, h);
        s.add_wall({-west, north}, {east, north}, h);
      },
      1.0 - oracles::finite_wall_cos(h, d, west, east), 1.0 - oracles::finite_wall_solid(h, d, west, east),
      std::min({west, east, north, d}), std::hypot(std::max(west, east), std::max(north, d)));
}

/// The corner of a large house, whose flat roof reaches beyond its walls: the eye stands below the eaves, `west` and `south` of
/// which they end; the walls begin at `corner`. In the quadrant of the house nothing is seen; elsewhere the sky below the eaves,
/// as much as walls in the place of their borders would hide.
Scene eave_at_corner(double west, double south, Point2d corner, double h) {
  const double far = 20 * h;
  return overhead(
      "EaveAtCorner",
      [=](Stage& s) {
        s.add_polygon({{-west, -south, h}, {far, -south, h}, {far, far, h}, {-west, far, h}});
        s.add_wall(corner, {far, corner.y}, h);
        s.add_wall({corner.x, far}, corner, h);
      },
      2.0 - oracles::finite_wall_cos(h, west, south, far) - oracles::finite_wall_cos(h, south, west, far),
      2.0 - oracles::finite_wall_solid(h, west, south, far) - oracles::finite_wall_solid(h, south, west, far),
      std::min({west, south, corner.x, corner.y}), far,
      // The walls' azimuths end a little before those of endless ones
      (corner.x + corner.y) / far + 2 * (1 - oracles::wall_cos(h, far)));
}

}  // namespace

void Stage::add_wall(Point2d a, Point2d b, double high_m) {
  if (walls_ == Walls::sheets) return builder_.add_wall(a, b, ground, high_m);
  constexpr double farther = 1.1;
  const bool is_clockwise = a.x * b.y - a.y * b.x > 0.0;  // seen from outside
  if (is_clockwise) std::swap(a, b);
  builder_.add_prism({a, b, farther * b, farther * a}, ground, high_m);
}

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

std::vector<Scene> all_scenes() {
  return {finite_wall("LongWall", 20, 12, 72, 72),
          finite_wall("FiniteWall", 20, 12, 30, 7),
          canyon(20, 14, 15, 4),
          round_court("Basin", 25, 20, 0),
          round_court("RoundCourt", 25, 20, 10),
          rectangular_court(9, 14, 11, 20, 16),
          wall_point(12, 15),
          tilted_in_the_open(35),
          tilted_in_the_open(90),
          overhang("UnderOverhang", 4, 3, true),
          overhang("BesideOverhang", 4, 3, false),
          floating_slab("UnderSlab", {-3, -2}, {5, 4}, 4),
          floating_slab("BesideSlab", {2, -3}, {9, 4}, 4),
          arcade(4, 5, 3),
          open_shell(5, 7, 5, 3, 4),
          eave_at_corner(4, 4.5, {3, 3.2}, 4)};
}

}  // namespace farlod::analytic
