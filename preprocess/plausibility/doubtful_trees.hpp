// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace farlod::plausibility {

/// The heights of an inventory's trees, or of a canopy's cells, above the ground. Of many, some are kept.
class HeightsOfTrees {
 public:
  void add(double height_m);

  /// Why they are hardly metres, in words that go on behind the name of the file, with what to do: of ten and more, half are
  /// higher than any tree. `advice` says how the file tells its unit.
  [[nodiscard]] std::optional<std::string> doubt(const std::string& advice) const;

 private:
  std::vector<float> kept_m_;
  std::size_t count_ = 0, apart_ = 1;
};

}  // namespace farlod::plausibility
