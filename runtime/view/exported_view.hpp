// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "view/view_city.hpp"

namespace farlod {

/// The page of the bundle with its script, its style, its licences and all the files that it asks for, as one text of HTML. A
/// browser shows it without a server: viewer/src/embedded_files.ts takes the files from elements
/// `<script type="text/plain" data-file="NAME">`, which hold them compressed by gzip, in base64.
///   (1) the text asks no server for anything, and tells the browser to refuse it
///   (2) no byte of a file ends its element
class OnePage {
 public:
  /// Writes what stands before the files. The stream must outlive this.
  explicit OnePage(std::ostream& stream);

  void add(const std::string& name, std::string_view bytes);
  /// Writes what stands behind the files.
  void finish();
  /// That were written until now.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void write(std::string_view text);

  std::ostream& stream_;
  std::string rest_;
  std::uint64_t bytes_ = 0;
};

struct ExportedView {
  std::size_t tiles = 0;
  std::uint64_t bytes = 0;
};

/// Is told tiles that are done, and how many there are.
/// What it throws ends the export, of which nothing is left.
using OnExportProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Writes the page, and all that it asks for of a city but single places, as files for any web server: the tiles down to whole
/// cells. The folder must be empty or not be there. Throws OutputError, and what making a tile throws.
ExportedView export_view(const ViewCity& city, const std::filesystem::path& folder, const OnExportProgress& on_progress);

/// A page of more bytes is slow to open, and too large to be sent.
inline constexpr std::uint64_t most_bytes_of_page = std::uint64_t{64} << 20U;

/// Writes the same as one file of HTML, which a browser opens from a disk. Throws OutputError as well where the file would have
/// more than `most_bytes`, and leaves none then.
ExportedView export_page(const ViewCity& city, const std::filesystem::path& file, const OnExportProgress& on_progress,
                         std::uint64_t most_bytes = most_bytes_of_page);

/// To be asked before anything is computed: refuses a city that is certainly too large for one page, and a name that is a
/// folder's. Throws OutputError.
void require_page_is_possible(const std::filesystem::path& file, std::uint64_t triangles);

}  // namespace farlod
