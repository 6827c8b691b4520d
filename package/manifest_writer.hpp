// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "package/manifest.hpp"

namespace farlod {

/// The text of `manifest.json`, in the version of the format that its contents need, with its checksum at the end.
/// docs/package_format.md lists the keys.
[[nodiscard]] std::string manifest_text(const package::Manifest& manifest);

}  // namespace farlod
