// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/package.hpp"
#include "view/result_layer.hpp"
#include "view/tile_tree.hpp"
#include "view/view_frame.hpp"

namespace farlod {

/// Tiles that were made, up to so many bytes: of more, those go that were asked for the longest ago.
class TileCache {
 public:
  explicit TileCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The tile, made if it is not there. Of those who ask for a new one at the same time, one makes it, and the others wait; where
  /// it throws, the next one tries.
  [[nodiscard]] std::shared_ptr<const std::string> get(const TileAddress& tile, const std::function<std::string()>& make);

 private:
  struct Entry {
    std::shared_ptr<const std::string> glb;
    std::list<TileAddress>::iterator use;
  };
  void keep(const TileAddress& tile, const std::shared_ptr<const std::string>& made);
  void let_go();

  std::size_t most_bytes_, bytes_ = 0;
  std::mutex mutex_;
  std::condition_variable nobody_makes_it_;
  std::set<TileAddress> being_made_;
  std::map<TileAddress, Entry> entries_;
  std::list<TileAddress> uses_;  ///< the last one first
};

/// What a request for a page or its data comes to.
struct ViewReply {
  int status = 200;  ///< as HTTP has it
  std::string type = "application/json";
  std::string body = {};
};

using ViewQuery = std::map<std::string, std::string, std::less<>>;

/// A package as the page asks for it: viewer/README.md lists the requests. Any number of threads may ask at the same time. The
/// package must outlive it.
class ViewCity {
 public:
  ViewCity(const Package& package, std::string name, const ViewFrame& frame, const EcefFromLocal& ecef_from_local,
           std::vector<ResultLayer> results = {});

  /// What is at this path, which has no slash in front. A request that makes no sense has the status 400, what is not there 404,
  /// and a package that is damaged 500, each with a sentence.
  [[nodiscard]] ViewReply answer(std::string_view path, const ViewQuery& query) const;

  [[nodiscard]] const TileTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<ResultLayer>& results() const { return results_; }
  /// Makes tiles that may be those of the first picture, the middle ones first, until it is told to stop or somebody asks for a
  /// tile: a browser that has started knows which ones it needs. What goes wrong is told to who asks for the tile.
  void make_first_tiles(const std::stop_token& stop) const;
  [[nodiscard]] bool has_crowns() const { return has_crowns_; }
  /// The canopy as the page reads it (CanopyColumns), made when it is asked for first.
  [[nodiscard]] const std::string& crowns() const;
  /// view.json; `can_answer` says whether single places can be asked for.
  [[nodiscard]] std::string description(bool can_answer) const;
  [[nodiscard]] std::string tile(const TileAddress& address) const;
  /// tileset.json of a tree of the city.
  [[nodiscard]] std::string tileset(const TileTree& tree) const;

 private:
  [[nodiscard]] ViewReply answer_or_throw(std::string_view path, const ViewQuery& query) const;
  [[nodiscard]] std::optional<ViewReply> file_of_tileset(std::string_view path) const;
  [[nodiscard]] std::optional<ViewReply> file_of_result(std::string_view path) const;
  [[nodiscard]] ViewReply at(const ViewQuery& query) const;
  [[nodiscard]] ViewReply hemisphere(const ViewQuery& query) const;
  [[nodiscard]] ViewReply cell(const ViewQuery& query) const;

  const Package& package_;
  std::string name_;
  EcefFromLocal ecef_from_local_;
  ViewFrame frame_;
  TileTree tree_;
  std::vector<ResultLayer> results_;
  bool has_crowns_;
  mutable std::once_flag crowns_are_made_;
  mutable std::string crowns_;
  mutable TileCache tiles_;
  mutable std::atomic<bool> tile_was_asked_for_ = false;
};

/// The labels of a layer's points, as JSON.
[[nodiscard]] std::string labels_json(const ResultLayer& layer);

}  // namespace farlod
