// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/program_documents.hpp"

#include <fmt/chrono.h>

#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "console/completion.hpp"
#include "console/manual_page.hpp"
#include "console/option_list.hpp"
#include "farlod/version.hpp"

namespace farlod {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + " cannot be written");
}

/// The seconds since 1970 at which a reproducible build takes place: https://reproducible-builds.org/specs/source-date-epoch
std::string date_of_build() {
  const char* text = std::getenv("SOURCE_DATE_EPOCH");  // NOLINT(concurrency-mt-unsafe): there is one thread
  if (text == nullptr) return "";
  char* end = nullptr;
  const long long seconds = std::strtoll(text, &end, 10);
  if (end == text || *end != '\0') throw std::runtime_error("SOURCE_DATE_EPOCH is not a number of seconds");
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

void write_documents(const std::filesystem::path& folder, const ProgramDescription& program, const CLI::App& app) {
  const OptionList options = options_of(app);
  write(folder / (program.name + ".1"), manual_page(program, options, {software_version, date_of_build()}));
  write(folder / (program.name + ".bash"), bash_completion(program.name, options));
  write(folder / (program.name + ".zsh"), zsh_completion(program.name, options));
}

}  // namespace

int write_program_documents(int argc, char** argv, const std::function<void(const CommandLineVisitor&)>& describe) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} FOLDER\n", argv[0]);
    return exit_usage;
  }
  try {
    describe([&](const ProgramDescription& program, const CLI::App& app) { write_documents(argv[1], program, app); });
    return exit_done;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return exit_unusable_input;
  }
}

}  // namespace farlod
