// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace farlod {

/// The bytes as a file of gzip, without a name and a time: the same bytes give the same file.
[[nodiscard]] std::string gzipped(std::string_view bytes);

}  // namespace farlod
