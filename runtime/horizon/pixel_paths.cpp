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

/// Makes the path of one direction.
class PathMaker {
 public:
  PathMaker(Point2d direction, double pixel_m, std::vector<PixelCrossing>& crossings, std::vector<SideCrossing>& sides)
      : direction_(direction), pixel_m_(pixel_m), crossings_(crossings), sides_(sides) {}

  NearSegment between(double from, double to) {
    from_ = from;
    to_ = to;
    segment_ = {0, 0, floor_of(std::min(from * direction_.x, to * direction_.x)) - 1,
                floor_of(std::min(from * direction_.y, to * direction_.y)) - 1,
                static_cast<float>(1.0 / (std::max(from, 0.5) * pixel_m_))};
    // Lines through centres, and both diagonals of the squares between them
    pass(direction_.x, 0.0, [this](double s, double x) { pass_column(s, x); });
    pass(direction_.y, 0.0, [this](double s, double y) { pass_row(s, y); });
    pass(direction_.x - direction_.y, 0.0, [this](double s, double n) { pass_rising_diagonal(s, n); });
    pass(direction_.x + direction_.y, 0.0, [this](double s, double n) { pass_falling_diagonal(s, n); });
    pass(direction_.x, 0.5, [this](double s, double x) { pass_east_side(s, x); });
    pass(direction_.y, 0.5, [this](double s, double y) { pass_north_side(s, y); });
    segment_.crossings_end = static_cast<std::uint32_t>(crossings_.size());
    segment_.sides_end = static_cast<std::uint32_t>(sides_.size());
    return segment_;
  }

 private:
  /// Calls `visit(distance, line)` at the lines ±(first + n), n = 0, 1, …, but for that of the receiver, which are passed at this
  /// rate.
  template <class Visit>
  void pass(double rate, double first, const Visit& visit) const {
    const double lines = std::abs(rate);
    if (lines < 1e-9) return;
    for (double n = std::max(std::ceil(from_ * lines - first), first > 0.0 ? 0.0 : 1.0); (n + first) < to_ * lines; ++n)
      if (const double distance = (n + first) / lines; distance >= from_) visit(distance, std::copysign(n + first, rate));
  }
  [[nodiscard]] float per_distance(double distance) const { return static_cast<float>(1.0 / (distance * pixel_m_)); }
  [[nodiscard]] static std::int32_t floor_of(double x) { return static_cast<std::int32_t>(std::floor(x)); }

  /// The line through the centres of a column: between two pixels of it.
  void pass_column(double s, double line) {
    const double v = s * direction_.y;
    const std::int32_t x = floor_of(line), y = floor_of(v);
    const bool is_first = v - y < 0.5;
    crossings_.push_back({place(PixelPlane::height, 0, x, is_first ? y : y + 1), place(PixelPlane::north, 0, x, y),
                          static_cast<float>(v - (is_first ? y : y + 1)), per_distance(s)});
  }
  void pass_row(double s, double line) {
    const double u = s * direction_.x;
    const std::int32_t x = floor_of(u), y = floor_of(line);
    const bool is_first = u - x < 0.5;
    crossings_.push_back({place(PixelPlane::height, 0, is_first ? x : x + 1, y), place(PixelPlane::east, 0, x, y),
                          static_cast<float>(u - (is_first ? x : x + 1)), per_distance(s)});
  }
  /// The diagonal x − y = n of a square.
  void pass_rising_diagonal(double s, double n) {
    const std::int32_t x = floor_of(s * direction_.x);
    pass_diagonal(s, {x, x - floor_of(n)}, 0, 2);
  }
  /// The diagonal x + y = n.
  void pass_falling_diagonal(double s, double n) {
    const std::int32_t x = floor_of(s * direction_.x);
    pass_diagonal(s, {x, floor_of(n) - 1 - x}, 3, 1);
  }
  /// From the western pixel of a square to its eastern one.
  void pass_diagonal(double s, Pixel square, std::size_t west, std::size_t east) {
    const double share = s * direction_.x - square.x;
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
    const double v = s * direction_.y;
    const Pixel square{floor_of(line), floor_of(v)};
    const bool is_south = v - square.y < 0.5;
    const double share = 2.0 * (is_south ? v - square.y : square.y + 1 - v);
    add_side(square, is_south ? 0 : 3, is_south ? 1 : 2, share, s,
             place(PixelPlane::torn_east, 0, square.x, is_south ? square.y : square.y + 1));
  }
  void pass_north_side(double s, double line) {
    const double u = s * direction_.x;
    const Pixel square{floor_of(u), floor_of(line)};
    const bool is_west = u - square.x < 0.5;
    const double share = 2.0 * (is_west ? u - square.x : square.x + 1 - u);
    add_side(square, is_west ? 0 : 1, is_west ? 3 : 2, share, s,
             place(PixelPlane::torn_north, 0, is_west ? square.x : square.x + 1, square.y));
  }
  void add_side(Pixel square, std::size_t first, std::size_t second, double share, double s, std::int32_t torn) {
    sides_.push_back({towards_middle(square, first, share, s), towards_middle(square, second, share, s), torn});
  }

  Point2d direction_;
  double pixel_m_, from_ = 0.0, to_ = 0.0;
  NearSegment segment_{};
  std::vector<PixelCrossing>& crossings_;
  std::vector<SideCrossing>& sides_;
};

/// Adds the segments beyond the window, of `step` pixels each, up to `end`; before the first, one that ends where they begin.
void add_far(Point2d direction, double pixel_m, std::int32_t step, double end, std::vector<FarSegment>& segments) {
  const auto floor_of = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
  for (double to = pixel_reach; to - 2.0 * step < end; to += step) {
    const double from = to - step, columns = to * std::abs(direction.x), rows = to * std::abs(direction.y);
    segments.push_back({floor_of(columns) + 1, floor_of(rows) + 1, floor_of(columns + 0.5) + 1, floor_of(rows + 0.5) + 1,
                        floor_of(std::min(from * direction.x, to * direction.x)) - 1,
                        floor_of(std::min(from * direction.y, to * direction.y)) - 1,
                        static_cast<float>(1.0 / (from * pixel_m))});
  }
}

PixelPath path_along(Point2d direction, double pixel_m) {
  // What is parallel to lines passes none of them
  const auto per = [](double rate) { return 1.0 / std::max(std::abs(rate), 1e-9); };
  PixelPath path{};
  path.cosine = direction.x;
  path.sine = direction.y;
  path.per_cosine = per(direction.x);
  path.per_sine = per(direction.y);
  path.north_per_column = std::llround(std::ldexp(direction.y * path.per_cosine, 32));
  path.east_per_row = std::llround(std::ldexp(direction.x * path.per_sine, 32));
  path.columns_per_metre = static_cast<float>(std::abs(direction.x) / pixel_m);
  path.rows_per_metre = static_cast<float>(std::abs(direction.y) / pixel_m);
  return path;
}

}  // namespace

PixelPaths::PixelPaths(std::span<const Point2d> directions, const PixelField& field) {
  std::vector<Counts> begins{counts()};
  for (const Point2d direction : directions) {
    add_near(direction, field.pixel_m());
    // As far as a segment may reach that begins above a pixel
    const double end = field.diagonal() + 3 * long_step;
    add_far(direction, field.pixel_m(), far_step, end, far_);
    add_far(direction, field.pixel_m(), long_step, end, long_far_);
    paths_.push_back(path_along(direction, field.pixel_m()));
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

void PixelPaths::add_near(Point2d direction, double pixel_m) {
  const auto first_crossing = static_cast<std::uint32_t>(crossings_.size()),
             first_side = static_cast<std::uint32_t>(sides_.size());
  PathMaker maker(direction, pixel_m, crossings_, sides_);
  for (std::int32_t from = 0; from < pixel_reach; from += far_step) {
    NearSegment segment = maker.between(from, from + far_step);
    segment.crossings_end -= first_crossing;
    segment.sides_end -= first_side;
    near_.push_back(segment);
  }
}

}  // namespace farlod
