// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/kept_answers.hpp"

#include <array>
#include <cstring>
#include <utility>
#include <vector>

namespace farlod {
namespace {

/// What is counted of a cell, before its values.
using Counts = std::array<std::uint64_t, 3>;

Counts counts_of(const SvfValues& values) { return {values.svf.size(), values.counts.by_rays, values.counts.retraced_rays}; }

/// The arrays of the values, in the order in which they are kept.
template <class Values>
auto arrays_of(Values& values) {
  return std::array{&values.svf, &values.low, &values.high, &values.further};
}

std::size_t kept_bytes_of(const SvfValues& values) {
  std::size_t bytes = sizeof(Counts);
  for (const std::vector<float>* array : arrays_of(values)) bytes += array->size() * sizeof(float);
  return bytes;
}

}  // namespace

std::optional<SvfValues> find_answers(const AnswerFile& file, std::size_t n, SvfValues wanted) {
  const auto bytes = file.find(n);
  if (!bytes) return std::nullopt;
  if (bytes->size() != kept_bytes_of(wanted)) return std::nullopt;
  Counts counts{};
  std::memcpy(counts.data(), bytes->data(), sizeof(counts));
  if (counts[0] != wanted.svf.size()) return std::nullopt;
  wanted.counts = {counts[1], counts[2]};
  const std::byte* at = bytes->data() + sizeof(counts);
  for (std::vector<float>* array : arrays_of(wanted)) {
    if (!array->empty()) std::memcpy(array->data(), at, array->size() * sizeof(float));
    at += array->size() * sizeof(float);
  }
  return wanted;
}

void keep_answers(const AnswerFile& file, std::size_t n, const SvfValues& values) {
  const Counts counts = counts_of(values);
  std::vector<std::byte> bytes(kept_bytes_of(values));
  std::memcpy(bytes.data(), counts.data(), sizeof(counts));
  std::byte* at = bytes.data() + sizeof(counts);
  for (const std::vector<float>* array : arrays_of(values)) {
    if (!array->empty()) std::memcpy(at, array->data(), array->size() * sizeof(float));
    at += array->size() * sizeof(float);
  }
  file.keep(n, bytes);
}

}  // namespace farlod
