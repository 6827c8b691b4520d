// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "horizon/pixel_field.hpp"

namespace farlod {
namespace {

/// A pixel in a plane, from that of the receiver.
constexpr std::int32_t place(PixelPlane plane, std::int32_t n, std::int32_t x, std::int32_t y) {
  return (static_cast<std::int32_t>(plane) + n) * PixelWindow::plane + y * PixelWindow::columns + x;
}

struct Pixel {
  std::int32_t x, y;
};
/// The pixels of a square from its south-western one.
constexpr std::array<Pixel, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// What is parallel to lines passes none of them.
constexpr double least_rate = 1e-9;

/// By how much lines are nearer, for who stands at a place between them, than for who stands on one: those passed at this rate.
double lead_of(double rate, double place) { return std::copysign(1.0, rate) * place; }

/// Makes the path of one direction, from a place in a pixel.
class PathMaker {
 public:
  PathMaker(Point2d direction, Point2d offset, double pixel_m, std::vector<PixelCrossing>& crossings,
            std::vector<SideCrossing>& sides)
      : direction_(direction), offset_(offset), pixel_m_(pixel_m), crossings_(crossings), sides_(sides) {}

  NearSegment between(double from, double to) {
    from_ = from;
    to_ = to;
    nearest_ = to;
    segment_ = {0, 0, floor_of(std::min(x_at(from), x_at(to))) - 1, floor_of(std::min(y_at(from), y_at(to))) - 1, 0.0F};
    // Lines through centres, and both diagonals of the squares between them
    const Point2d d = direction_, o = offset_;
    pass(d.x, o.x, 0.0, [this](double s, double x) { pass_column(s, x); });
    pass(d.y, o.y, 0.0, [this](double s, double y) { pass_row(s, y); });
    pass(d.x - d.y, o.x - o.y, 0.0, [this](double s, double n) { pass_rising_diagonal(s, n); });
    pass(d.x + d.y, o.x + o.y, 0.0, [this](double s, double n) { pass_falling_diagonal(s, n); });
    pass(d.x, o.x, 0.5, [this](double s, double x) { pass_east_side(s, x); });
    pass(d.y, o.y, 0.5, [this](double s, double y) { pass_north_side(s, y); });
    segment_.per_distance = per_distance(nearest_);
    segment_.crossings_end = static_cast<std::uint32_t>(crossings_.size());
    segment_.sides_end = static_cast<std::uint32_t>(sides_.size());
    return segment_;
  }

 private:
  [[nodiscard]] double x_at(double s) const { return offset_.x + s * direction_.x; }
  [[nodiscard]] double y_at(double s) const { return offset_.y + s * direction_.y; }
  /// Calls `visit(distance, line)` at the lines ±(first + n), n = 0, 1, …, which are passed at this rate, from this place between
  /// them on; but for lines below the receiver.
  template <class Visit>
  void pass(double rate, double place, double first, const Visit& visit) {
    const double lines = std::abs(rate), lead = lead_of(rate, place);
    if (lines < least_rate) return;
    const auto line_from = [&](double distance) { return std::ceil(distance * lines + lead - first) + first; };
    for (double n = line_from(from_), end = line_from(to_); n < end; ++n) {
      const double distance = (n - lead) / lines;
      if (distance < below) continue;
      nearest_ = std::min(nearest_, distance);
      visit(distance, std::copysign(1.0, rate) * n);
    }
  }
  [[nodiscard]] float per_distance(double distance) const { return static_cast<float>(1.0 / (distance * pixel_m_)); }
  [[nodiscard]] static std::int32_t floor_of(double x) { return static_cast<std::int32_t>(std::floor(x)); }

  /// The line through the centres of a column: between two pixels of it.
  void pass_column(double s, double line) {
    const double v = y_at(s);
    const std::int32_t x = floor_of(line), y = floor_of(v);
    const bool is_first = v - y < 0.5;
    crossings_.push_back({place(PixelPlane::height, 0, x, is_first ? y : y + 1), place(PixelPlane::north, 0, x, y),
                          static_cast<float>(v - (is_first ? y : y + 1)), per_distance(s)});
  }
  void pass_row(double s, double line) {
    const double u = x_at(s);
    const std::int32_t x = floor_of(u), y = floor_of(line);
    const bool is_first = u - x < 0.5;
    crossings_.push_back({place(PixelPlane::height, 0, is_first ? x : x + 1, y), place(PixelPlane::east, 0, x, y),
                          static_cast<float>(u - (is_first ? x : x + 1)), per_distance(s)});
  }
  /// The diagonal x − y = n of a square.
  void pass_rising_diagonal(double s, double n) {
    const std::int32_t x = floor_of(x_at(s));
    pass_diagonal(s, {x, x - floor_of(n)}, 0, 2);
  }
  /// The diagonal x + y = n.
  void pass_falling_diagonal(double s, double n) {
    const std::int32_t x = floor_of(x_at(s));
    pass_diagonal(s, {x, floor_of(n) - 1 - x}, 3, 1);
  }
  /// From the western pixel of a square to its eastern one.
  void pass_diagonal(double s, Pixel square, std::size_t west, std::size_t east) {
    const double share = x_at(s) - square.x;
    const bool is_first = share < 0.5;
    crossings_.push_back(towards_middle(square, is_first ? west : east, 2.0 * (is_first ? share : 1.0 - share), s));
  }
  /// From the centre of pixel k of a square, or from the middle of its side, as high, to the square's middle.
  [[nodiscard]] PixelCrossing towards_middle(Pixel square, std::size_t k, double share, double s) const {
    return {place(PixelPlane::height, 0, square.x + corners[k].x, square.y + corners[k].y),
            place(PixelPlane::to_middle, static_cast<std::int32_t>(k), square.x, square.y), static_cast<float>(share),
            per_distance(s)};
  }
  /// The side between two columns of pixels.
  void pass_east_side(double s, double line) {
    const double v = y_at(s);
    const Pixel square{floor_of(line), floor_of(v)};
    const bool is_south = v - square.y < 0.5;
    const double share = 2.0 * (is_south ? v - square.y : square.y + 1 - v);
    add_side(square, is_south ? 0 : 3, is_south ? 1 : 2, share, s,
             place(PixelPlane::torn_east, 0, square.x, is_south ? square.y : square.y + 1));
  }
  void pass_north_side(double s, double line) {
    const double u = x_at(s);
    const Pixel square{floor_of(u), floor_of(line)};
    const bool is_west = u - square.x < 0.5;
    const double share = 2.0 * (is_west ? u - square.x : square.x + 1 - u);
    add_side(square, is_west ? 0 : 1, is_west ? 3 : 2, share, s,
             place(PixelPlane::torn_north, 0, is_west ? square.x : square.x + 1, square.y));
  }
  void add_side(Pixel square, std::size_t first, std::size_t second, double share, double s, std::int32_t torn) {
    sides_.push_back({towards_middle(square, first, share, s), towards_middle(square, second, share, s), torn});
  }

  /// Half a part of PixelOffset, in pixels: from a line that is nearer, the surface is seen to rise where its next lines are.
  static constexpr double below = 0.5 / PixelOffset::parts;

  Point2d direction_, offset_;
  double pixel_m_, from_ = 0.0, to_ = 0.0, nearest_ = 0.0;
  NearSegment segment_{};
  std::vector<PixelCrossing>& crossings_;
  std::vector<SideCrossing>& sides_;
};

/// Adds the segments beyond the window, of `step` pixels each, up to `end`; before the first, one that ends where they begin.
void add_far(Point2d direction, Point2d offset, double pixel_m, std::int32_t step, double end,
             std::vector<FarSegment>& segments) {
  const auto ceiling_of = [](double x) { return static_cast<std::int32_t>(std::ceil(x)); };
  const double column_lead = lead_of(direction.x, offset.x), row_lead = lead_of(direction.y, offset.y);
  for (double to = pixel_reach; to - 2.0 * step < end; to += step) {
    const double from = to - step, columns = to * std::abs(direction.x) + column_lead,
                 rows = to * std::abs(direction.y) + row_lead;
    const auto lowest = [&](double rate, double place) {
      return static_cast<std::int32_t>(std::floor(std::min(from * rate, to * rate) + place)) - 1;
    };
    segments.push_back({ceiling_of(columns), ceiling_of(rows), ceiling_of(columns + 0.5), ceiling_of(rows + 0.5),
                        lowest(direction.x, offset.x), lowest(direction.y, offset.y),
                        static_cast<float>(1.0 / (from * pixel_m))});
  }
}

PixelPath path_along(Point2d direction, Point2d offset, double pixel_m) {
  const auto per = [](double rate) { return 1.0 / std::max(std::abs(rate), least_rate); };
  const auto fixed = [](double pixels) { return std::llround(std::ldexp(pixels, 32)); };
  PixelPath path{};
  path.cosine = direction.x;
  path.sine = direction.y;
  path.per_cosine = per(direction.x);
  path.per_sine = per(direction.y);
  const double column_lead = lead_of(direction.x, offset.x), row_lead = lead_of(direction.y, offset.y);
  path.north_per_column = fixed(direction.y * path.per_cosine);
  path.east_per_row = fixed(direction.x * path.per_sine);
  path.north_first = fixed(offset.y - column_lead * direction.y * path.per_cosine);
  path.east_first = fixed(offset.x - row_lead * direction.x * path.per_sine);
  path.column_lead = static_cast<float>(column_lead);
  path.row_lead = static_cast<float>(row_lead);
  path.columns_per_metre = static_cast<float>(std::abs(direction.x) / pixel_m);
  path.rows_per_metre = static_cast<float>(std::abs(direction.y) / pixel_m);
  return path;
}

}  // namespace

PixelPaths::PixelPaths(std::span<const Point2d> directions, const PixelField& field, const PixelOffset& offset) {
  const Point2d place = offset.in_pixels();
  std::vector<Counts> begins{counts()};
  for (const Point2d direction : directions) {
    add_near(direction, place, field.pixel_m());
    // As far as a segment may reach that begins above a pixel
    const double end = field.diagonal() + 3 * long_step;
    add_far(direction, place, field.pixel_m(), far_step, end, far_);
    add_far(direction, place, field.pixel_m(), long_step, end, long_far_);
    paths_.push_back(path_along(direction, place, field.pixel_m()));
    begins.push_back(counts());
  }
  // Arrays do not move any more
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const auto part = [](const auto& all, std::size_t begin, std::size_t end) {
      return std::span(all).subspan(begin, end - begin);
    };
    const Counts &b = begins[k], &e = begins[k + 1];
    paths_[k].near = part(near_, b.near, e.near);
    paths_[k].crossings = part(crossings_, b.crossings, e.crossings);
    paths_[k].sides = part(sides_, b.sides, e.sides);
    paths_[k].far = part(far_, b.far, e.far);
    paths_[k].long_far = part(long_far_, b.long_far, e.long_far);
  }
}

PixelPaths::Counts PixelPaths::counts() const {
  return {near_.size(), crossings_.size(), sides_.size(), far_.size(), long_far_.size()};
}

void PixelPaths::add_near(Point2d direction, Point2d offset, double pixel_m) {
  const auto first_crossing = static_cast<std::uint32_t>(crossings_.size()),
             first_side = static_cast<std::uint32_t>(sides_.size());
  PathMaker maker(direction, offset, pixel_m, crossings_, sides_);
  for (std::int32_t from = 0; from < pixel_reach; from += far_step) {
    NearSegment segment = maker.between(from, from + far_step);
    segment.crossings_end -= first_crossing;
    segment.sides_end -= first_side;
    near_.push_back(segment);
  }
}

}  // namespace farlod
