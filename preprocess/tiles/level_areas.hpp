// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace farlod::tiles {

/// Joins level squares beside each other to rectangles: what lies side by side in a row at one height, and the same in the rows
/// after it.
class LevelAreas {
 public:
  struct Rectangle {
    std::int64_t x_begin = 0, x_end = 0, y_begin = 0, y_end = 0;
    double height_m = 0.0;
  };

  /// The next row; NaN where a square is not level. Hands out the rectangles that end before it.
  template <class Take>
  void add_row(const std::vector<double>& height_m, const Take& take) {
    std::vector<Rectangle> row;
    for (std::size_t x = 0, end = 0; x < height_m.size(); x = end) {
      for (end = x + 1; end < height_m.size() && height_m[end] == height_m[x]; ++end) {
      }
      if (!std::isnan(height_m[x]))
        row.push_back({static_cast<std::int64_t>(x), static_cast<std::int64_t>(end), y_, y_ + 1, height_m[x]});
    }
    auto open = open_.begin();
    for (Rectangle& r : row) {
      for (; open != open_.end() && open->x_begin < r.x_begin; ++open) take(*open);
      if (open == open_.end() || open->x_begin != r.x_begin) continue;
      if (open->x_end == r.x_end && open->height_m == r.height_m)
        r.y_begin = open->y_begin;
      else
        take(*open);
      ++open;
    }
    for (; open != open_.end(); ++open) take(*open);
    open_ = std::move(row);
    ++y_;
  }
  template <class Take>
  void end(const Take& take) {
    for (const Rectangle& r : open_) take(r);
    open_.clear();
  }

 private:
  std::int64_t y_ = 0;
  std::vector<Rectangle> open_;
};

/// Joins pieces of a line, one after the other, that have the same two heights.
class LevelRun {
 public:
  struct Run {
    std::int64_t begin = 0, end = 0;
    std::array<double, 2> heights_m{};
  };

  /// Hands out what the piece does not continue.
  template <class Take>
  void add(const Run& piece, const Take& take) {
    if (is_open_ && run_.end == piece.begin && run_.heights_m == piece.heights_m) {
      run_.end = piece.end;
      return;
    }
    end(take);
    run_ = piece;
    is_open_ = true;
  }
  template <class Take>
  void end(const Take& take) {
    if (std::exchange(is_open_, false)) take(run_);
  }

 private:
  Run run_;
  bool is_open_ = false;
};

}  // namespace farlod::tiles
