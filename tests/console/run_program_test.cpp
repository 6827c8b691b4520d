// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/run_program.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

#include "farlod/error.hpp"

namespace farlod {
namespace {

struct Ended {
  int exit_code;
  std::string said;
  bool operator==(const Ended&) const = default;
};

void PrintTo(const Ended& ended, std::ostream* out) { *out << ended.exit_code << " \"" << ended.said << '"'; }

template <class Run>
Ended ended(const Run& run) {
  testing::internal::CaptureStderr();
  const int exit_code = run_program({.name = "farlod-x",
                                     .when_interrupted = "Nothing was written.",
                                     .when_out_of_memory = "Use fewer --threads.",
                                     .at_limit = " The limit is --memory-limit."},
                                    run);
  return {exit_code, testing::internal::GetCapturedStderr()};
}

template <class Thrown>
Ended ended_by(const Thrown& thrown) {
  return ended([&]() -> int { throw thrown; });
}

TEST(RunProgram, ReturnsWhatTheRunReturns) {
  EXPECT_EQ(ended([] { return exit_done; }), (Ended{0, ""}));
  EXPECT_EQ(ended([] { return exit_damaged_package; }), (Ended{4, ""}));
}

TEST(RunProgram, EachErrorHasItsExitCode) {
  EXPECT_EQ(ended_by(Error("e")), (Ended{1, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(InvalidArgument("e")), (Ended{2, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(InvalidPoint(3, "e")), (Ended{2, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(InputError("e")), (Ended{3, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(ProblemsRefused("e")), (Ended{3, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(OutputError("e")), (Ended{3, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(PackageUnusable("e")), (Ended{3, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(PackageDamaged("e")), (Ended{4, "farlod-x: e\n"}));
  EXPECT_EQ(ended_by(Busy("e")), (Ended{6, "farlod-x: e\n"}));
}

TEST(RunProgram, SaysWhatToDoWhereTheWorkIsTooLarge) {
  EXPECT_EQ(ended_by(LimitReached("e.")), (Ended{5, "farlod-x: e. The limit is --memory-limit.\n"}));
  EXPECT_EQ(ended_by(std::bad_alloc()), (Ended{5, "farlod-x: out of memory. Use fewer --threads.\n"}));
}

TEST(RunProgram, SaysWhatIsLeftOfAnInterruptedRun) {
  EXPECT_EQ(ended_by(Cancelled("e")), (Ended{128, "farlod-x: interrupted. Nothing was written.\n"}));
}

TEST(RunProgram, AnErrorOfAnotherLibraryIsAFaultOfOurs) {
  EXPECT_EQ(ended_by(std::out_of_range("e")), (Ended{1, "farlod-x: e\n"}));
}

}  // namespace
}  // namespace farlod
