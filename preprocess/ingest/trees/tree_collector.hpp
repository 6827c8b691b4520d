// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "city/tree.hpp"
#include "farlod/problem.hpp"
#include "ingest/trees/tree_sizes.hpp"

namespace farlod::ingest {

/// Gathers the trees of a file, and what is wrong with them: one entry of the report for each kind of problem.
class TreeCollector {
 public:
  TreeCollector(const std::string& source, double trunk_ratio) : sizes_(trunk_ratio) { result_.source = source; }

  [[nodiscard]] SourceCrs& crs() { return result_.crs; }
  /// `name`: of the tree, for messages. A place that is not a finite one is noted as a problem.
  void add(const std::string& name, Point2d place, const StatedSizes& sizes);
  /// A square of a plant cover, full of plants from the ground to a height.
  void add_square(Point2d centre, double edge_m, double height_m);
  void note(ProblemCode code, const std::string& name, const std::string& detail, Point2d place = {});
  /// Something that is no tree.
  void skip(const std::string& what, std::uint64_t count = 1) { result_.skipped[what] += count; }

  /// `count`: how many things were met. Throws InputError when none of them is a tree.
  [[nodiscard]] SourceTrees finish(std::uint64_t count, Report& report);

 private:
  using Finding = TreeSizes::Finding;
  void note_sizes();

  TreeSizes sizes_;
  std::map<ProblemCode, Finding> found_;
  SourceTrees result_;
};

}  // namespace farlod::ingest
