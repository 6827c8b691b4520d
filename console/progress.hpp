// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

namespace farlod {

enum class Verbosity { normal, quiet };

/// Tells a user on standard error how far a long work is: one line that is drawn again on a terminal, a plain line every ten
/// seconds elsewhere. May be told from many threads.
class ProgressLine {
 public:
  ProgressLine(std::string what, Verbosity verbosity);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool silent_, on_terminal_;
  Clock::time_point start_, next_;
  bool line_open_ = false;
  std::mutex mutex_;
};

/// Estimates for people: two digits, the rest zeros, and a unit that suits.
[[nodiscard]] double rough_number(double value);
[[nodiscard]] std::string rough_duration(double seconds);
[[nodiscard]] std::string rough_size(double mib);

/// "1,234,567"
[[nodiscard]] std::string with_commas(std::uint64_t number);

}  // namespace farlod
