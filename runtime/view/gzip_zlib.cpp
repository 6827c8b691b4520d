// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <limits>
#include <new>

#include "base/expects.hpp"
#include "view/gzip.hpp"

namespace farlod {
namespace {

constexpr int compression_level = 6;  // of tiles, 9 saves nothing, and takes ten times as long
constexpr int gzip_window_bits = 15 + 16, memory_level = 8;

}  // namespace

std::string gzipped(std::string_view bytes) {
  FARLOD_EXPECTS(bytes.size() < std::numeric_limits<uInt>::max() / 2);
  z_stream stream{};
  if (deflateInit2(&stream, compression_level, Z_DEFLATED, gzip_window_bits, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string file(deflateBound(&stream, bytes.size()), '\0');
  // zlib only reads there
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(file.data());
  stream.avail_out = static_cast<uInt>(file.size());
  const int ended = deflate(&stream, Z_FINISH);
  file.resize(stream.total_out);
  deflateEnd(&stream);
  FARLOD_EXPECTS(ended == Z_STREAM_END);
  return file;
}

}  // namespace farlod
