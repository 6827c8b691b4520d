// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "base/expects.hpp"

namespace farlod {

/// What a tile has many of: elements of its own, or a view into the pages of the whole city (TilePages).
template <class T>
class TileArray {
 public:
  using value_type = T;

  TileArray() = default;
  TileArray(std::initializer_list<T> elements) : own_(elements) {}
  TileArray(std::vector<T> elements) : own_(std::move(elements)) {}
  /// The elements must outlive the array.
  [[nodiscard]] static TileArray view_of(std::span<const T> elements) {
    TileArray array;
    array.view_ = elements;
    return array;
  }
  operator std::vector<T>() const { return {begin(), end()}; }

  /// Not to a view.
  void push_back(const T& element) {
    FARLOD_EXPECTS(view_.empty());
    own_.push_back(element);
  }

  [[nodiscard]] const T* data() const { return view_.empty() ? own_.data() : view_.data(); }
  [[nodiscard]] std::size_t size() const { return view_.empty() ? own_.size() : view_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size(); }
  [[nodiscard]] const T& operator[](std::size_t n) const { return data()[n]; }

  friend bool operator==(const TileArray& a, const TileArray& b) { return std::ranges::equal(a, b); }

 private:
  std::vector<T> own_;
  std::span<const T> view_;
};

}  // namespace farlod
