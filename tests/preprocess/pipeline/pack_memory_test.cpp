// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "pipeline/pack_estimate.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::pipeline::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A thousand petabytes: whatever the machine, it has less.
constexpr double more_than_any_mib = 1e12;

std::string refusal_of_packing(double memory_mib, const RunSettings& run) {
  PackEstimate estimate;
  estimate.cells = 7;
  estimate.memory_mib = memory_mib;
  estimate.least_memory_mib = 1.0;
  return scenes::refusal_of<LimitReached>([&] { require_memory(estimate, run); });
}

TEST(MemoryOfTheMachine, MoreThanTheMachineHasIsRefusedWithTheLimitThatWouldDo) {
  EXPECT_THAT(refusal_of_packing(more_than_any_mib, {}),
              AllOf(HasSubstr("Packing into 7 cells takes about 1000000000000 MiB, and this machine has "),
                    HasSubstr(" MiB: --memory-limit "), HasSubstr("packs the same within that")));
}

TEST(MemoryOfTheMachine, WithinALimitAndWhatTheMachineHasArePacked) {
  RunSettings limited;
  limited.memory_limit_mib = 2;
  EXPECT_EQ(refusal_of_packing(more_than_any_mib, limited), "no refusal");
  EXPECT_EQ(refusal_of_packing(1.0, {}), "no refusal");
}

}  // namespace
}  // namespace farlod::pipeline::test
