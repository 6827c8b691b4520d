// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/wall_lines.hpp"

#include <cmath>
#include <limits>

namespace farlod::tiles {
namespace {

using Along = TornPiece::Along;
using Run = LevelRun::Run;

constexpr std::array<double, 2> no_surface{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The height of a border, and whether it is that of the second side.
Run top_of(const TornPiece& piece) {
  const double first_m = piece.heights_of_side_m[0][0], second_m = piece.heights_of_side_m[1][0];
  const bool is_of_second = std::isnan(first_m) || second_m > first_m;
  return {piece.begin, piece.end, {is_of_second ? second_m : first_m, is_of_second ? 1.0 : 0.0}};
}

}  // namespace

bool TornPiece::is_level() const {
  // Heights that are not there compare as if they did not differ
  const auto slopes = [](const std::array<double, 2>& h) { return h[0] < h[1] || h[0] > h[1]; };
  return !slopes(heights_of_side_m[0]) && !slopes(heights_of_side_m[1]);
}

void WallLines::add(const TornPiece& piece) {
  if (piece.is_level()) return add_level(piece);
  add_wall(piece);
  for (const std::size_t side : {0U, 1U}) add_top(piece, side);
}

void WallLines::add_level(const TornPiece& piece) {
  const bool is_northward = piece.along == Along::y;
  const auto column = static_cast<std::size_t>(piece.line / 2);
  LevelRun& walls = is_northward ? northward_walls_[column] : eastward_walls_;
  LevelRun& tops = is_northward ? northward_tops_[column] : eastward_tops_;
  if (!is_northward) eastward_line_ = piece.line;
  const Run wall{piece.begin, piece.end, {piece.heights_of_side_m[0][0], piece.heights_of_side_m[1][0]}};
  const auto take_wall = [&](const Run& run) { add_wall(piece.along, piece.line, run); };
  if (std::isnan(wall.heights_m[0]) || std::isnan(wall.heights_m[1]))
    walls.end(take_wall);
  else
    walls.add(wall, take_wall);
  tops.add(top_of(piece), [&](const Run& run) { add_top(piece.along, piece.line, run); });
}

void WallLines::end_line_along_x() {
  eastward_walls_.end([this](const Run& run) { add_wall(Along::x, eastward_line_, run); });
  eastward_tops_.end([this](const Run& run) { add_top(Along::x, eastward_line_, run); });
}

void WallLines::end() {
  end_line_along_x();
  for (std::size_t column = 0; column < northward_walls_.size(); ++column) {
    const auto line = 2 * static_cast<std::int64_t>(column);
    northward_walls_[column].end([&](const Run& run) { add_wall(Along::y, line, run); });
    northward_tops_[column].end([&](const Run& run) { add_top(Along::y, line, run); });
  }
}

void WallLines::add_wall(Along along, std::int64_t line, const Run& run) {
  const auto [first_m, second_m] = run.heights_m;
  add_wall({along, line, run.begin, run.end, {{{first_m, first_m}, {second_m, second_m}}}});
}

void WallLines::add_top(Along along, std::int64_t line, const Run& run) {
  const auto [height_m, side] = run.heights_m;
  TornPiece piece{along, line, run.begin, run.end, {no_surface, no_surface}};
  const std::size_t own = side > 0.5 ? 1 : 0;
  piece.heights_of_side_m[own] = {height_m, height_m};
  add_top(piece, own);
}

/// Between the borders of both sides. Where they cross, two triangles meet.
void WallLines::add_wall(const TornPiece& piece) {
  const auto& [first, second] = piece.heights_of_side_m;
  const double begin_m = second[0] - first[0], end_m = second[1] - first[1];
  if (std::isnan(begin_m)) return;
  const Point3d a = at_(piece.place(piece.begin), first[0]), b = at_(piece.place(piece.end), first[1]),
                c = at_(piece.place(piece.end), second[1]), d = at_(piece.place(piece.begin), second[0]);
  if (begin_m * end_m < 0.0) {
    const Point3d x = a + begin_m / (begin_m - end_m) * (b - a);
    surface_.triangles.push_back({a, x, d});
    surface_.triangles.push_back({b, c, x});
    return;
  }
  if (end_m != 0.0) surface_.triangles.push_back({a, b, c});
  if (begin_m != 0.0) surface_.triangles.push_back({a, c, d});
}

/// The border of a side, where it is somewhere above the other one.
void WallLines::add_top(const TornPiece& piece, std::size_t side) {
  const auto &own = piece.heights_of_side_m[side], &other = piece.heights_of_side_m[1 - side];
  if (std::isnan(own[0]) || (own[0] <= other[0] && own[1] <= other[1])) return;
  // The centre of the pixel lies beside that end which is the middle of its side
  const bool begins_at_corner = piece.begin % 2 == 0;
  EdgeSides edge(at_(piece.place(piece.begin), own[0]), at_(piece.place(piece.end), own[1]));
  edge.add(at_(piece.aside(begins_at_corner ? piece.end : piece.begin, side), own[begins_at_corner ? 1 : 0]), FacetLook::up);
  if (edge.can_be_horizon()) surface_.edges.push_back({edge.edge(), edge.adjacent()});
}

}  // namespace farlod::tiles
