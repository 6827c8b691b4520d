// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/kernels.hpp"

namespace farlod {

/// Edges that may rise above horizons somewhere, at the azimuths or between two: EdgeSpans.
class DrawnEdges {
 public:
  DrawnEdges() { grow(0); }
  DrawnEdges(const DrawnEdges& other) : DrawnEdges() { *this = other; }
  DrawnEdges(DrawnEdges&&) = default;
  /// What is room for more is not copied.
  DrawnEdges& operator=(const DrawnEdges& other) {
    if (this == &other) return *this;
    clear();
    add(other);
    return *this;
  }
  DrawnEdges& operator=(DrawnEdges&&) = default;
  ~DrawnEdges() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const std::uint32_t> numbers() const { return std::span(number_).first(size_); }
  /// Sixteen more can be read behind the last one: they reach into no wedge.
  [[nodiscard]] EdgeSpans spans() const { return {number_.data(), first_.data(), count_.data(), max_slope_.data()}; }
  void clear() { resize(0); }
  /// Room for so many more, of which added() says how many there are.
  [[nodiscard]] RoomForSpans room_for(std::size_t more) {
    if (number_.size() < size_ + more + at_once) grow(size_ + more);
    return {&number_[size_], &first_[size_], &count_[size_], &max_slope_[size_]};
  }
  void added(std::size_t more) { resize(size_ + more); }
  void add(const DrawnEdges& others) {
    const RoomForSpans to = room_for(others.size_);
    std::copy_n(others.number_.begin(), others.size_, to.number);
    std::copy_n(others.first_.begin(), others.size_, to.first);
    std::copy_n(others.count_.begin(), others.size_, to.count);
    std::copy_n(others.max_slope_.begin(), others.size_, to.max_slope);
    added(others.size_);
  }

 private:
  static constexpr std::size_t at_once = 16;

  void grow(std::size_t size) {
    number_.resize(size + at_once);
    for (auto* wedges : {&first_, &count_}) wedges->resize(size + at_once);
    max_slope_.resize(size + at_once);
  }
  void resize(std::size_t size) {
    size_ = size;
    std::fill_n(&count_[size], at_once, 0);
  }

  std::size_t size_ = 0;
  std::vector<std::uint32_t> number_;
  std::vector<std::int32_t> first_, count_;
  std::vector<float> max_slope_;
};

}  // namespace farlod
