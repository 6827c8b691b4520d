// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/machine_memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace farlod {
namespace {

/// What a container may have: cgroups of version 2, and of version 1. Without a limit, there is a word or a huge number.
constexpr std::array limits_of_containers{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};

}  // namespace

std::optional<double> machine_memory_bytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return std::nullopt;
  double bytes = static_cast<double>(pages) * static_cast<double>(page_bytes);
  for (const char* const file : limits_of_containers) {
    double limit_bytes = 0.0;
    if (std::ifstream(file) >> limit_bytes && limit_bytes > 0.0) bytes = std::min(bytes, limit_bytes);
  }
  return bytes;
}

}  // namespace farlod
