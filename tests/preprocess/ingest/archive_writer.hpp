// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace farlod::ingest::test {

/// How zlib frames what it packs: a zip archive has its own frame around bare bytes.
enum class PackedAs { bare = -MAX_WBITS, gzip = MAX_WBITS + 16 };

inline std::string packed(const std::string& text, PackedAs frame) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, static_cast<int>(frame), MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
    return {};
  std::string bytes(deflateBound(&stream, static_cast<uLong>(text.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

inline std::string gzip_of(const std::string& text) { return packed(text, PackedAs::gzip); }

/// A file within an archive.
struct ZipEntry {
  std::string name, text;
  std::uint32_t declared_bytes = 0;  ///< a lie about its size; 0: none
  bool is_locked = false;            ///< marked as such; the bytes are not
};

namespace zip_parts {

inline void put(std::string& bytes, std::uint32_t value, int count) {
  for (int k = 0; k < count; ++k, value >>= 8) bytes += static_cast<char>(value & 0xFF);
}

/// What the header before a file and the one in the list of files have in common.
inline std::string header(const ZipEntry& entry, const std::string& deflated) {
  const auto* text = reinterpret_cast<const Bytef*>(entry.text.data());
  const auto size = static_cast<std::uint32_t>(entry.text.size());
  std::string bytes;
  put(bytes, 20, 2);                                   // the version of the format
  put(bytes, 0x0800u + (entry.is_locked ? 1 : 0), 2);  // names are UTF-8
  put(bytes, 8, 2);                                    // deflated
  put(bytes, 0, 4);                                    // time
  put(bytes, static_cast<std::uint32_t>(crc32(0, text, static_cast<uInt>(entry.text.size()))), 4);
  put(bytes, static_cast<std::uint32_t>(deflated.size()), 4);
  put(bytes, entry.declared_bytes != 0 ? entry.declared_bytes : size, 4);
  put(bytes, static_cast<std::uint32_t>(entry.name.size()), 2);
  put(bytes, 0, 2);  // no further fields
  return bytes;
}

}  // namespace zip_parts

/// The bytes of a zip archive.
inline std::string zip_of(const std::vector<ZipEntry>& entries) {
  using zip_parts::put;
  std::string files, list;
  for (const ZipEntry& entry : entries) {
    const std::string deflated = packed(entry.text, PackedAs::bare), header = zip_parts::header(entry, deflated);
    const auto place = static_cast<std::uint32_t>(files.size());
    files += "PK\3\4" + header + entry.name + deflated;
    list += "PK\1\2";
    put(list, 20, 2);
    list += header;
    put(list, 0, 10);  // comment, disk, attributes
    put(list, place, 4);
    list += entry.name;
  }
  std::string end = "PK\5\6";
  put(end, 0, 4);
  for (int k = 0; k < 2; ++k) put(end, static_cast<std::uint32_t>(entries.size()), 2);
  put(end, static_cast<std::uint32_t>(list.size()), 4);
  put(end, static_cast<std::uint32_t>(files.size()), 4);
  put(end, 0, 2);
  return files + list + end;
}

}  // namespace farlod::ingest::test
