// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>

namespace farlod::ingest {

/// Work in pieces, each of which has a place until it ends. The number of places bounds what is in memory.
struct OrderedWork {
  std::function<bool(std::size_t place)> begin;  ///< puts the next piece there; false: none is left. In order, one at a time
  std::function<void(std::size_t place)> work;   ///< on all threads
  std::function<void(std::size_t place)> end;    ///< takes the piece out. In order, one at a time
};

/// Works on all threads of the task arena that it is called in, on as many pieces at a time as there are places. What one of the
/// three throws ends all work and is thrown on. The caller's data must outlive the call, and no piece is at two places.
void run_in_order(std::size_t places, const OrderedWork& work);

/// The number of threads of the task arena that it is called in.
[[nodiscard]] std::size_t threads_here();

/// As many places as keep the threads of the task arena at work that it is called in. Of more than 16 threads, the others would
/// wait: to end a piece takes a twentieth of the time that it takes to work on it (CityGML), or more.
[[nodiscard]] std::size_t places_for_threads();

/// Whether a path leads to a pipe: one with a name, or the standard input when another program writes to it.
[[nodiscard]] bool is_pipe(const std::filesystem::path& path);

/// A city that another program writes while it is read. A pipe gives its bytes once; its beginning is kept, so that the format
/// can be recognized first.
class InputPipe {
 public:
  explicit InputPipe(const std::filesystem::path& path) : name_(path.string()), rest_(path, std::ios::binary) {}

  /// The first bytes, at most so many. Before `take_all`.
  [[nodiscard]] const std::string& beginning(std::size_t most_bytes);
  /// All bytes. Throws InputError when it is called a second time.
  [[nodiscard]] std::unique_ptr<std::istream> take_all();

 private:
  std::string name_, beginning_;
  std::ifstream rest_;
  bool is_taken_ = false;
};

/// One file of a city: on the disk, a member of an archive, or a pipe.
struct InputFile {
  InputFile(const std::filesystem::path& file) : name(file.string()), path(file), on_disk(file) {}  // NOLINT: a file is an input
  InputFile(std::string shown, std::filesystem::path where, std::filesystem::path archive)
      : name(std::move(shown)), path(std::move(where)), on_disk(std::move(archive)) {}

  std::string name;                                   ///< in messages: "town.zip/tiles/a.gml"
  std::filesystem::path path;                         ///< to open it: the file, or GDAL's name for the member of an archive
  std::filesystem::path on_disk;                      ///< the file itself, or the archive that holds it
  std::optional<std::uintmax_t> declared_bytes = {};  ///< the unpacked size that the archive declares
  std::shared_ptr<InputPipe> pipe = {};               ///< what it is read from, if it is a pipe
  /// The user named it. A file that was found in a folder or an archive must not make us read other files.
  bool is_named = true;

  [[nodiscard]] bool is_packed() const { return path != on_disk; }
  /// The file name without folders and without `.gz`: "a.gml" of "town/a.gml.gz".
  [[nodiscard]] std::string unpacked_name() const;
  /// The file at a path relative to the folder of this one: in the same archive, or on the disk beside a .gz. It need not exist.
  [[nodiscard]] InputFile beside(const std::filesystem::path& relative) const;
};

/// The largest size that an archive may unpack to. City files shrink to a twentieth or a fortieth. An archive that shrinks to
/// less than a hundredth is taken for an attack that fills the disk. Small files are exempt, since runs of equal bytes shrink to
/// a thousandth.
[[nodiscard]] std::uintmax_t most_unpacked_bytes(std::uintmax_t packed_bytes);

/// The unpacked bytes of a file. Throws InputError when it cannot be opened. Reading throws InputError when an archive is damaged
/// or unpacks to more than most_unpacked_bytes. A pipe can be opened once.
[[nodiscard]] std::unique_ptr<std::istream> open_input(const InputFile& file);

/// The first unpacked bytes of a file, at most `most_bytes`. Throws as open_input does.
[[nodiscard]] std::string read_beginning(const InputFile& file, std::size_t most_bytes);

/// Whether bytes have places in the file as it lies on the disk, and its text those of ASCII: it is neither packed, nor a pipe,
/// nor in UTF-16.
[[nodiscard]] bool has_byte_places(const InputFile& file);

/// As read_beginning, for a small file beside a city, which need not exist.
[[nodiscard]] std::optional<std::string> find_beginning(const InputFile& file, std::size_t most_bytes);

}  // namespace farlod::ingest
