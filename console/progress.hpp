// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace farlod {

enum class Verbosity { normal, quiet };

/// Tells a user on standard error how far a long work is: one line that is drawn again on a terminal, a plain line every ten
/// seconds elsewhere. May be told from many threads.
class Progress {
 public:
  Progress(std::string what, Verbosity verbosity);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool silent_, on_terminal_;
  Clock::time_point start_, next_;
  bool line_open_ = false;
  std::mutex mutex_;
};

}  // namespace farlod
