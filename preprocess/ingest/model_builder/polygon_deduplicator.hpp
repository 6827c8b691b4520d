// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// When two polygons are the same.
enum class SamePolygon {
  corners,  ///< they have the same corners, in any order: files give one surface twice, which may then face either way
  rings     ///< their rings have the same corners in the same cyclic order: the two sides of a wall differ
};

/// Finds polygons that occur again in the same part of a building. Stores a hash and a number for each polygon. The polygons
/// themselves stay with the caller, who looks them up by number, so that a large mesh is not held twice.
class PolygonDeduplicator {
 public:
  /// The rings of the polygon that was inserted with `number`.
  using PolygonAt = std::function<std::vector<std::span<const Point3d>>(std::uint64_t number)>;

  explicit PolygonDeduplicator(SamePolygon criterion) : criterion_(criterion) {}

  /// The number of the polygon of this part that is the same, if one was inserted.
  [[nodiscard]] std::optional<std::uint64_t> find(const Rings& rings, std::uint16_t part, const PolygonAt& polygon_at) const;
  /// As `find`; inserts the polygon as `number` where there is none.
  std::optional<std::uint64_t> find_or_insert(const Rings& rings, std::uint16_t part, std::uint64_t number,
                                              const PolygonAt& polygon_at);
  void clear() { entries_by_hash_.clear(); }

 private:
  struct Entry {
    std::uint64_t number = 0;
    std::uint16_t part = 0;
  };

  [[nodiscard]] std::uint64_t hash_of(const Rings& rings) const;
  [[nodiscard]] std::optional<std::uint64_t> find_hashed(std::uint64_t hash, const Rings& rings, std::uint16_t part,
                                                         const PolygonAt& polygon_at) const;

  SamePolygon criterion_;
  std::unordered_multimap<std::uint64_t, Entry> entries_by_hash_;
};

/// The rings of a polygon as PolygonAt returns them.
[[nodiscard]] std::vector<std::span<const Point3d>> spans_of(const Rings& rings);

}  // namespace farlod::ingest
