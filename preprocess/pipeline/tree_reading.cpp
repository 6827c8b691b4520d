// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/tree_reading.hpp"

#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "georeference/canopy_reader.hpp"
#include "georeference/tree_places.hpp"
#include "ingest/trees/tree_reader.hpp"
#include "pipeline/city_reading.hpp"

namespace farlod::pipeline {
namespace {

class TreeReading {
 public:
  TreeReading(const StageSettings& settings, const Georeference& georeference, Report& report, const std::stop_token& stop)
      : settings_(settings), georeference_(georeference), report_(report), stop_(stop) {}

  ReadTrees run(const Grid& grid) {
    const auto& files = settings_.trees.files;
    if (files.size() > std::numeric_limits<decltype(Tree::source)>::max())
      throw InputError("There are " + std::to_string(files.size()) + " inventories of trees: put them together into fewer.");
    for (const std::filesystem::path& file : files) files.size() == 1 ? take(read(file)) : take_if_usable(file);
    if (!files.empty() && read_.trees.sources.empty())
      throw InputError("None of the " + std::to_string(files.size()) +
                       " inventories of trees can be used. The first problem: " + first_failure_);
    if (settings_.trees.canopy) read_canopy(grid);
    return std::move(read_);
  }

 private:
  [[nodiscard]] SourceTrees read(const std::filesystem::path& file) const {
    SourceTrees trees = ingest::read_trees(file, settings_.trees, report_, stop_);
    georeference::locate_trees(trees, settings_.georeference.crs, georeference_, report_);
    return trees;
  }

  void take(SourceTrees trees) {
    const auto number = static_cast<std::uint16_t>(read_.trees.sources.size());
    read_.trees.sources.push_back(trees.source);
    for (const auto& [what, count] : trees.skipped) read_.skipped[what] += count;
    for (Tree& tree : trees.trees) tree.source = number;
    if (read_.trees.trees.empty())
      read_.trees.trees = std::move(trees.trees);
    else
      read_.trees.trees.append({trees.trees.begin(), trees.trees.end()});
  }

  void take_if_usable(const std::filesystem::path& file) {
    std::error_code unread;
    const bool is_empty = std::filesystem::is_regular_file(file, unread) && std::filesystem::file_size(file, unread) == 0;
    try {
      take(read(file));
    } catch (const InputError& error) {
      if (first_failure_.empty()) first_failure_ = error.what();
      report_.add({is_empty ? ProblemCode::empty_file : ProblemCode::unusable_file, file.string(), "the whole file",
                   is_empty ? "0 bytes: was the download cut short?" : error.what()});
    }
  }

  void read_canopy(const Grid& grid) {
    auto [canopy, notes] = georeference::read_canopy({*settings_.trees.canopy, settings_.trees.trunks},
                                                     settings_.georeference.crs, georeference_, city_outline(grid), stop_);
    read_.trees.canopy = std::move(canopy);
    read_.notes.insert(read_.notes.end(), notes.begin(), notes.end());
  }

  const StageSettings& settings_;
  const Georeference& georeference_;
  Report& report_;
  const std::stop_token& stop_;
  std::string first_failure_;
  ReadTrees read_;
};

}  // namespace

void require_trees_exist(const TreeSettings& settings) {
  std::vector<std::filesystem::path> files = settings.files;
  if (settings.canopy) files.push_back(*settings.canopy);
  if (settings.trunks) files.push_back(*settings.trunks);
  std::error_code unread;
  for (const std::filesystem::path& file : files)
    if (!std::filesystem::exists(file, unread)) throw InputError(file.string() + " does not exist. Check the path.");
}

ReadTrees read_trees(const StageSettings& settings, const Georeference& georeference, const Grid& grid, Report& report,
                     const std::stop_token& stop) {
  return TreeReading(settings, georeference, report, stop).run(grid);
}

}  // namespace farlod::pipeline
