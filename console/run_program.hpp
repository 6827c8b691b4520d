// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

namespace farlod {

/// The most memory that this process ever held, in MiB.
[[nodiscard]] double peak_memory_mib();

/// Lets a program end cleanly when it is asked to (SIGINT, SIGTERM, SIGHUP): from its making on, the first such signal asks the
/// token to stop. The second one ends the program at once. Made in main(), before any other thread is.
class Interruption {
 public:
  Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  [[nodiscard]] static std::stop_token token();
  /// The signal that came; 0 if none did.
  [[nodiscard]] static int signal();
  /// As shells number it: 128 and the signal.
  [[nodiscard]] static int exit_code();
};

/// Writes a file such as that of `--summary`; nothing without a name. Throws OutputError.
void write_text(const std::string& path, const std::string& text);

/// What a program says where a run ends before its end.
struct ProgramName {
  std::string name;                     ///< begins each line on standard error
  std::string when_interrupted = {};    ///< what is left of the work, and how to go on
  std::string when_out_of_memory = {};  ///< how to need less
  std::string at_limit = {};            ///< goes on behind LimitReached: the options that decide what is needed
};

/// Runs a program, and tells on standard error, in one line, what ended it: main() of each program. Returns its exit code.
[[nodiscard]] int run_program(const ProgramName& program, const std::function<int()>& run);

/// The settings of Fontconfig that an archive or a wheel brings along, for a program that lies in its folder bin; empty for a
/// program without.
[[nodiscard]] std::filesystem::path bundled_font_settings(const std::filesystem::path& program);

/// Lets this program draw texts with the font that was brought along, on systems that may have none, unless FONTCONFIG_FILE names
/// other settings. In main(), before any other thread is.
void use_bundled_fonts();

}  // namespace farlod
