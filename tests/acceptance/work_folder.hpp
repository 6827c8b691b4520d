// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod::acceptance {

/// What came of a command.
struct Outcome {
  int exit_code;  ///< 128 and the signal's number when a signal ended it
  std::string out, err;
};

/// A folder in which commands run as a user would type them, and that is gone afterwards.
class WorkFolder {
 public:
  /// Runs a command line in this folder, by a shell that finds the programs of this build first.
  [[nodiscard]] Outcome run(const std::string& command) const;
  /// The same, for steps on the way: the test fails when the command does.
  void must(const std::string& command) const;

  /// Runs a program with its arguments, and tells the most memory that it holds at a time, in MiB: what it asks malloc for,
  /// whatever of that is resident, and without libraries and mapped files. So no other program of the machine changes it. Nothing
  /// where a sanitizer has a malloc of its own.
  [[nodiscard]] std::optional<double> held_mib(const std::string& command) const;

  void write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string text_of(const std::string& name) const;
  /// The colours of a picture in SVG, such as #b2182b. Cairo writes them as rgb(69.8%,9.4%,16.9%), since 1.18 with spaces.
  [[nodiscard]] std::set<std::string> colours_of(const std::string& name) const;
  [[nodiscard]] nlohmann::json json_of(const std::string& name) const;
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.file(name); }
  /// Of all files and folders in it, sorted, except for those in which run() keeps what commands say.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }

 private:
  scenes::TemporaryFolder folder_;
};

/// The lines of a text, without their ends.
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

/// The command was refused as it should be: with this exit code, nothing on standard output, and on standard error one line
/// that holds all of `said`. After a usage error a second line leads to --help.
void expect_refusal(const Outcome& outcome, int exit_code, const std::vector<std::string>& said);

}  // namespace farlod::acceptance
