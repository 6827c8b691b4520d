// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/input_file.hpp"

#include <algorithm>
#include <limits>

#include "ingest/files/file_ending.hpp"

namespace farlod::ingest {
namespace {

constexpr std::uintmax_t most_times_smaller = 100;
constexpr std::uintmax_t below_suspicion_bytes = std::uintmax_t{64} << 20;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

bool is_gzip_member(const InputFile& file) { return file.path.string().starts_with("/vsigzip/"); }

std::string read_from(std::istream& stream, std::size_t most_bytes) {
  std::string text;
  while (stream && text.size() < most_bytes) {
    const std::size_t known = text.size();
    text.resize(known + std::min(piece_bytes, most_bytes - known));
    stream.read(text.data() + known, static_cast<std::streamsize>(text.size() - known));
    text.resize(known + static_cast<std::size_t>(stream.gcount()));
  }
  return text;
}

}  // namespace

std::string InputFile::unpacked_name() const {
  std::string file_name = std::filesystem::path(name).filename().string();
  if (is_gzip_member(*this) && ends_with_any(file_name, {".gz"})) file_name.resize(file_name.size() - 3);
  return file_name;
}

InputFile InputFile::beside(const std::filesystem::path& relative) const {
  const std::filesystem::path shown = (std::filesystem::path(name).parent_path() / relative).lexically_normal();
  if (!is_packed() || is_gzip_member(*this)) return {(on_disk.parent_path() / relative).lexically_normal()};
  return {shown.string(), (path.parent_path() / relative).lexically_normal(), on_disk};
}

std::uintmax_t most_unpacked_bytes(std::uintmax_t packed_bytes) {
  const bool is_beyond_count = packed_bytes > std::numeric_limits<std::uintmax_t>::max() / most_times_smaller;
  return is_beyond_count ? std::numeric_limits<std::uintmax_t>::max()
                         : std::max(below_suspicion_bytes, most_times_smaller * packed_bytes);
}

std::string read_beginning(const InputFile& file, std::size_t most_bytes) {
  return file.pipe ? file.pipe->beginning(most_bytes).substr(0, most_bytes) : read_from(*open_input(file), most_bytes);
}

bool has_byte_places(const InputFile& file) {
  constexpr std::size_t marked_bytes = 2;
  if (file.pipe || file.is_packed()) return false;
  const std::string beginning = read_beginning(file, marked_bytes);
  const bool is_marked = beginning == "\xff\xfe" || beginning == "\xfe\xff";
  return !is_marked && beginning.find('\0') == beginning.npos;
}

}  // namespace farlod::ingest
