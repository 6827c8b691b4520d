// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>

namespace farlod::ingest {

/// One file of a city, wherever it lies: on its own, or within an archive.
struct InputFile {
  InputFile(const std::filesystem::path& file) : name(file.string()), path(file), on_disk(file) {}  // NOLINT: a file is an input
  InputFile(std::string shown, std::filesystem::path where, std::filesystem::path archive)
      : name(std::move(shown)), path(std::move(where)), on_disk(std::move(archive)) {}

  std::string name;                                   ///< for people: "town.zip/tiles/a.gml"
  std::filesystem::path path;                         ///< for programs: the file, or GDAL's name for the member of an archive
  std::filesystem::path on_disk;                      ///< the file itself, or the archive that holds it
  std::optional<std::uintmax_t> declared_bytes = {};  ///< what an archive says that its member unpacks to

  [[nodiscard]] bool is_packed() const { return path != on_disk; }
  /// Without folders, and without the ending of a packed file: "a.gml" of "town/a.gml.gz".
  [[nodiscard]] std::string unpacked_name() const;
  /// A file that lies relative to this one: in the same archive, or on the disk beside a .gz. It need not exist.
  [[nodiscard]] InputFile beside(const std::filesystem::path& relative) const;
};

/// What the bytes of an archive may unpack to. Real city files shrink to a twentieth or a fortieth; what claims to shrink to less
/// than a hundredth is made to fill a disk. Small files are below suspicion, as runs of equal bytes shrink a thousandfold.
[[nodiscard]] std::uintmax_t most_unpacked_bytes(std::uintmax_t packed_bytes);

/// The bytes of a file, unpacked, from the beginning. Throws InputError when it cannot be opened, and while it is read when an
/// archive is damaged or unpacks to more than most_unpacked_bytes.
[[nodiscard]] std::unique_ptr<std::istream> open_input(const InputFile& file);

/// The first bytes of a file, unpacked: all of them when it has no more than `most_bytes`. Throws as open_input does.
[[nodiscard]] std::string read_beginning(const InputFile& file, std::size_t most_bytes);

/// All bytes of a file, unpacked. Throws as open_input does.
[[nodiscard]] std::string read_whole(const InputFile& file);

/// The same for a file that need not exist, as small files beside a city do.
[[nodiscard]] std::optional<std::string> find_beginning(const InputFile& file, std::size_t most_bytes);

}  // namespace farlod::ingest
