// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/tree_reading.hpp"

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/grid_outline.hpp"
#include "farlod/error.hpp"
#include "georeference/canopy_reader.hpp"
#include "georeference/tree_places.hpp"
#include "ingest/trees/tree_reader.hpp"

namespace farlod::pipeline {
namespace {

/// Inventories that cannot be used are reported and left out where there are several; of one alone the reason is thrown.
class Usable {
 public:
  Usable(std::size_t count, Report& report) : count_(count), report_(report) {}

  void take(const std::filesystem::path& file, const std::function<void()>& work) {
    try {
      work();
      ++taken_;
    } catch (const InputError& error) {
      if (count_ == 1) throw;
      if (first_failure_.empty()) first_failure_ = error.what();
      std::error_code unread;
      const bool is_empty = std::filesystem::is_regular_file(file, unread) && std::filesystem::file_size(file, unread) == 0;
      report_.add({is_empty ? ProblemCode::empty_file : ProblemCode::unusable_file, file.string(), "the whole file",
                   is_empty ? "0 bytes: was the download cut short?" : error.what()});
    }
  }
  void require_one() const {
    if (count_ > 0 && taken_ == 0)
      throw InputError("None of the " + std::to_string(count_) +
                       " inventories of trees can be used. The first problem: " + first_failure_);
  }

 private:
  std::size_t count_, taken_ = 0;
  Report& report_;
  std::string first_failure_;
};

void append(ReadTrees& read, SourceTrees source) {
  const auto number = static_cast<std::uint16_t>(read.trees.sources.size());
  read.trees.sources.push_back(source.source);
  for (const auto& [what, count] : source.skipped) read.skipped[what] += count;
  for (Tree& tree : source.trees) tree.source = number;
  if (read.trees.trees.empty())
    read.trees.trees = std::move(source.trees);
  else
    read.trees.trees.append({source.trees.begin(), source.trees.end()});
}

std::optional<georeference::CanopyFiles> canopy_files(const TreeSettings& settings) {
  if (!settings.canopy) return std::nullopt;
  return georeference::CanopyFiles{*settings.canopy, settings.trunks};
}

void require_files_exist(const TreeSettings& settings) {
  std::vector<std::filesystem::path> files = settings.files;
  if (settings.canopy) files.push_back(*settings.canopy);
  if (settings.trunks) files.push_back(*settings.trunks);
  std::error_code unread;
  for (const std::filesystem::path& file : files)
    if (!std::filesystem::exists(file, unread)) throw InputError(file.string() + " does not exist. Check the path.");
}

}  // namespace

std::vector<SourceTrees> read_inventories(const TreeSettings& settings, Report& report, const std::stop_token& stop) {
  require_files_exist(settings);
  if (settings.files.size() > std::numeric_limits<decltype(Tree::source)>::max())
    throw InputError("There are " + std::to_string(settings.files.size()) +
                     " inventories of trees: put them together into fewer.");
  if (const auto canopy = canopy_files(settings)) georeference::require_canopy(*canopy);
  std::vector<SourceTrees> inventories;
  Usable usable(settings.files.size(), report);
  for (const std::filesystem::path& file : settings.files)
    usable.take(file, [&] { inventories.push_back(ingest::read_trees(file, settings, report, stop)); });
  usable.require_one();
  return inventories;
}

ReadTrees bring_to_city(std::vector<SourceTrees> inventories, const StageSettings& settings, const Georeference& georeference,
                        const Grid& grid, Report& report, const std::stop_token& stop) {
  const std::string& fallback_crs = settings.georeference.crs;
  ReadTrees read;
  Usable usable(inventories.size(), report);
  for (SourceTrees& inventory : inventories) {
    throw_if_cancelled(stop);
    usable.take(inventory.source, [&] {
      georeference::locate_trees(inventory, fallback_crs, georeference, report);
      append(read, std::move(inventory));
    });
  }
  usable.require_one();
  if (const auto files = canopy_files(settings.trees)) {
    auto [canopy, notes] = georeference::read_canopy(*files, fallback_crs, georeference, outline_city(grid), stop);
    read.trees.canopy = std::move(canopy);
    read.notes.insert(read.notes.end(), notes.begin(), notes.end());
  }
  return read;
}

}  // namespace farlod::pipeline
