// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "results/module.hpp"

namespace farlod {
namespace {

/// By the place of the program, so that an installed tree may be moved, and the tree of a build is as good.
std::filesystem::path path_of_module(const char* name) {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  return program.parent_path().parent_path() / "lib" / "farlod" / (std::string(name) + ".so");
}

[[noreturn]] void refuse_module(const char* library, const std::string& reason) {
  throw InputError(std::string("this needs ") + library + ", and " + reason +
                   ". Install Far-LoD with its folder lib/farlod, and the libraries that its package depends on.");
}

}  // namespace

const void* functions_of_module(const char* name, const char* library) {
  const std::filesystem::path path = path_of_module(name);
  // Symbols are looked up when they are first called: a run calls few of the many that these libraries have
  void* const module = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  // glibc keeps a message for each thread. NOLINTNEXTLINE(concurrency-mt-unsafe)
  if (module == nullptr) refuse_module(library, std::string("its module cannot be loaded: ") + dlerror());
  const auto* const entry = static_cast<const ModuleEntry*>(dlsym(module, "farlod_module"));
  if (entry == nullptr) refuse_module(library, path.string() + " is no module of Far-LoD");
  if (entry->version != std::string(software_version))
    refuse_module(library, path.string() + " is of Far-LoD " + entry->version + ", and the program of " + software_version);
  return entry->functions;
}

}  // namespace farlod
