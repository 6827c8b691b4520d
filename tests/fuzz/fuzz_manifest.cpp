// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "base/expects.hpp"
#include "package/manifest.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod {
namespace {

/// What the rest of the runtime builds on.
void read(std::string_view text) {
  expect_answer_or_refusal([text] {
    const package::Manifest m = manifest_from_text(text, "manifest.json");
    FARLOD_EXPECTS(m.blocks.size() == m.grid.blocks().size());
    std::uint64_t cells = 0;
    for (const package::BlockFiles& files : m.blocks) {
      cells += static_cast<std::uint64_t>(m.grid.cells_of(files.block).size());
      // Numbers alone name a folder
      FARLOD_EXPECTS(package::folder_of(files).find_first_not_of("blocks/-_0123456789") == std::string::npos);
    }
    FARLOD_EXPECTS(cells == static_cast<std::uint64_t>(m.grid.cells.size()) && m.cells_with_far_map() <= cells);
    FARLOD_EXPECTS(m.far_map.picture_columns() > 0 && m.far_map.picture_rows() > 0);
  });
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  farlod::read(text);
  // As whoever forges a manifest would write it
  farlod::read(farlod::scenes::sealed(std::string(text)));
  return 0;
}
