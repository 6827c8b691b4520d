// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <utility>
#include <vector>

namespace farlod {

/// An array of NumPy that owns what the vector held: nothing is copied. Row by row (C order).
template <class T>
[[nodiscard]] pybind11::array_t<T> owned_array(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto held = std::make_unique<std::vector<T>>(std::move(values));
  T* const data = held->data();
  const pybind11::capsule owner(held.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  held.release();
  return pybind11::array_t<T>(std::move(shape), data, owner);
}

template <class T>
[[nodiscard]] pybind11::array_t<T> owned_array(std::vector<T> values) {
  const auto count = static_cast<pybind11::ssize_t>(values.size());
  return owned_array(std::move(values), {count});
}

}  // namespace farlod
