// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace farlod::plausibility {

/// Values of which some are kept where they are many, spread over all.
template <class Value>
class SomeOfMany {
 public:
  void add(const Value& value) {
    constexpr std::size_t most_kept = 65'536;
    if (count_++ % apart_ != 0) return;
    if (kept_.size() == most_kept) {
      for (std::size_t n = 0; 2 * n < most_kept; ++n) kept_[n] = kept_[2 * n];
      kept_.resize(most_kept / 2);
      apart_ *= 2;
    }
    kept_.push_back(value);
  }
  [[nodiscard]] const std::vector<Value>& kept() const { return kept_; }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::vector<Value> kept_;
  std::size_t count_ = 0, apart_ = 1;
};

/// The heights of an inventory's trees, or of a canopy's cells, above the ground. Of many, some are kept.
class HeightsOfTrees {
 public:
  void add(double height_m) { heights_m_.add(static_cast<float>(height_m)); }

  /// Why they are hardly metres, in words that go on behind the name of the file, with what to do: of ten and more, half are
  /// higher than any tree. `advice` says how the file tells its unit.
  [[nodiscard]] std::optional<std::string> doubt(const std::string& advice) const;

 private:
  SomeOfMany<float> heights_m_;
};

}  // namespace farlod::plausibility
