// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/paging/pages.hpp"

namespace farlod {

/// A growing array, as std::vector, for what a city has millions of. A long one lies on disk (Pages), where only what is in use
/// takes memory. As it grows, what is behind is let go.
template <class T>
class PagedArray {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));

 public:
  using value_type = T;

  PagedArray() = default;
  PagedArray(std::initializer_list<T> elements) { append(elements); }
  PagedArray(const std::vector<T>& elements) { append(elements); }  // NOLINT(google-explicit-constructor): what holds the same
  /// What a file holds from its beginning to its end, as raw elements. They may be read only. Throws InputError.
  [[nodiscard]] static PagedArray of_file(const std::filesystem::path& path) {
    PagedArray array;
    array.pages_ = Pages(PageFile::to_read(path));
    array.size_ = array.pages_.capacity() / sizeof(T);
    return array;
  }
  PagedArray(const PagedArray& other) { append(other); }
  PagedArray(PagedArray&& other) noexcept : pages_(std::move(other.pages_)), size_(std::exchange(other.size_, 0)) {}
  PagedArray& operator=(PagedArray other) noexcept {
    pages_ = std::move(other.pages_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }
  ~PagedArray() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return reinterpret_cast<T*>(pages_.data()); }
  [[nodiscard]] const T* data() const { return reinterpret_cast<const T*>(pages_.data()); }
  [[nodiscard]] T* begin() { return data(); }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] T* end() { return data() + size_; }
  [[nodiscard]] const T* end() const { return data() + size_; }
  [[nodiscard]] T& operator[](std::size_t n) { return data()[n]; }
  [[nodiscard]] const T& operator[](std::size_t n) const { return data()[n]; }
  [[nodiscard]] T& back() { return data()[size_ - 1]; }
  [[nodiscard]] const T& back() const { return data()[size_ - 1]; }

  void push_back(const T& element) {
    const T copy = element;  // it may be one of the array
    grow(size_ + 1);
    new (data() + size_++) T(copy);
  }
  /// Elements that are not of this array.
  void append(std::span<const T> elements) {
    grow(size_ + elements.size());
    std::uninitialized_copy(elements.begin(), elements.end(), data() + size_);
    size_ += elements.size();
  }
  /// New elements have any value.
  void resize_for_overwrite(std::size_t size) {
    grow(size);
    size_ = size;
  }
  /// New elements are T().
  void resize(std::size_t size) {
    grow(size);
    for (; size_ < size; ++size_) new (data() + size_) T();
    size_ = size;
  }

  /// Gives back the memory of all elements, or of those from `begin` to before `end`, as far as they lie on disk.
  void let_go() const { let_go(0, size_); }
  void let_go(std::size_t begin, std::size_t end) const { pages_.let_go(begin * sizeof(T), end * sizeof(T)); }

 private:
  void grow(std::size_t size) {
    if (size * sizeof(T) > pages_.capacity()) pages_.reserve(size * sizeof(T), size_ * sizeof(T));
  }

  Pages pages_;
  std::size_t size_ = 0;
};

}  // namespace farlod
