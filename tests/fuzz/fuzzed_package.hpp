// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.hpp"

namespace farlod {

/// Packages of a few kilobytes of far maps of the kind `horizon`, and of the kind `box`. Files of their first blocks are changed.
[[nodiscard]] const std::array<std::filesystem::path, 2>& sample_packages();

[[nodiscard]] std::vector<std::byte> file_bytes(const std::filesystem::path& file);
[[nodiscard]] std::string file_text(const std::filesystem::path& file);

/// Makes the beginning of a `tiles.bin` what no reader refuses: magic, version and length.
void mend_header(std::span<std::byte> tiles);

/// Does the work. What the library promises to throw for a file that it refuses is no finding; a message is not empty.
void expect_answer_or_refusal(const std::function<void()>& work);

}  // namespace farlod
