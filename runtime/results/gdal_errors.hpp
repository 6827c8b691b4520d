// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace farlod {

/// While it lives, GDAL prints nothing on this thread; what it complains about can be asked for.
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  /// Whether something failed since this was made.
  [[nodiscard]] bool any() const;
  /// GDAL's words about the last failure.
  [[nodiscard]] std::string last() const;
};

}  // namespace farlod
