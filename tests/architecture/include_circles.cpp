// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/include_circles.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace farlod {
namespace {

/// The folders that a folder points to, and the first include that makes it do so.
using FolderGraph = std::map<std::string, std::map<std::string, std::string>>;

std::string folder_of(std::string_view path) { return std::string(path.substr(0, path.rfind('/'))); }

FolderGraph folder_graph(const std::vector<SourceFile>& tree, std::string_view side) {
  std::set<std::string> paths;
  for (const SourceFile& file : tree) paths.insert(file.path);
  FolderGraph graph;
  for (const SourceFile& file : tree) {
    if (!is_cpp(file) || !file.path.starts_with(side)) continue;
    const std::string from = folder_of(file.path);
    for (const Include& include : includes_of(file)) {
      const std::string target = std::string(side).append(include.target);
      if (!include.quoted || !paths.contains(target) || folder_of(target) == from) continue;
      graph[from].try_emplace(folder_of(target), file.path + " includes " + include.target);
    }
  }
  return graph;
}

/// Depth-first search: a folder that leads back to one on the way closes a circle.
class CircleSearch {
 public:
  explicit CircleSearch(const FolderGraph& graph) : graph_(graph) {
    for (const auto& [folder, targets] : graph_) visit(folder);
  }
  std::vector<std::string> circles;

 private:
  void visit(const std::string& folder) {
    if (done_.contains(folder)) return;
    if (const auto begin = std::find(way_.begin(), way_.end(), folder); begin != way_.end()) {
      circles.push_back(sentence(begin));
      return;
    }
    way_.push_back(folder);
    if (const auto found = graph_.find(folder); found != graph_.end())
      for (const auto& [target, include] : found->second) visit(target);
    way_.pop_back();
    done_.insert(folder);
  }

  [[nodiscard]] std::string sentence(std::vector<std::string>::const_iterator begin) const {
    std::string folders, includes;
    for (auto folder = begin; folder != way_.end(); ++folder) {
      const std::string& next = folder + 1 == way_.end() ? *begin : *(folder + 1);
      folders.append(*folder).append(" -> ");
      includes.append(includes.empty() ? "" : "; ").append(graph_.at(*folder).at(next));
    }
    return folders + *begin + ": " + includes;
  }

  const FolderGraph& graph_;
  std::vector<std::string> way_;
  std::set<std::string> done_;
};

}  // namespace

std::vector<std::string> include_circles(const std::vector<SourceFile>& tree, std::string_view side) {
  const FolderGraph graph = folder_graph(tree, side);
  return CircleSearch(graph).circles;
}

}  // namespace farlod
