// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/obj/obj_mesh.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <iterator>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {
namespace {

struct Edge {
  std::uint32_t low, high;  ///< welded points
  std::uint32_t face;
  auto key() const { return std::pair((std::uint64_t{low} << 32) | high, face); }
  bool same_place(const Edge& other) const { return low == other.low && high == other.high; }
};

/// Edges with more faces are not used: they do not occur on buildings, and the number of pairs of faces grows with the square.
constexpr std::size_t most_neighbors_at_an_edge = 8;

bool is_finite(std::span<const Point3d> face) {
  return std::all_of(face.begin(), face.end(),
                     [](const Point3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

/// The point of a face that is farthest from a line.
struct Apex {
  Point3d p;
  double distance_m = 0.0;
};

/// The line runs through two points of the face.
Apex apex_over(std::span<const Point3d> face, const Point3d& a, const Point3d& b) {
  const Point3d along = b - a;
  const double length = norm(along);
  const auto at = [&](const Point3d& p) { return Apex{p, length > 0.0 ? norm(cross(along, p - a)) / length : norm(p - a)}; };
  Apex farthest = at(face.front());
  for (const Point3d& p : face.subspan(1))
    if (const Apex other = at(p); farthest.distance_m < other.distance_m) farthest = other;
  return farthest;
}

/// The largest distance by which rounding can move a point off the plane of three others. (λ) are its barycentric coordinates
/// with respect to them. Rounding moves each point by up to half a step along each axis, hence along the unit normal by up to
/// half a step times the 1-norm of the normal. The plane moves at the point by the movements of its corners with the weights λ.
double rounding_bound(const Point3d& unit_normal, const std::array<double, 3>& barycentric) {
  const double one_norm = std::abs(unit_normal.x) + std::abs(unit_normal.y) + std::abs(unit_normal.z);
  return 0.5 * coordinate_rounding_m * one_norm *
         (1.0 + std::abs(barycentric[0]) + std::abs(barycentric[1]) + std::abs(barycentric[2]));
}

bool are_coplanar(std::span<const Point3d> face_1, std::span<const Point3d> face_2, const Point3d& a, const Point3d& b) {
  Apex wide = apex_over(face_1, a, b), narrow = apex_over(face_2, a, b);
  if (wide.distance_m < narrow.distance_m) std::swap(wide, narrow);
  const Point3d u = b - a, v = wide.p - a, w = narrow.p - a;
  const Point3d n = cross(u, v);
  const double nn = dot(n, n);
  if (!(nn > 0.0)) return false;
  const double of_wide = dot(cross(u, w), n) / nn, of_b = dot(cross(w, v), n) / nn;
  const Point3d unit = normalized(n);
  return std::abs(dot(unit, w)) <= rounding_bound(unit, {1.0 - of_b - of_wide, of_b, of_wide});
}

/// The thickness of a face: its extent perpendicular to its longest edge.
double thickness(std::span<const Point3d> face) {
  if (face.empty()) return 0.0;
  double longest = 0.0;
  Point3d begin, end;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Point3d &a = face[i], &b = face[(i + 1) % face.size()];
    const double length = norm(b - a);
    if (length < longest) continue;
    longest = length;
    begin = a;
    end = b;
  }
  return apex_over(face, begin, end).distance_m;
}

/// A triangle thinner than this has no reliable normal. Rounding moves each coordinate by up to half a step, hence a point by up
/// to √3/2 steps. The two points that span the thickness can move in opposite directions.
constexpr double thinnest_face_m = 1.7320508075688772 * coordinate_rounding_m;

class PlanarFaces {
 public:
  explicit PlanarFaces(const FaceCorners& mesh) : mesh_(mesh), sets_(mesh.face_count()), point_of_(weld(mesh.points)) {
    list_edges();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) thin_.push_back(thickness(mesh.face(f)) <= thinnest_face_m);
    for_each_pair([&](const Edge& e, const Edge& other) { join_if_coplanar(e, other); });
    // Thin faces join last, and each joins one neighbor, so that none connects two planar faces
    for_each_pair([&](const Edge& e, const Edge& other) { join_if_thin(e.face, other.face); });
  }

  std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number_of_set(mesh_.face_count(), unnumbered), numbers;
    std::uint32_t next = 0;
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      std::uint32_t& number = number_of_set[sets_.find(f)];
      if (number == unnumbered) number = next++;
      numbers.push_back(number);
    }
    return numbers;
  }

 private:
  static constexpr std::uint32_t unnumbered = 0xFFFFFFFF;

  void list_edges() {
    a_point_.resize(mesh_.points.size());
    for (std::uint32_t c = 0; c < mesh_.points.size(); ++c) a_point_[point_of_[c]] = mesh_.points[c];
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      if (!is_finite(mesh_.face(f))) continue;  // without a plane it gets no neighbors
      const std::uint32_t begin = mesh_.first_corner[f], end = mesh_.first_corner[f + 1];
      for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t p = point_of_[c], q = point_of_[c + 1 < end ? c + 1 : begin];
        if (p != q) edges_.push_back({std::min(p, q), std::max(p, q), f});
      }
    }
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  }

  template <class Use>
  void for_each_pair(Use use) {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t j = i + 1; j < edges_.size() && j <= i + most_neighbors_at_an_edge && edges_[i].same_place(edges_[j]); ++j)
        if (edges_[i].face != edges_[j].face) use(edges_[i], edges_[j]);
  }

  void join_if_coplanar(const Edge& e, const Edge& other) {
    if (thin_[e.face] || thin_[other.face]) return;
    if (are_coplanar(mesh_.face(e.face), mesh_.face(other.face), a_point_[e.low], a_point_[e.high]))
      sets_.join(e.face, other.face);
  }

  void join_if_thin(std::uint32_t f, std::uint32_t g) {
    if (!thin_[f] && !thin_[g]) return;
    const std::uint32_t joiner = thin_[f] ? f : g;
    sets_.join(f, g);
    thin_[joiner] = false;
  }

  const FaceCorners& mesh_;
  DisjointSets sets_;
  std::vector<std::uint32_t> point_of_;
  std::vector<Point3d> a_point_;
  std::vector<Edge> edges_;
  std::vector<bool> thin_;
};

/// What std::weak_order says, sooner for numbers. Unlike `<`, it also orders NaN.
std::weak_ordering order_of(double x, double y) {
  if (x < y) return std::weak_ordering::less;
  if (x > y) return std::weak_ordering::greater;
  return x == y ? std::weak_ordering::equivalent : std::weak_order(x, y);
}

}  // namespace

std::vector<std::uint32_t> weld(std::span<const Point3d> points) {
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const Point3d &p = points[i], &q = points[j];
    if (const auto x = order_of(p.x, q.x); x != 0) return x < 0;
    if (const auto y = order_of(p.y, q.y); y != 0) return y < 0;
    return order_of(p.z, q.z) < 0;
  };
  std::vector<std::uint32_t> order(points.size()), number(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), less);
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && less(order[k - 1], order[k])) ++next;
    number[order[k]] = next;
  }
  return number;
}

std::vector<std::uint32_t> number_planar_faces(const FaceCorners& mesh) { return PlanarFaces(mesh).numbers(); }

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view take_word(std::string_view& rest) {
  const auto begin = std::find_if_not(rest.begin(), rest.end(), is_blank), end = std::find_if(begin, rest.end(), is_blank);
  const std::string_view word(begin, end);
  rest = std::string_view(end, rest.end());
  return word;
}

/// Whether the last line of a text that ends before a line break is continued.
bool is_continued(std::string_view text) {
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text.ends_with('\\');
}

/// One past the last line break from `begin` on whose line is not continued; 0 where there is none.
std::size_t end_of_last_line(std::string_view text, std::size_t begin) {
  for (std::size_t end = text.size(); end > begin; --end)
    if (text[end - 1] == '\n' && !is_continued(text.substr(0, end - 1))) return end;
  return 0;
}

/// NaN for a word that is not a number. The rings that use it are then reported as unreadable.
double coordinate_from(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

class ObjScanner {
 public:
  ObjSegment scan(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      take_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!continued_.empty()) read(continued_);
    return std::move(segment_);
  }

 private:
  void take_line(std::string_view line) {
    ++segment_.lines;
    line = trimmed(line);
    if (line.ends_with('\\')) {
      continued_.append(line.substr(0, line.size() - 1)).append(" ");
    } else if (continued_.empty()) {
      read(line);
    } else {
      const std::string whole = std::exchange(continued_, {}).append(line);
      read(whole);
    }
  }

  void read(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = take_word(line);
    if (keyword == "v")
      read_vertex(line);
    else if (keyword == "f")
      read_face(line);
    else if (keyword == "g")
      group_ = add_name(line, mesh_.groups);
    else if (keyword == "o")
      object_ = add_name(line, mesh_.objects);
    else if (keyword == "usemtl")
      material_ = add_name(line, mesh_.materials);
    else if (keyword == "l" || keyword == "p" || keyword == "curv" || keyword == "curv2" || keyword == "surf")
      if (mesh_.unread_elements++ == 0) mesh_.first_unread_line = segment_.lines;
  }

  void read_vertex(std::string_view line) {
    Point3d p;
    for (double* coordinate : {&p.x, &p.y, &p.z}) *coordinate = coordinate_from(take_word(line));
    mesh_.vertices.push_back(p);
  }

  void read_face(std::string_view line) {
    ObjFace face{mesh_.corners.size(), 0, group_, object_, material_, segment_.lines};
    const std::size_t relative_before = segment_.relative_corners.size();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const std::string_view number = word.substr(0, word.find('/'));
      std::int64_t index = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
      if (error != std::errc() || end != number.data() + number.size()) {
        mesh_.malformed_lines.push_back(segment_.lines);
        mesh_.corners.resize(face.first_corner);
        segment_.relative_corners.resize(relative_before);
        return;
      }
      if (index < 0) segment_.relative_corners.push_back(mesh_.corners.size());
      mesh_.corners.push_back(index < 0 ? static_cast<std::int64_t>(mesh_.vertices.size()) + index : index - 1);
      ++face.corner_count;
    }
    mesh_.faces.push_back(face);
  }

  static std::uint32_t add_name(std::string_view line, std::vector<std::string>& names) {
    names.emplace_back(trimmed(line));
    return static_cast<std::uint32_t>(names.size() - 1);
  }

  ObjSegment segment_;
  ObjMesh& mesh_ = segment_.mesh;
  std::uint32_t group_ = 0, object_ = 0, material_ = 0;
  std::string continued_;
};

/// Appends names, but for the first: faces of row 0 belong to the last statement of the segments before.
void append_names(std::vector<std::string>& next, std::vector<std::string>& names) {
  names.insert(names.end(), std::move_iterator(next.begin() + 1), std::move_iterator(next.end()));
}

}  // namespace

bool ObjSegmentCutter::read_on() {
  const std::size_t known = ahead_.size();
  ahead_.resize(known + segment_bytes_);
  text_.read(ahead_.data() + known, static_cast<std::streamsize>(segment_bytes_));
  ahead_.resize(known + static_cast<std::size_t>(text_.gcount()));
  return ahead_.size() > known;
}

std::optional<std::string> ObjSegmentCutter::next() {
  for (std::size_t known = ahead_.size(); read_on(); known = ahead_.size()) {
    if (is_first_ && ahead_.size() < byte_order_mark.size()) continue;
    if (std::exchange(is_first_, false) && ahead_.starts_with(byte_order_mark)) ahead_.erase(0, byte_order_mark.size());
    // What was read before has no end of a line: it was looked for there
    const std::size_t end = end_of_last_line(ahead_, known);
    if (end == 0) continue;
    std::string rest = ahead_.substr(end);
    ahead_.resize(end);
    return std::exchange(ahead_, std::move(rest));
  }
  return ahead_.empty() ? std::nullopt : std::optional(std::exchange(ahead_, {}));
}

namespace {

ObjSegment scan_obj_segment(std::string_view text) { return ObjScanner().scan(text); }

}  // namespace

void append(ObjSegment&& next, std::uint64_t lines_before, ObjMesh& mesh) {
  const auto first_vertex = static_cast<std::int64_t>(mesh.vertices.size());
  const std::uint64_t first_corner = mesh.corners.size();
  const auto last_group = static_cast<std::uint32_t>(mesh.groups.size() - 1),
             last_object = static_cast<std::uint32_t>(mesh.objects.size() - 1),
             last_material = static_cast<std::uint32_t>(mesh.materials.size() - 1);
  for (const std::size_t corner : next.relative_corners) next.mesh.corners[corner] += first_vertex;
  for (ObjFace& face : next.mesh.faces) {
    face.first_corner += first_corner;
    face.group += last_group;
    face.object += last_object;
    face.material += last_material;
    face.line += lines_before;
  }
  mesh.vertices.append(next.mesh.vertices);
  mesh.corners.append(next.mesh.corners);
  mesh.faces.append(next.mesh.faces);
  append_names(next.mesh.groups, mesh.groups);
  append_names(next.mesh.objects, mesh.objects);
  append_names(next.mesh.materials, mesh.materials);
  for (const std::uint64_t line : next.mesh.malformed_lines) mesh.malformed_lines.push_back(lines_before + line);
  if (mesh.unread_elements == 0 && next.mesh.unread_elements > 0)
    mesh.first_unread_line = lines_before + next.mesh.first_unread_line;
  mesh.unread_elements += next.mesh.unread_elements;
}

ObjMesh scan_obj(std::istream& text, const std::stop_token& stop, std::size_t segment_bytes) {
  /// A segment that is being parsed, or waits for its turn.
  struct InFlight {
    std::string text;
    ObjSegment segment;
  };
  std::vector<InFlight> in_flight(places_for_threads());
  ObjSegmentCutter cutter(text, segment_bytes);
  ObjMesh mesh;
  std::uint64_t lines = 0;
  const auto cut = [&](std::size_t place) {
    throw_if_cancelled(stop);
    std::optional<std::string> next = cutter.next();
    if (next) in_flight[place].text = std::move(*next);
    return next.has_value();
  };
  const auto scan = [&](std::size_t place) { in_flight[place].segment = scan_obj_segment(in_flight[place].text); };
  const auto append_one = [&](std::size_t place) {
    InFlight done = std::exchange(in_flight[place], {});
    const std::uint64_t lines_before = std::exchange(lines, lines + done.segment.lines);
    append(std::move(done.segment), lines_before, mesh);
  };
  run_in_order(in_flight.size(), {cut, scan, append_one});
  return mesh;
}

}  // namespace farlod::ingest
