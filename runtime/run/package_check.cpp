// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>

#include "base/cancellation.hpp"
#include "base/run_settings.hpp"
#include "farlod/inspection.hpp"
#include "package/package_reader.hpp"
#include "package/sources_file.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"

namespace farlod {
namespace {

/// Tells the caller, one thread at a time, how many bytes of the package were read.
class BytesRead {
 public:
  BytesRead(const package::Manifest& manifest, const RunSettings& run) : run_(run) {
    for (const package::BlockFiles& files : manifest.blocks) all_ += files.tiles.bytes + files.far_map.bytes;
    if (manifest.canopy) all_ += manifest.canopy->stamp.bytes;
    if (manifest.sources) all_ += manifest.sources->bytes;
    if (manifest.far_terrain) all_ += manifest.far_terrain->bytes;
    if (manifest.heights()) all_ += manifest.heights()->bytes;
  }
  void add(std::uint64_t bytes) {
    throw_if_cancelled(run_.stop);
    if (!run_.on_progress) return;
    const std::lock_guard lock(mutex_);
    done_ += bytes;
    run_.on_progress({"check", static_cast<std::size_t>(done_), static_cast<std::size_t>(all_)});
  }

 private:
  const RunSettings& run_;
  std::uint64_t all_ = 0, done_ = 0;
  std::mutex mutex_;
};

/// What came of a block.
struct CheckedBlock {
  std::vector<BlockDamage> damage;
  std::optional<std::uint64_t> triangles;
  std::uint64_t cells = 0, far_maps = 0;
};

/// Decodes the far maps of a block on the threads that have nothing else to do.
void check_far_maps(const BlockCheck& block, std::uint64_t bytes_of_file, BytesRead& read, CheckedBlock& checked) {
  const std::vector<Cell>& cells = block.mapped_cells();
  std::vector<std::optional<BlockDamage>> found(cells.size());
  // Whoever waits here does not begin another block, so that no more blocks are open than there are threads
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
      found[n] = block.check_far_map(cells[n]);
      read.add(bytes_of_file * (n + 1) / cells.size() - bytes_of_file * n / cells.size());
    });
  });
  for (std::optional<BlockDamage>& damage : found) {
    checked.far_maps += damage ? 0 : 1;
    if (damage) checked.damage.push_back(std::move(*damage));
  }
  if (cells.empty()) read.add(bytes_of_file);
}

CheckedBlock check_block(const PackageContents& contents, std::size_t n, BytesRead& read) {
  const package::Manifest& manifest = contents.reader.manifest();
  const BlockCheck block(contents.reader.folder(), manifest, n);
  CheckedBlock checked{block.damage(), block.triangles(), 0, 0};
  if (checked.triangles) checked.cells = static_cast<std::uint64_t>(block.cell_count());
  read.add(manifest.blocks[n].tiles.bytes);
  check_far_maps(block, manifest.blocks[n].far_map.bytes, read, checked);
  return checked;
}

/// A file of the whole city, which `open` checks; none where there is no stamp.
void check_file(const char* name, const std::optional<package::FileStamp>& stamp, const std::function<void()>& open,
                BytesRead& read, PackageCheck& check) {
  if (!stamp) return;
  ++check.files;
  check.bytes += stamp->bytes;
  try {
    open();
  } catch (const PackageDamaged& error) {
    check.damage.push_back({name, std::nullopt, error.what()});
  } catch (const PackageUnusable& error) {
    // A version that is not the manifest's
    check.damage.push_back({name, std::nullopt, error.what()});
  }
  read.add(stamp->bytes);
}

void check_files_of_city(const PackageContents& contents, BytesRead& read, PackageCheck& check) {
  const PackageFolder& folder = contents.reader.folder();
  const package::Manifest& m = contents.reader.manifest();
  const std::optional<package::FileStamp> crowns = m.canopy ? std::optional(m.canopy->stamp) : std::nullopt;
  check_file(
      package::crowns_file, crowns, [&] { check.crowns = CrownsFile(folder, m).crowns().size(); }, read, check);
  check_file(
      package::sources_file, m.sources, [&] { (void)SourcesFile(folder, m); }, read, check);
  check_file(
      package::far_terrain_file, m.far_terrain, [&] { (void)FarTerrainFile(folder, m); }, read, check);
  check_file(
      package::heights_file, m.heights(), [&] { (void)PixelHeightsFile(folder, m); }, read, check);
}

/// The blocks together; what can be said of the package as a whole comes last.
PackageCheck summed(const PackageContents& contents, const std::vector<CheckedBlock>& blocks) {
  const package::Manifest& manifest = contents.reader.manifest();
  PackageCheck check;
  std::optional<std::uint64_t> triangles = 0;
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const package::BlockFiles& files = manifest.blocks[n];
    check.files += files.has_far_maps() ? 2 : 1;
    check.bytes += files.tiles.bytes + files.far_map.bytes;
    check.cells += blocks[n].cells;
    check.far_maps += blocks[n].far_maps;
    triangles = triangles && blocks[n].triangles ? std::optional(*triangles + *blocks[n].triangles) : std::nullopt;
    for (const BlockDamage& d : blocks[n].damage)
      check.damage.push_back({d.file.lexically_relative(contents.folder).generic_string(),
                              d.cell ? std::optional(CellPlace{d.cell->i, d.cell->j}) : std::nullopt, d.what});
  }
  // Those that no file of tiles has are counted when their file is checked
  if (triangles && manifest.pixels) *triangles += 2 * manifest.pixels->squares.value_or(0);
  if (triangles && *triangles != manifest.triangles)
    check.damage.push_back({package::manifest_file, std::nullopt,
                            (contents.folder / package::manifest_file).string() + " is damaged: it counts " +
                                std::to_string(manifest.triangles) + " triangles, the tiles have " + std::to_string(*triangles) +
                                ". Pack the city again."});
  return check;
}

/// What each thread holds: the largest block, and the slopes or distances of a map.
double bytes_of_thread(const package::Manifest& manifest) {
  constexpr double bytes_of_pixel = 4 * sizeof(float);
  std::uint64_t largest = 0;
  for (const package::BlockFiles& files : manifest.blocks) largest = std::max(largest, files.tiles.bytes + files.far_map.bytes);
  return static_cast<double>(largest) +
         bytes_of_pixel * manifest.far_map.picture_columns() * static_cast<double>(manifest.far_map.picture_rows());
}

}  // namespace

PackageCheck check_package(const Package& package, const RunSettings& run) {
  require_usable(run);
  // Kept, even when the caller closes the package meanwhile. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
  const std::shared_ptr<PackageContents> contents = package.contents();
  const package::Manifest& manifest = contents->reader.manifest();
  const std::size_t threads = std::min(thread_count(run), manifest.blocks.size());
  const double bytes_of_crowns = manifest.canopy ? static_cast<double>(manifest.canopy->stamp.bytes) : 0.0;
  require_memory(run, std::max(static_cast<double>(threads) * bytes_of_thread(manifest), bytes_of_crowns), "checking the package",
                 "use fewer threads");
  BytesRead read(manifest, run);
  std::vector<CheckedBlock> blocks(manifest.blocks.size());
  oneapi::tbb::task_arena arena(static_cast<int>(thread_count(run)));
  arena.execute([&] {
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, blocks.size(), 1),
        [&](const oneapi::tbb::blocked_range<std::size_t>& part) {
          for (std::size_t n = part.begin(); n < part.end(); ++n) blocks[n] = check_block(*contents, n, read);
        },
        oneapi::tbb::simple_partitioner());
  });
  PackageCheck check = summed(*contents, blocks);
  check_files_of_city(*contents, read, check);
  return check;
}

}  // namespace farlod
