// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

namespace farlod {

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

}  // namespace farlod
