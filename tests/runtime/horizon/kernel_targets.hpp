// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "horizon/kernels.hpp"

namespace farlod {

/// GoogleTest finds it beside the type.
inline void PrintTo(const KernelTarget& target, std::ostream* out) { *out << target.name; }

/// The targets that this processor runs, for INSTANTIATE_TEST_SUITE_P.
[[nodiscard]] inline std::vector<KernelTarget> kernel_targets() { return {runnable_kernels().begin(), runnable_kernels().end()}; }
[[nodiscard]] inline std::string name_of_target(const testing::TestParamInfo<KernelTarget>& test) {
  return std::string(test.param.name);
}

}  // namespace farlod
