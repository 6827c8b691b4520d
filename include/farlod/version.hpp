// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace farlod {

inline constexpr const char* software_version = "0.1.0";

}  // namespace farlod
