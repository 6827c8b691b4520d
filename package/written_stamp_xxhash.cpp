// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <fstream>
#include <memory>
#include <system_error>
#include <vector>

#include "farlod/error.hpp"
#include "package/crown_layout.hpp"
#include "package/layout.hpp"
#include "package/sources_layout.hpp"
#include "package/written_stamp.hpp"

namespace farlod {

package::FileStamp stamp_of(std::span<const std::byte> bytes) { return {bytes.size(), XXH3_64bits(bytes.data(), bytes.size())}; }

package::FileStamp stamp_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  package::FileStamp stamp;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    XXH3_64bits_update(state.get(), buffer.data(), static_cast<std::size_t>(file.gcount()));
    stamp.bytes += static_cast<std::uint64_t>(file.gcount());
  }
  if (!file.eof()) throw InputError(path.string() + " cannot be read");
  stamp.xxh3 = XXH3_64bits_digest(state.get());
  return stamp;
}

namespace {

bool is_whole(const std::filesystem::path& path, const package::FileStamp& stamp) {
  std::error_code unread;
  if (!std::filesystem::is_regular_file(path, unread) || std::filesystem::file_size(path, unread) != stamp.bytes) return false;
  try {
    return stamp_of(path) == stamp;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool are_whole(const std::filesystem::path& package, const package::BlockFiles& files) {
  const std::filesystem::path folder = package / package::folder_of(files);
  return is_whole(folder / package::tiles_file, files.tiles) &&
         (!files.has_far_maps() || is_whole(folder / package::far_map_file, files.far_map));
}

bool are_others_whole(const std::filesystem::path& package, const package::Manifest& manifest) {
  return (!manifest.canopy || is_whole(package / package::crowns_file, manifest.canopy->stamp)) &&
         (!manifest.sources || is_whole(package / package::sources_file, *manifest.sources));
}

}  // namespace farlod
