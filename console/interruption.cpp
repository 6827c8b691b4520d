// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/interruption.hpp"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <thread>

namespace farlod {
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
  [[maybe_unused]] const ssize_t written = write(s.pipe[1], &byte, 1);
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
  if (write(s.pipe[1], &end, 1) == 1) s.listener.join();
  for (const int file : s.pipe) close(file);
}

std::stop_token Interruption::token() { return state().stop.get_token(); }
int Interruption::signal() { return state().signal; }
int Interruption::exit_code() { return 128 + signal(); }

}  // namespace farlod
