// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace farlod {

/// Appends a text in quotes, as RFC 8259 says; bytes beyond ASCII stay as they are.
void append_json_text(std::string& json, std::string_view text);

}  // namespace farlod
