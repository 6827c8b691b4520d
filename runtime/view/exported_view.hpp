// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "view/view_city.hpp"

namespace farlod {

struct ExportedView {
  std::size_t tiles = 0;
  std::uint64_t bytes = 0;
};

/// Writes the page, and all that it asks for of a city but single places, as files for any web server: the tiles down to whole
/// cells. The folder must be empty or not be there. `on_progress` is told tiles that are done, and how many there are. Throws
/// OutputError, and what making a tile throws.
ExportedView export_view(const ViewCity& city, const std::filesystem::path& folder,
                         const std::function<void(std::size_t done, std::size_t all)>& on_progress);

}  // namespace farlod
