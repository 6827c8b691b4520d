// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/crowns_writer.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "base/durable_file.hpp"
#include "farlod/error.hpp"
#include "package/crown_layout.hpp"
#include "package/written_stamp.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

using Crowns = PagedArray<CrownsOfCity::OwnedCrown>;

std::vector<package::CrownCellRecord> cells_of(const Crowns& crowns, const CellRange& cells) {
  std::vector<package::CrownCellRecord> records;
  for (std::size_t n = 0; n < crowns.size(); ++n) {
    const Crown& crown = crowns[n].crown;
    if (n == 0 || crowns[n].cell != crowns[n - 1].cell) {
      const Cell cell = cells.cell_at(crowns[n].cell);
      records.push_back({cell.i, cell.j, n, 0, crown.bottom_m, crown.top_m, 0});
    }
    package::CrownCellRecord& record = records.back();
    ++record.crown_count;
    record.z_low_m = std::min(record.z_low_m, crown.bottom_m);
    record.z_high_m = std::max(record.z_high_m, crown.top_m);
  }
  return records;
}

package::CrownsHeader header_of(const Crowns& crowns, std::size_t cell_count) {
  package::CrownsHeader header{};
  header.magic = package::crowns_magic;
  header.version = package::crowns_version;
  header.cell_count = cell_count;
  header.crown_count = crowns.size();
  header.file_bytes = package::crowns_file_bytes(cell_count, crowns.size());
  for (const auto& owned : crowns) header.largest_half_width_m = std::max(header.largest_half_width_m, owned.crown.half_width_m);
  return header;
}

void write(const fs::path& path, const Crowns& crowns, const CellRange& cells) {
  const std::vector<package::CrownCellRecord> records = cells_of(crowns, cells);
  const package::CrownsHeader header = header_of(crowns, records.size());
  std::ofstream file(path, std::ios::binary);
  const auto put = [&file](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(*first)));
  };
  put(&header, 1);
  put(records.data(), records.size());
  for (const auto& owned : crowns) put(&owned.crown, 1);
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

std::optional<package::CanopyFile> write_canopy(const fs::path& folder, CrownsOfCity& crowns) {
  if (crowns.empty()) return std::nullopt;
  const Crowns& in_order = crowns.in_order();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + " cannot be written: " + error.message());
  package::CanopyFile canopy;
  for (const auto& owned : in_order) ++canopy.crowns_of_shape[static_cast<std::size_t>(owned.crown.shape)];
  write_durably(folder / package::crowns_file, [&](const fs::path& part) {
    write(part, in_order, crowns.grid().cells);
    canopy.stamp = stamp_of(part);
  });
  in_order.let_go();
  return canopy;
}

}  // namespace farlod
