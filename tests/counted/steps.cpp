// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/counted/steps.hpp"

#include <atomic>
#include <utility>

namespace {

std::atomic<std::uint64_t> steps{0};
std::uint64_t awaited_step = 0;
std::function<void()> at_awaited_step;

/// The compiler calls it in each basic block (-fsanitize-coverage=trace-pc).
extern "C" void count_step() asm("__sanitizer_cov_trace_pc");
extern "C" void count_step() {
  if (++steps == awaited_step) at_awaited_step();
}

}  // namespace

namespace farlod {

CountedSteps::CountedSteps(std::uint64_t at, std::function<void()> then) {
  awaited_step = at;
  at_awaited_step = std::move(then);
  steps = 0;
}

CountedSteps::~CountedSteps() { awaited_step = 0; }

std::uint64_t CountedSteps::count() const { return steps; }

}  // namespace farlod
