// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fstream>

#include "tests/counted/held_memory.hpp"

// A library that LD_PRELOAD gives to a program of ours. At its end, the program writes the most bytes that it has held at a time
// to the file that FARLOD_HELD_MEMORY names.

namespace {

class ToldAtTheEnd {
 public:
  ToldAtTheEnd() = default;
  ToldAtTheEnd(const ToldAtTheEnd&) = delete;
  ToldAtTheEnd& operator=(const ToldAtTheEnd&) = delete;
  ~ToldAtTheEnd() {
    const std::size_t most = held_.most_bytes();
    if (const char* file = std::getenv("FARLOD_HELD_MEMORY")) std::ofstream(file) << most << '\n';
  }

 private:
  farlod::HeldMemory held_;
};

const ToldAtTheEnd told_at_the_end;

}  // namespace
