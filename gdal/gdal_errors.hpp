// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace farlod {

/// Keeps GDAL from printing on this thread while it lives, and collects the failures that GDAL reports. Warnings are dropped.
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  /// Whether there was a failure since the last take().
  [[nodiscard]] bool any() const { return !messages_.empty(); }
  /// GDAL's message about the last one.
  [[nodiscard]] std::string last() const;
  /// The messages of all failures since the last call, in order.
  [[nodiscard]] std::vector<std::string> take();

 private:
  std::vector<std::string> messages_;
};

}  // namespace farlod
