// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ingest/citygml/gml_surfaces.hpp"

namespace farlod::ingest {

/// How much of a file may be borrowed by reference: a wall that two buildings share is there twice, and a small file whose
/// many buildings all refer to one large thing would have no end.
class Borrowing {
 public:
  /// Several times what there is to borrow, and some millions of points for prototypes that are placed.
  explicit Borrowing(const GmlSurfaces& foreign);

  /// False when that many points are no longer to be had; then nothing is, from here on.
  [[nodiscard]] bool take(std::size_t points);
  [[nodiscard]] std::size_t refusals() const { return refusals_; }
  [[nodiscard]] std::size_t most_points() const { return most_points_; }

 private:
  std::size_t most_points_ = 0, left_ = 0, refusals_ = 0;
};

struct ResolvedPolygon {
  const GmlPolygon* polygon = nullptr;
  bool is_reversed = false;
};

/// Follows references: from members to the polygons that they stand for, looked up among `own`, then among `foreign`
/// surfaces. What an id stands for is gone through once in the life of a walk, however often it is referred to. So a walk
/// takes time in proportion to what there is, and circles and ever-doubling references end.
class ReferenceWalk {
 public:
  ReferenceWalk(const GmlSurfaces& own, const GmlSurfaces& foreign, Borrowing& borrowing)
      : own_(own), foreign_(foreign), borrowing_(borrowing) {}

  /// Gives each polygon that the member of `own` stands for to `visit`, once in the life of the walk.
  void each(const GmlMember& member, const std::function<void(const ResolvedPolygon&)>& visit);
  /// Whether the member stands for a polygon of which `is_it` holds. A walk must always be asked the same question.
  [[nodiscard]] bool any(const GmlMember& member, const std::function<bool(const GmlPolygon&)>& is_it);
  /// References met that lead to nothing, as written in the file.
  [[nodiscard]] const std::vector<std::string>& dangling() const { return dangling_; }

 private:
  using IsEnough = std::function<bool(const ResolvedPolygon&)>;
  /// An id that is being gone through.
  struct Level {
    const GmlSurfaces* home;
    std::size_t next, end;
    bool is_reversed;
    bool* ends_walks;  ///< of the id: something behind it was enough
  };

  /// True when something behind the member is enough.
  bool walk(const GmlMember& member, const IsEnough& is_enough);
  [[nodiscard]] bool step(const GmlSurfaces& home, const GmlMember& member, bool is_reversed, const IsEnough& is_enough);
  /// True when the id is known to lead to something that is enough.
  [[nodiscard]] bool enter(const std::string& href, bool is_reversed);

  const GmlSurfaces &own_, &foreign_;
  Borrowing& borrowing_;
  std::unordered_map<std::string, bool> entered_;  ///< ids, and whether something behind them was enough
  std::unordered_set<const GmlPolygon*> reached_;
  std::vector<Level> levels_;
  std::vector<std::string> dangling_;
};

}  // namespace farlod::ingest
