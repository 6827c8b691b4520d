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
