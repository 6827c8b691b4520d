// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace farlod {

/// The most memory that this process ever held, in MiB.
[[nodiscard]] double peak_memory_mib();

}  // namespace farlod
