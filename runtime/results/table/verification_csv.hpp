// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "farlod/evaluation.hpp"

namespace farlod {

/// Writes receivers with their value and their exact value as CSV: x_m, y_m, z_m, `quantity`, `quantity`_exact. Throws
/// OutputError.
void write_verification_csv(std::span<const VerifiedReceiver> receivers, const std::string& quantity,
                            const std::filesystem::path& path);

}  // namespace farlod
