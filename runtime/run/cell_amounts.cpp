// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/cell_amounts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <utility>

namespace farlod {
namespace {

constexpr Point3d upwards{0.0, 0.0, 1.0};

/// A surface that is steeper than this (a millimetre in a metre off the vertical) covers no plan: its height at a place would be
/// rounding.
constexpr double least_plan_normal_z = 0.001;

/// Two roofs this close to each other are one (VerticalProfile).
constexpr double same_roof_m = 0.0006;

/// What lies above a face, or below it. It looks up.
HalfSpace above(const CellFace& f) { return {f.corners[0], f.normal}; }

ConvexPiece piece_of(const CellFace& f) { return {f.corners.begin(), f.corners.end()}; }

bool covers_plan(const CellFace& f) { return f.normal.z > least_plan_normal_z; }

/// Sorted by their western ends.
std::vector<CellFace> from_west(std::vector<CellFace> faces) {
  std::ranges::stable_sort(faces, {}, [](const CellFace& f) { return f.low.x; });
  return faces;
}

/// The faces of `all` that cover some plan, from west to east.
std::vector<CellFace> plan_faces(const std::vector<CellFace>& all) {
  std::vector<CellFace> faces;
  std::ranges::copy_if(all, std::back_inserter(faces), covers_plan);
  return from_west(std::move(faces));
}

/// Calls `visit(n)` for those of `sorted` (from_west) whose boxes come so close to that of a face in the plan.
template <class Visit>
void for_each_touching(const std::vector<CellFace>& sorted, const CellFace& face, const Visit& visit, double margin_m = 0.0) {
  for (std::size_t n = 0; n < sorted.size() && sorted[n].low.x <= face.high.x + margin_m; ++n)
    if (touch_in_plan(face, sorted[n], margin_m)) visit(n);
}

/// Whether a piece lies in a face, but for rounding.
bool lies_in(const ConvexPiece& piece, const CellFace& face) {
  return std::ranges::all_of(
      piece, [&](const Point3d& p) { return std::abs(above(face).signed_distance(p)) <= same_roof_m * face.normal.z; });
}

/// Cuts away what another roof hides from above. Of two that lie in each other, the first stays.
void cut_by_roof(std::vector<ConvexPiece>& pieces, const CellFace& other, bool is_earlier) {
  const Column column(other.corners, upwards);
  std::vector<ConvexPiece> left;
  for (const ConvexPiece& piece : pieces) {
    const bool is_same = lies_in(column.part_of(piece), other);
    // Everywhere below the other one, where that is the earlier
    const HalfSpace hidden =
        is_same ? HalfSpace{other.corners[0] + Point3d{0.0, 0.0, 1e6}, {0.0, 0.0, -1.0}} : above(other).opposite();
    const std::vector<ConvexPiece> whole{piece};
    const std::vector<ConvexPiece> parts = is_same && !is_earlier ? whole : without(whole, column, hidden);
    left.insert(left.end(), parts.begin(), parts.end());
  }
  pieces = std::move(left);
}

/// Cuts away what lies below the ground.
void cut_by_ground(std::vector<ConvexPiece>& pieces, const CellFace& face, const std::vector<CellFace>& ground) {
  for_each_touching(ground, face, [&](std::size_t n) {
    if (ground[n].high.z <= face.low.z || pieces.empty()) return;
    pieces = without(pieces, Column(ground[n].corners, upwards), above(ground[n]).opposite());
  });
}

std::size_t bin_of(double height_m) {
  constexpr double rounding_m = 0.001;
  const double bin = std::floor((height_m + rounding_m) / height_bin_m);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(height_bins - 1)));
}

/// Parts a piece of a roof by its height above a triangle of the ground, which is between these two.
void add_by_height(const ConvexPiece& piece, const CellFace& ground, double least_m, double most_m, CellAmounts& amounts) {
  const std::size_t last = bin_of(most_m);
  double below_m2 = 0.0;
  for (std::size_t bin = bin_of(least_m); bin <= last; ++bin) {
    const Point3d border = ground.corners[0] + Point3d{0.0, 0.0, static_cast<double>(bin + 1) * height_bin_m};
    const ConvexPiece lower = bin == last ? piece : part_in(piece, HalfSpace{border, ground.normal}.opposite());
    const double up_to_border_m2 = area_vector(lower).z;
    amounts.plan_area_by_height_m2[bin] += up_to_border_m2 - below_m2;
    below_m2 = up_to_border_m2;
  }
}

/// A wind from each direction meets a surface of this area vector.
void add_frontal(const Point3d& area, const WindDirections& winds, CellAmounts& amounts) {
  for (std::size_t k = 0; k < winds.size(); ++k) amounts.frontal_area_m2[k] += std::max(0.0, dot(horizontal(area), winds[k]));
}

/// What of pieces of a face lies in a zone, if there is one. An upright face that stands on the border of two zones belongs to
/// the one behind it, where its building is: it counts where it would stand a little back.
std::vector<ConvexPiece> in_zone(const std::vector<ConvexPiece>& pieces, const std::vector<ZoneTrapezoid>* within,
                                 const CellFace& face) {
  if (within == nullptr) return pieces;
  constexpr double back_m = 1e-4;  // more than the rounding of a cell's floats, and less than anybody maps
  const Point3d back = covers_plan(face) ? Point3d{} : -back_m * face.of_surface;
  std::vector<ConvexPiece> parts;
  for (ConvexPiece piece : pieces) {
    for (Point3d& p : piece) p = p + back;
    const std::vector<ConvexPiece> inside = parts_within(piece, *within);
    parts.insert(parts.end(), inside.begin(), inside.end());
  }
  return parts;
}

/// What is seen from above, and how high it stands.
class PlanOfCell {
 public:
  PlanOfCell(const CellFaces& faces, const WindDirections& winds, const std::vector<ZoneTrapezoid>* within, CellForm& form)
      : ground_(plan_faces(faces.ground)), winds_(winds), within_(within), amounts_(form.amounts), buildings_(form.buildings) {
    std::vector<CellFace> tops = faces.roofs;
    tops.insert(tops.end(), faces.walls.begin(), faces.walls.end());
    tops_ = plan_faces(tops);
  }
  void add_all() {
    for (std::size_t n = 0; n < tops_.size(); ++n) add(n);
  }

 private:
  void add(std::size_t number) {
    const CellFace& top = tops_[number];
    std::vector<ConvexPiece> seen{piece_of(top)};
    for_each_touching(tops_, top, [&](std::size_t n) {
      if (n != number && tops_[n].high.z > top.low.z - same_roof_m && !seen.empty()) cut_by_roof(seen, tops_[n], n < number);
    });
    cut_by_ground(seen, top, ground_);
    for (const ConvexPiece& piece : in_zone(seen, within_, top)) {
      const Point3d area = area_vector(piece);
      amounts_.building_plan_area_m2 += area.z;
      buildings_[top.building].plan_area_m2 += area.z;
      add_heights(piece, top);
      // A wall that leans back counts as a wall
      if (std::abs(top.normal.z) < wall_normal_z) continue;
      amounts_.roof_area_m2 += norm(area);
      add_frontal(area, winds_, amounts_);
    }
  }
  /// Above each triangle of the ground, the height over it is linear.
  void add_heights(const ConvexPiece& piece, const CellFace& top) {
    for_each_touching(ground_, top, [&](std::size_t n) {
      const ConvexPiece part = Column(ground_[n].corners, upwards).part_of(piece);
      std::vector<double> heights_m;
      for (const Point3d& p : part) heights_m.push_back(above(ground_[n]).signed_distance(p) / ground_[n].normal.z);
      if (part.empty()) return;
      const auto [least, most] = std::ranges::minmax(heights_m);
      add_by_height(part, ground_[n], least, most, amounts_);
      for (std::size_t k = 2; k < part.size(); ++k) {
        const double third = area_vector({part[0], part[k - 1], part[k]}).z / 3.0;
        const double a = heights_m[0], b = heights_m[k - 1], c = heights_m[k], sum = a + b + c;
        amounts_.volume_m3 += third * sum;
        amounts_.height_moment_m4 += 0.25 * third * (a * a + b * b + c * c + sum * sum);
        buildings_[top.building].volume_m3 += third * sum;
        if (third > negligible_area_m2) amounts_.height_max_m = std::max({amounts_.height_max_m, a, b, c});
      }
    });
  }

  std::vector<CellFace> ground_, tops_;
  const WindDirections& winds_;
  const std::vector<ZoneTrapezoid>* within_;
  CellAmounts& amounts_;
  std::map<std::uint32_t, BuildingPart>& buildings_;
};

/// Whether two walls face away from each other.
bool are_back_to_back(const CellFace& a, const CellFace& b) {
  constexpr double most_alike = -0.9998;  // they are parallel within a degree
  return dot(a.of_surface, b.of_surface) <= most_alike;
}

/// The part of a wall that is nowhere farther than `party_wall_m` from the plane of another one. So it does not depend on where
/// the grid cuts either of them.
ConvexPiece close_part(const CellFace& wall, const CellFace& to) {
  const Point3d& n = to.of_surface;
  const Point3d ahead = to.corners[0] + party_wall_m * n, behind = to.corners[0] - party_wall_m * n;
  return part_in(part_in(piece_of(wall), {ahead, -1.0 * n}), {behind, n});
}

/// `others` are the walls of the cell and those on its border (from_west).
void cut_by_party_walls(std::vector<ConvexPiece>& pieces, const CellFace& wall, const std::vector<CellFace>& others) {
  // All of a column is party wall: the half space begins behind the wall
  const HalfSpace everywhere{wall.corners[0] - wall.of_surface, wall.of_surface};
  for_each_touching(
      others, wall,
      [&](std::size_t n) {
        if (pieces.empty() || !are_back_to_back(wall, others[n])) return;
        const ConvexPiece close = close_part(others[n], wall);
        for (std::size_t k = 2; k < close.size(); ++k)
          pieces = without(pieces, Column({close[0], close[k - 1], close[k]}, wall.of_surface), everywhere);
      },
      party_wall_m);
}

/// An upright wall along a side that two triangles of the ground share lies in the columns of both, and is cut twice by the same
/// or the higher ground, which changes nothing more.
void add_walls(const CellFaces& faces, const WindDirections& winds, const std::vector<ZoneTrapezoid>* within,
               CellAmounts& amounts) {
  const std::vector<CellFace> ground = plan_faces(faces.ground);
  std::vector<CellFace> others = faces.walls;
  others.insert(others.end(), faces.walls_at_border.begin(), faces.walls_at_border.end());
  others = from_west(std::move(others));
  for (const CellFace& wall : faces.walls) {
    std::vector<ConvexPiece> pieces{piece_of(wall)};
    cut_by_party_walls(pieces, wall, others);
    cut_by_ground(pieces, wall, ground);
    for (const ConvexPiece& piece : in_zone(pieces, within, wall)) {
      const Point3d area = area_vector(piece);
      amounts.wall_area_m2 += norm(area);
      add_frontal(area, winds, amounts);
    }
  }
}

}  // namespace

void CellForm::add(const CellForm& other) {
  const CellAmounts& from = other.amounts;
  amounts.building_plan_area_m2 += from.building_plan_area_m2;
  amounts.roof_area_m2 += from.roof_area_m2;
  amounts.wall_area_m2 += from.wall_area_m2;
  for (std::size_t k = 0; k < wind_directions; ++k) amounts.frontal_area_m2[k] += from.frontal_area_m2[k];
  amounts.volume_m3 += from.volume_m3;
  amounts.height_moment_m4 += from.height_moment_m4;
  amounts.height_max_m = std::max(amounts.height_max_m, from.height_max_m);
  for (std::size_t k = 0; k < height_bins; ++k) amounts.plan_area_by_height_m2[k] += from.plan_area_by_height_m2[k];
  for (const auto& [number, part] : other.buildings) {
    buildings[number].plan_area_m2 += part.plan_area_m2;
    buildings[number].volume_m3 += part.volume_m3;
  }
}

CellAmounts CellForm::all() const {
  std::vector<double> heights_m;
  // What is smaller than a square centimetre is rounding
  for (const auto& [number, b] : buildings)
    if (b.plan_area_m2 >= 1e-4) heights_m.push_back(b.volume_m3 / b.plan_area_m2);
  CellAmounts result = amounts;
  result.buildings = heights_m.size();
  if (heights_m.empty()) return result;
  const auto count = static_cast<double>(heights_m.size());
  double sum = 0.0, squares = 0.0;
  for (const double h : heights_m) sum += h;
  result.building_height_mean_m = sum / count;
  for (const double h : heights_m) squares += std::pow(h - result.building_height_mean_m, 2);
  result.building_height_std_m = std::sqrt(squares / count);
  return result;
}

CellForm form_of(const CellFaces& faces, const WindDirections& winds, const std::vector<ZoneTrapezoid>* within) {
  CellForm form;
  PlanOfCell(faces, winds, within, form).add_all();
  add_walls(faces, winds, within, form.amounts);
  return form;
}

}  // namespace farlod
