// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/zip_directory.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>

namespace farlod::ingest {
namespace {

// The format is described in APPNOTE.TXT of PKWARE: the end of the central directory in 4.3.16, its entries in 4.3.12
constexpr std::size_t end_bytes = 22, longest_comment = 0xFFFF, entry_bytes = 46;
constexpr std::string_view end_mark = "PK\5\6", entry_mark = "PK\1\2";
constexpr std::uint64_t in_large_format = 0xFFFFFFFF, locked_bit = 1;
// The large format (zip64) has its own end, 4.3.14, and a pointer to it before the end, 4.3.15
constexpr std::size_t pointer_bytes = 20, large_end_bytes = 56;
constexpr std::string_view pointer_mark = "PK\6\7", large_end_mark = "PK\6\6";
/// A directory of a hundred thousand names of usual length is a tenth of this.
constexpr std::uint64_t most_directory_bytes = std::uint64_t{256} << 20;

/// A number of `count` bytes, little-endian.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t k = count; k-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + k]);
  return number;
}

std::string read_at(std::ifstream& stream, std::uintmax_t place, std::size_t bytes) {
  std::string text(bytes, '\0');
  stream.seekg(static_cast<std::streamoff>(place));
  stream.read(text.data(), static_cast<std::streamsize>(bytes));
  return stream ? text : std::string();
}

/// Where the central directory is.
struct DirectoryPlace {
  std::uint64_t place = 0, bytes = 0;
};

/// The place that an archive of the large format says, or else its end. `tail`: the last bytes of the archive, its end at `end`.
DirectoryPlace directory_place(std::ifstream& stream, std::string_view tail, std::size_t end) {
  const DirectoryPlace small{number_at(tail, end + 16, 4), number_at(tail, end + 12, 4)};
  if (end < pointer_bytes || !tail.substr(end - pointer_bytes).starts_with(pointer_mark)) return small;
  const std::string large = read_at(stream, number_at(tail, end - pointer_bytes + 8, 8), large_end_bytes);
  if (!large.starts_with(large_end_mark)) return small;
  return {number_at(large, 48, 8), number_at(large, 40, 8)};
}

/// The bytes of the central directory. Its declared length is checked against the file before it is read.
std::string list_of(const std::filesystem::path& archive) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(archive, error);
  std::ifstream stream(archive, std::ios::binary);
  if (error || !stream || size < end_bytes) return {};
  const std::size_t tail_bytes =
      static_cast<std::size_t>(std::min<std::uintmax_t>(size, end_bytes + longest_comment + pointer_bytes));
  const std::string tail = read_at(stream, size - tail_bytes, tail_bytes);
  const std::size_t end = tail.rfind(end_mark);
  if (end == tail.npos || end + end_bytes > tail.size()) return {};
  const auto [place, bytes] = directory_place(stream, tail, end);
  if (place == in_large_format || bytes > std::min<std::uint64_t>(size, most_directory_bytes) || place > size - bytes) return {};
  return read_at(stream, place, static_cast<std::size_t>(bytes));
}

}  // namespace

std::vector<ZipListing> zip_listings(const std::filesystem::path& archive) {
  const std::string list = list_of(archive);
  std::vector<ZipListing> listings;
  for (std::string_view rest = list; rest.size() >= entry_bytes && rest.starts_with(entry_mark);) {
    const std::size_t name_bytes = number_at(rest, 28, 2), more_bytes = number_at(rest, 30, 2) + number_at(rest, 32, 2);
    listings.push_back({printable(rest.substr(entry_bytes, name_bytes)), (number_at(rest, 8, 2) & locked_bit) != 0});
    rest.remove_prefix(std::min(rest.size(), entry_bytes + name_bytes + more_bytes));
  }
  return listings;
}

std::string printable(std::string_view name) {
  std::string text(name);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return text;
}

bool leads_outside(std::string_view name) {
  if (name.starts_with('/') || name.starts_with('\\') || name.substr(0, 2).ends_with(':')) return true;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("/\\"), name.size());
    if (name.substr(0, end) == "..") return true;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return false;
}

}  // namespace farlod::ingest
