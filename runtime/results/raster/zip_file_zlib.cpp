// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/zip_file.hpp"

#include <zlib.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"

namespace farlod {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The records of a ZIP file are little-endian numbers, one after the other.
class Record {
 public:
  Record& u16(std::uint64_t value) { return add(value, 2); }
  Record& u32(std::uint64_t value) { return add(value, 4); }
  Record& u64(std::uint64_t value) { return add(value, 8); }
  Record& text(const std::string& text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  Record& add(std::uint64_t value, unsigned int count) {
    for (unsigned int n = 0; n < count; ++n) bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * n));
    return *this;
  }
  Bytes bytes_;
};

constexpr std::uint64_t in_extra_field = 0xFFFFFFFF;  // a size that stands in the extra field of ZIP64
constexpr std::uint64_t version_needed = 45;          // of ZIP64
constexpr std::uint64_t first_day = 1 << 5 | 1;       // 1 January 1980
constexpr std::uint64_t zip64_field = 1;

std::uint64_t number_of(ZipFile::Method method) { return static_cast<std::uint64_t>(method); }

}  // namespace

ZipFile::ZipFile(const std::filesystem::path& path, std::filesystem::path result) : result_(std::move(result)) {
  errno = 0;
  stream_.open(path, std::ios::binary);
  write({});
}

void ZipFile::write(std::span<const std::uint8_t> bytes) {
  stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) throw OutputError(result_, errno != 0 ? std::generic_category().message(errno) : "the disk refused the data");
  end_ += bytes.size();
}

/// It has the sizes in the extra field, since they are not known before the pieces are.
void ZipFile::write_local_header(const Member& m) {
  Record record;
  record.u32(0x04034B50).u16(version_needed).u16(0).u16(number_of(m.method)).u16(0).u16(first_day).u32(m.crc);
  record.u32(in_extra_field).u32(in_extra_field).u16(m.name.size()).u16(20).text(m.name);
  write(record.u16(zip64_field).u16(16).u64(m.bytes).u64(m.bytes_in_file).bytes());
}

void ZipFile::begin(std::string name, Method method) {
  members_.push_back({.name = std::move(name), .method = method, .place = end_});
  write_local_header(members_.back());
}

void ZipFile::append(std::span<const std::uint8_t> piece, std::uint64_t bytes, std::uint32_t crc) {
  write(piece);
  Member& member = members_.back();
  member.crc = static_cast<std::uint32_t>(crc32_combine(member.crc, crc, static_cast<z_off_t>(bytes)));
  member.bytes += bytes;
  member.bytes_in_file += piece.size();
}

void ZipFile::end() {
  const std::uint64_t end = end_;
  stream_.seekp(static_cast<std::streamoff>(members_.back().place));
  write_local_header(members_.back());
  stream_.seekp(static_cast<std::streamoff>(end));
  end_ = end;
}

void ZipFile::add(const std::filesystem::path& file) {
  constexpr std::size_t bytes_at_once = 1 << 20;
  begin(file.filename().string(), Method::stored);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  Bytes piece(bytes_at_once);
  while (stream.read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(piece.size())) || stream.gcount() > 0) {
    const auto count = static_cast<std::size_t>(stream.gcount());
    append(std::span(piece).first(count), count, static_cast<std::uint32_t>(crc32(0, piece.data(), static_cast<uInt>(count))));
  }
  if (!stream.eof())
    throw OutputError(result_, file.filename().string() + " cannot be read back: " + std::generic_category().message(errno));
  end();
}

void ZipFile::write_central_directory() {
  for (const Member& m : members_) {
    Record record;
    record.u32(0x02014B50).u16(version_needed).u16(version_needed).u16(0).u16(number_of(m.method)).u16(0).u16(first_day);
    record.u32(m.crc).u32(in_extra_field).u32(in_extra_field).u16(m.name.size()).u16(28).u16(0).u16(0).u16(0).u32(0);
    record.u32(in_extra_field).text(m.name);
    write(record.u16(zip64_field).u16(24).u64(m.bytes).u64(m.bytes_in_file).u64(m.place).bytes());
  }
}

void ZipFile::close() {
  const std::uint64_t directory = end_;
  write_central_directory();
  const std::uint64_t bytes = end_ - directory, count = members_.size(), end_of_directory = end_;
  // ZIP64: where the directory is, and where that is told
  Record record;
  record.u32(0x06064B50).u64(44).u16(version_needed).u16(version_needed).u32(0).u32(0).u64(count).u64(count);
  record.u64(bytes).u64(directory).u32(0x07064B50).u32(0).u64(end_of_directory).u32(1);
  record.u32(0x06054B50).u16(0).u16(0).u16(count).u16(count).u32(bytes).u32(in_extra_field).u16(0);
  write(record.bytes());
  stream_.close();
  write({});
}

}  // namespace farlod
