// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/run_program.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <exception>
#include <new>

#include "console/interruption.hpp"
#include "farlod/error.hpp"

namespace farlod {

int run_program(const ProgramName& program, const std::function<int()>& run) {
  const auto say = [&](const std::string& what) { fmt::print(stderr, "{}: {}\n", program.name, what); };
  try {
    return run();
  } catch (const Cancelled&) {
    say("interrupted. " + program.when_interrupted);
    return Interruption::exit_code();
  } catch (const LimitReached& error) {
    say(error.what() + program.at_limit);
    return error.exit_code();
  } catch (const Error& error) {
    say(error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    say("out of memory. " + program.when_out_of_memory);
    return exit_limit_reached;
  } catch (const std::exception& error) {
    say(error.what());
    return exit_internal;
  }
}

}  // namespace farlod
