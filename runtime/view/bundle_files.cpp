// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/bundle_files.hpp"

#include <array>

// The linker's view of the files that bundle_bytes.S.in includes
extern "C" {
extern const char farlod_bundle_html_begin[], farlod_bundle_html_end[];
extern const char farlod_bundle_script_begin[], farlod_bundle_script_end[];
extern const char farlod_bundle_style_begin[], farlod_bundle_style_end[];
extern const char farlod_bundle_licences_begin[], farlod_bundle_licences_end[];
}

namespace farlod {
namespace {

std::string_view bytes_of(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

std::span<const BundleFile> bundle_files() {
  static const std::array files{
      BundleFile{"index.html", "text/html; charset=utf-8", bytes_of(farlod_bundle_html_begin, farlod_bundle_html_end)},
      BundleFile{"viewer.js", "text/javascript; charset=utf-8", bytes_of(farlod_bundle_script_begin, farlod_bundle_script_end)},
      BundleFile{"viewer.css", "text/css; charset=utf-8", bytes_of(farlod_bundle_style_begin, farlod_bundle_style_end)},
      BundleFile{"licences.txt", "text/plain; charset=utf-8",
                 bytes_of(farlod_bundle_licences_begin, farlod_bundle_licences_end)}};
  return files;
}

}  // namespace farlod
