// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/run_program.hpp"

#include <fmt/core.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): setenv is of POSIX
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <thread>

#include "farlod/error.hpp"

namespace farlod {

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

namespace {

constexpr std::array asking{SIGINT, SIGTERM, SIGHUP};

/// The state of the process. A handler may do little more than write a byte to a pipe; a thread asks the token.
struct State {
  std::stop_source stop;
  std::atomic<int> signal = 0;
  std::array<int, 2> pipe{-1, -1};
  std::thread listener;
};
State& state() {
  static State all;
  return all;
}

void note_signal(int number) {
  State& s = state();
  int none = 0;
  s.signal.compare_exchange_strong(none, number);
  const char byte = 1;
  [[maybe_unused]] const ssize_t written = ::write(s.pipe[1], &byte, 1);
}

void listen() {
  State& s = state();
  char byte = 0;
  while (read(s.pipe[0], &byte, 1) < 0) {
  }
  if (byte == 1) s.stop.request_stop();
}

void handle_with(int number, void (*handler)(int)) {
  struct sigaction before {};
  // What the caller ignores, as nohup does with SIGHUP, stays ignored
  if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  // The second one does what it does without us
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  State& s = state();
  if (pipe(s.pipe.data()) != 0) return;
  s.listener = std::thread(listen);
  for (const int number : asking) handle_with(number, note_signal);
}

Interruption::~Interruption() {
  State& s = state();
  if (!s.listener.joinable()) return;
  for (const int number : asking) handle_with(number, SIG_DFL);
  const char end = 2;
  if (::write(s.pipe[1], &end, 1) == 1) s.listener.join();
  for (const int file : s.pipe) ::close(file);
}

std::stop_token Interruption::token() { return state().stop.get_token(); }
int Interruption::signal() { return state().signal; }
int Interruption::exit_code() { return 128 + signal(); }

void write_text(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw OutputError(path, "is there such a folder, and room on the disk?");
}

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

std::filesystem::path bundled_font_settings(const std::filesystem::path& program) {
  std::error_code none;
  const auto settings = program.parent_path().parent_path() / "lib/farlod/share/farlod/fonts.conf";
  return std::filesystem::is_regular_file(settings, none) ? settings : std::filesystem::path();
}

void use_bundled_fonts() {
  std::error_code none;
  const auto settings = bundled_font_settings(std::filesystem::read_symlink("/proc/self/exe", none));
  // Fontconfig can be told by its environment alone. No other thread runs yet. NOLINTNEXTLINE(concurrency-mt-unsafe)
  if (!settings.empty()) setenv("FONTCONFIG_FILE", settings.c_str(), 0);
}

}  // namespace farlod
