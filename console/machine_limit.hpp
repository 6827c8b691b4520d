// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/machine_memory.hpp"

namespace farlod {

/// Whether the library refuses a run of so many bytes, unless somebody allows it: that is all there is to tell of it then.
[[nodiscard]] inline bool is_refused_by_machine(double bytes) { return is_beyond_machine(bytes); }

}  // namespace farlod
