// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "farlod/export.hpp"

namespace farlod {

/// What the programs return. Scripts rely on the numbers.
enum ExitCode : int {
  exit_done = 0,
  exit_internal = 1,        ///< a fault of ours
  exit_usage = 2,           ///< the command line cannot be understood
  exit_unusable_input = 3,  ///< an input cannot be read or used, or an output cannot be written
  exit_damaged_package = 4,
  exit_limit_reached = 5,  ///< memory
  exit_busy = 6,           ///< another process is at work on the same output: try again later
  /// And the number of the signal that asked the program to end, as shells count: 130 for Ctrl-C, 143 for SIGTERM.
  exit_interrupted = 128,
};

/// What the libraries throw: this, or what derives from it. The message says what is wrong, where, and what to do. Besides, when
/// memory runs out, std::bad_alloc; and whatever a callback of the caller throws, which ends the run and comes out of it as it
/// is. A broken promise of our own code is none of these: it aborts, and names its line.
class FARLOD_EXPORT Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// What a program returns that it ends.
  [[nodiscard]] virtual ExitCode exit_code() const noexcept { return exit_internal; }
};

/// A function was called with what it cannot take. Nothing was done.
class FARLOD_EXPORT InvalidArgument : public Error {
 public:
  using Error::Error;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_usage; }
};

/// One of the points that were given cannot be one.
class FARLOD_EXPORT InvalidPoint : public InvalidArgument {
 public:
  InvalidPoint(std::size_t index, const std::string& message) : InvalidArgument(message), index_(index) {}
  [[nodiscard]] std::size_t index() const noexcept { return index_; }  ///< counted from 0

 private:
  std::size_t index_;
};

/// The caller asked a run to stop (RunSettings::stop). No file is left half written. Of a package that was being made, what is
/// finished stays beside it (PackSettings::resume); what an evaluation has computed is lost.
class FARLOD_EXPORT Cancelled : public Error {
 public:
  using Error::Error;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_interrupted; }
};

/// A file of the user's cannot be read or used.
class FARLOD_EXPORT InputError : public Error {
 public:
  using Error::Error;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_unusable_input; }
};

/// The city has problems, and PackSettings::problems refuses them.
class FARLOD_EXPORT ProblemsRefused : public InputError {
 public:
  using InputError::InputError;
};

/// A file cannot be written.
class FARLOD_EXPORT OutputError : public Error {
 public:
  using Error::Error;
  OutputError(const std::filesystem::path& path, const std::string& reason)
      : Error("cannot write " + path.string() + ": " + reason) {}
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_unusable_input; }
};

/// Another process is at work on the same package or file: it can be tried again later.
class FARLOD_EXPORT Busy : public OutputError {
 public:
  using OutputError::OutputError;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_busy; }
};

/// A package that cannot be opened or used at all: it is not there, not a package, of another version of the format, or has not
/// what the settings ask for.
class FARLOD_EXPORT PackageUnusable : public Error {
 public:
  using Error::Error;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_unusable_input; }
};

/// A package that contradicts itself: truncated, altered, or written by a faulty program. The message names the file and the
/// first rule that it breaks.
class FARLOD_EXPORT PackageDamaged : public Error {
 public:
  using Error::Error;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_damaged_package; }
};

/// The work needs more memory than RunSettings::memory_limit_mib gives it.
class FARLOD_EXPORT LimitReached : public Error {
 public:
  using Error::Error;
  [[nodiscard]] ExitCode exit_code() const noexcept override { return exit_limit_reached; }
};

}  // namespace farlod
