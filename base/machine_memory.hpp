// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace farlod {

/// The memory that this process can have at the most, in bytes: that of the machine, or of the container that it runs in; none
/// where the system does not tell.
[[nodiscard]] std::optional<double> machine_memory_bytes();

/// An estimate of memory is coarse: what is refused exceeds the memory of the machine by so much.
inline constexpr double clearly_too_much = 1.2;

/// Whether so many bytes are clearly more than the machine has.
[[nodiscard]] inline bool is_beyond_machine(double bytes) {
  const std::optional<double> machine_bytes = machine_memory_bytes();
  return machine_bytes && bytes > clearly_too_much * *machine_bytes;
}

}  // namespace farlod
