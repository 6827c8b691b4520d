// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace farlod::ingest {

/// Keys with their values.
using Tags = std::vector<std::pair<std::string, std::string>>;

/// The tags in a field of OpenStreetMap's data: an object of JSON, {"natural": "tree"}, or a list, "natural"=>"tree". Values that
/// are neither texts nor numbers are left out; of any other text there are none.
[[nodiscard]] Tags tags_in(const std::string& text);

}  // namespace farlod::ingest
