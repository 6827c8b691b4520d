// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace farlod {
namespace {

using namespace std::chrono_literals;

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

}  // namespace

ProgressLine::ProgressLine(std::string what, Verbosity verbosity)
    : what_(std::move(what)),
      silent_(verbosity == Verbosity::quiet),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + (on_terminal_ ? 200ms : 10s)) {}

ProgressLine::~ProgressLine() {
  if (line_open_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::update(std::size_t done, std::size_t all) {
  if (silent_ || done == 0) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + (on_terminal_ ? 200ms : 10s);
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double left_s = elapsed_s * static_cast<double>(all - done) / static_cast<double>(done);
  const std::string line = fmt::format("{}: {:.0f} %, about {} left", what_,
                                       100.0 * static_cast<double>(done) / static_cast<double>(all), duration_text(left_s));
  if (on_terminal_)
    fmt::print(stderr, "\r\033[K{}", line);
  else
    fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
  line_open_ = on_terminal_;
}

double rough_number(double value) {
  if (value <= 0.0) return 0.0;
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 1.0));
  return std::max(1.0, std::round(value / unit) * unit);
}

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t n = text.size(); n > 3; n -= 3) text.insert(n - 3, ",");
  return text;
}

std::string rough_duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", rough_number(seconds));
  if (seconds < 6000.0) return fmt::format("{:.0f} min", rough_number(seconds / 60.0));
  return fmt::format("{:.0f} h", rough_number(seconds / 3600.0));
}

std::string rough_size(double mib) {
  return mib < 10240.0 ? fmt::format("{:.0f} MiB", rough_number(mib)) : fmt::format("{:.0f} GiB", rough_number(mib / 1024.0));
}

}  // namespace farlod
