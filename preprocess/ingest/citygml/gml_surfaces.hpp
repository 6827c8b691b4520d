// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// Reads the numbers of a text that comes in pieces. A piece may end within a number. Stores one word, never the whole text.
class NumberScanner {
 public:
  /// Calls `sink` with each complete number, and with NaN for each word that is not a number.
  template <class Sink>
  void take(std::string_view piece, Sink&& sink) {
    const char *p = piece.data(), *const end = p + piece.size();
    if (!begun_word_.empty()) p = complete_word(p, end, sink);
    while (p != end) {
      if (is_separator(*p)) {
        ++p;
        continue;
      }
      double value = 0.0;
      const auto [stop, error] = std::from_chars(p, end, value);
      if (error == std::errc() && stop != end && is_separator(*stop)) {
        sink(value);
        p = stop;
      } else {
        p = complete_word(p, end, sink);
      }
    }
  }

  /// Ends the text, and with it the last word.
  template <class Sink>
  void end(Sink&& sink) {
    if (begun_word_.empty()) return;
    sink(number_from(begun_word_));
    begun_word_.clear();
  }

 private:
  /// A longer word is not a number and is not kept as a whole.
  static constexpr std::size_t longest_word = 1024;

  static bool is_separator(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ','; }

  /// Continues the last word of the piece before, and calls `sink` if the word ends within this piece.
  template <class Sink>
  const char* complete_word(const char* p, const char* end, Sink&& sink) {
    for (; p != end && !is_separator(*p); ++p)
      if (begun_word_.size() <= longest_word) begun_word_.push_back(*p);
    if (p != end) this->end(sink);
    return p;
  }

  static double number_from(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc() && stop == word.data() + word.size() && word.size() <= longest_word;
    return is_number ? value : std::numeric_limits<double>::quiet_NaN();
  }

  std::string begun_word_;
};

/// The longest ring that is read, in points. The limit keeps a single list from filling the memory.
inline constexpr std::size_t most_points_of_ring = std::size_t{1} << 20;

struct GmlPolygon {
  std::string id;
  Rings rings;
  bool has_curves = false;   ///< bounded by a curve that is not a LinearRing
  bool is_too_long = false;  ///< a ring had more than most_points_of_ring points, and was dropped

  /// The points that a visit counts: those of its rings, and one more.
  [[nodiscard]] std::size_t point_count() const {
    std::size_t points = 1;
    for (const Ring& ring : rings) points += ring.size();
    return points;
  }
};

/// A member of a surface or solid: a polygon, or a reference to an object with polygons.
struct GmlMember {
  std::optional<std::size_t> polygon;  ///< row in GmlSurfaces::polygons
  std::string href;                    ///< where there is no polygon
  bool is_reversed = false;
  std::uint32_t use = 0;  ///< the number that the caller gave to begin_use
};

/// The members [begin, end) of the object with a gml:id, and whether an OrientableSurface around it reverses them.
struct GmlRange {
  std::size_t begin = 0, end = 0;
  bool was_reversed = false;
};

/// The surfaces of one building (or of those that other buildings refer to), in the order of the file.
struct GmlSurfaces {
  std::vector<GmlPolygon> polygons;
  std::vector<GmlMember> members;
  std::unordered_map<std::string, GmlRange> ranges;
};

/// Reads surfaces and solids of GML 3.1 and 3.2, and the rings of GML 2, element by element. Neither the XML syntax nor buildings
/// are its concern.
class GmlSurfaceReader {
 public:
  enum class Answer { entered, skip, unsupported };

  explicit GmlSurfaceReader(GmlSurfaces& surfaces) : surfaces_(surfaces) {}

  /// All following surfaces get the use `use`.
  void begin_use(std::uint32_t use);
  /// Begins an element. After `skip` and `unsupported`, the caller passes neither the content of the element nor its end.
  [[nodiscard]] Answer start(const XmlElement& element);
  void end(std::string_view name);
  void text(std::string_view piece);
  void add_reference(std::string_view href);

 private:
  struct Open {
    std::string id;
    GmlRange range;
    bool reverses = false;
  };

  void start_polygon(const XmlElement& element);
  void start_aggregate(const XmlElement& element);
  [[nodiscard]] Answer start_property(const XmlElement& element);
  [[nodiscard]] Answer start_in_polygon(const XmlElement& element);
  void end_open();
  void take_number(double number);
  void take_coordinates(std::string_view name);
  void note_dimension(std::string_view srs_dimension);

  GmlSurfaces& surfaces_;
  std::vector<Open> open_;
  bool is_reversed_ = false;
  bool in_polygon_ = false, in_ring_ = false, in_coordinates_ = false;
  std::uint32_t use_ = 0;
  std::size_t dimension_ = 3;
  NumberScanner scanner_;
  std::vector<double> numbers_;  ///< of the current list
};

/// Limits the points that a file may add by reference. A wall that two buildings share is added twice. A small file could
/// otherwise fill the memory, if its many buildings all referred to one large object.
class ReferenceBudget {
 public:
  /// The limit is several times the points that can be referred to, plus some millions for placed prototypes.
  explicit ReferenceBudget(const GmlSurfaces& foreign);

  /// Takes some points from what is left. Returns false when too few are left; then each later call returns false, too.
  [[nodiscard]] bool take(std::size_t points);
  /// Takes what another budget, which began with the same limit, has given. Returns false when it refused something, or when the
  /// two have given more than one would have.
  [[nodiscard]] bool append(const ReferenceBudget& other);
  [[nodiscard]] std::size_t refusals() const { return refusals_; }
  [[nodiscard]] std::size_t most_points() const { return most_points_; }

 private:
  std::size_t most_points_ = 0, left_ = 0, refusals_ = 0;
};

struct ResolvedPolygon {
  const GmlPolygon* polygon = nullptr;
  bool is_reversed = false;
  bool is_foreign = false;  ///< not of the building
};

/// Follows the references of members to polygons: first among the `own`, then among the `foreign` surfaces. A walk visits the
/// members of an id once, however often it is referred to. Its time is therefore proportional to the number of surfaces, even if
/// references form circles or double at each step.
class ReferenceWalk {
 public:
  ReferenceWalk(const GmlSurfaces& own, const GmlSurfaces& foreign, ReferenceBudget& budget)
      : own_(own), foreign_(foreign), budget_(budget) {}

  /// Calls `visit` with each polygon of a member of `own`, at most once for each polygon in the life of the walk.
  void each(const GmlMember& member, const std::function<void(const ResolvedPolygon&)>& visit);
  /// Whether a member has a polygon for which `is_it` holds. All calls for one walk must pass the same condition.
  [[nodiscard]] bool any(const GmlMember& member, const std::function<bool(const GmlPolygon&)>& is_it);
  /// The references without target that were met, as written in the file.
  [[nodiscard]] const std::vector<std::string>& dangling() const { return dangling_; }

 private:
  using IsEnough = std::function<bool(const ResolvedPolygon&)>;
  /// An id whose members are being visited.
  struct Level {
    const GmlSurfaces* home;
    std::size_t next, end;
    bool is_reversed;
    bool* ends_walks;  ///< the entry of the id in `entered_`
  };

  /// Whether the member leads to a polygon for which `is_enough` holds; the walk ends at the first one.
  bool walk(const GmlMember& member, const IsEnough& is_enough);
  [[nodiscard]] bool step(const GmlSurfaces& home, const GmlMember& member, bool is_reversed, const IsEnough& is_enough);
  /// Begins to visit an id. Returns whether an earlier visit of it found a polygon that was enough.
  [[nodiscard]] bool enter(const std::string& href, bool is_reversed);

  const GmlSurfaces &own_, &foreign_;
  ReferenceBudget& budget_;
  std::unordered_map<std::string, bool> entered_;  ///< visited ids, and whether they led to a polygon that was enough
  std::unordered_set<const GmlPolygon*> reached_;
  std::vector<Level> levels_;
  std::vector<std::string> dangling_;
};

}  // namespace farlod::ingest
