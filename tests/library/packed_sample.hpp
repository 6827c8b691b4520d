// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "farlod/pack.hpp"
#include "farlod/package.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod::library {

/// The sample village, packed by the public function into a folder that is removed at the end.
class PackedSample {
 public:
  explicit PackedSample(FarMapKind far_map = FarMapKind::horizon);
  /// The one for all tests of this process.
  [[nodiscard]] static const PackedSample& shared() {
    static const PackedSample sample;
    return sample;
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return settings_.output; }
  [[nodiscard]] const PackResult& result() const { return result_; }
  /// How it was packed.
  [[nodiscard]] const PackSettings& settings() const { return settings_; }

 private:
  scenes::TemporaryFolder folder_;
  PackSettings settings_;
  PackResult result_;
};

/// The middle of a package, in its CRS.
[[nodiscard]] Point2d middle_of(const Package& package);

/// How the village is packed into a folder.
[[nodiscard]] PackSettings village_settings(const std::filesystem::path& output);

}  // namespace farlod::library
