// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "results/city/surface_numbering.hpp"
#include "results/city/xml_text.hpp"

namespace farlod {

/// The numbers of a text; NaN for each word that is none.
[[nodiscard]] std::vector<double> numbers_in(std::string_view text);

struct CityGmlPolygon {
  FileRings rings;
  bool has_number = true;  ///< false where farlod-pack leaves it out: it is bounded by a curve, or a ring is too long
};

/// A member of a surface or solid: a polygon, or a reference to what has an id.
struct CityGmlMember {
  std::optional<std::size_t> polygon;  ///< in CityGmlSurfaces::polygons
  std::string href;                    ///< where there is no polygon
  std::size_t use = 0;                 ///< the number that was given to begin_use
};

/// The members of the object with an id.
struct CityGmlRange {
  std::size_t begin = 0, end = 0;
};

/// The surfaces of a building, or those that other buildings refer to, in the order of the file.
struct CityGmlSurfaces {
  std::vector<CityGmlPolygon> polygons;
  std::vector<CityGmlMember> members;
  std::unordered_map<std::string, CityGmlRange> ranges;
};

/// Reads surfaces and solids of GML, element by element.
class CityGmlSurfaceReader {
 public:
  explicit CityGmlSurfaceReader(CityGmlSurfaces& surfaces) : surfaces_(surfaces) {}

  /// All following surfaces get the use `use`.
  void begin_use(std::size_t use);
  void add_reference(std::string_view href);
  /// Begins an element. After false, the caller passes neither what is inside the element nor its end.
  [[nodiscard]] bool start(const XmlTag& tag);
  void end();
  void text(std::string_view piece);

 private:
  enum class Level { property, object, polygon, ring, coordinates };
  struct Open {
    Level level = Level::property;
    std::string id;  ///< of an object or polygon
    std::size_t begin = 0;
  };

  [[nodiscard]] bool start_in_polygon(const XmlTag& tag);
  void open_object(const XmlTag& tag, Level level);
  void take_coordinates();

  CityGmlSurfaces& surfaces_;
  std::vector<Open> open_;
  bool in_polygon_ = false, in_ring_ = false, is_one_position_ = false;
  std::size_t use_ = 0, dimension_ = 3;
  std::string coordinates_;
};

struct ReachedPolygon {
  const CityGmlPolygon* polygon = nullptr;
  bool is_foreign = false;  ///< it is outside of the building
};

/// Follows the references of members to polygons, first among the `own`, then among the `foreign` surfaces. The members of an id
/// are visited once in a walk, so that its time is in proportion to the surfaces, even where references form circles.
class CityGmlWalk {
 public:
  /// `foreign_left`: how many foreign surfaces may still be visited; the walk counts it down, and visits none when it is 0.
  CityGmlWalk(const CityGmlSurfaces& own, const CityGmlSurfaces& foreign, std::size_t& foreign_left)
      : own_(own), foreign_(foreign), foreign_left_(foreign_left) {}

  /// Calls `visit` with each polygon of a member that this walk has not reached before.
  void each(const CityGmlMember& member, const std::function<void(const ReachedPolygon&)>& visit);
  /// Whether `is_it` holds for a polygon of a member. All calls for one walk pass the same condition.
  [[nodiscard]] bool any(const CityGmlMember& member, const std::function<bool(const CityGmlPolygon&)>& is_it);
  /// The references that led to nothing.
  [[nodiscard]] const std::vector<std::string>& dangling() const { return dangling_; }

 private:
  /// An id whose members are being visited.
  struct Level {
    const CityGmlSurfaces* home;
    std::size_t next, end;
    bool* is_found;  ///< the entry of the id in `entered_`
  };
  using IsEnough = std::function<bool(const ReachedPolygon&)>;

  [[nodiscard]] bool walk(const CityGmlMember& member, const IsEnough& is_enough);
  [[nodiscard]] bool step(const CityGmlSurfaces& home, const CityGmlMember& member, const IsEnough& is_enough);
  [[nodiscard]] bool enter(const std::string& href);

  const CityGmlSurfaces &own_, &foreign_;
  std::size_t& foreign_left_;
  std::unordered_map<std::string, bool> entered_;  ///< visited ids, and whether what was looked for is there
  std::unordered_set<const CityGmlPolygon*> reached_;
  std::vector<Level> levels_;
  std::vector<std::string> dangling_;
};

}  // namespace farlod
