// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <array>
#include <fstream>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {
namespace {

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using PackedFile = std::unique_ptr<VSILFILE, CloseFile>;

/// Unpacks a file while it is read, and counts the bytes: they may neither exceed the limit nor end before the declared size.
class UnpackingBuffer : public std::streambuf {
 public:
  UnpackingBuffer(PackedFile packed, const InputFile& file)
      : file_(std::move(packed)), name_(file.name), declared_bytes_(file.declared_bytes) {
    std::error_code unknown;
    const std::uintmax_t packed_bytes = std::filesystem::file_size(file.on_disk, unknown);
    most_bytes_ = most_unpacked_bytes(unknown ? 0 : packed_bytes);
  }

 protected:
  int_type underflow() override {
    const GdalErrors errors;
    const std::size_t count = VSIFReadL(piece_.data(), 1, piece_.size(), file_.get());
    read_bytes_ += count;
    if (read_bytes_ > most_bytes_)
      throw InputError(name_ + " unpacks to more than " + std::to_string(most_bytes_ >> 20) +
                       " MiB, a hundred times its size: that is no city. Unpack it yourself if you trust it.");
    if (count == 0) require_end(errors);
    setg(piece_.data(), piece_.data(), piece_.data() + count);
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(piece_[0]);
  }

 private:
  void require_end(const GdalErrors& errors) const {
    if (!errors.any() && (!declared_bytes_ || read_bytes_ == *declared_bytes_)) return;
    throw InputError(name_ + " cannot be unpacked beyond " + std::to_string(read_bytes_) +
                     " bytes: the archive is damaged, cut short or locked by a password.");
  }

  PackedFile file_;
  std::string name_;
  std::uintmax_t read_bytes_ = 0, most_bytes_ = 0;
  std::optional<std::uintmax_t> declared_bytes_;
  std::array<char, std::size_t{1} << 16> piece_;
};

/// Rethrows the exceptions of its buffer. Without `badbit`, a stream treats them as the end of the file.
class UnpackingStream : public std::istream {
 public:
  UnpackingStream(PackedFile packed, const InputFile& file) : std::istream(nullptr), buffer_(std::move(packed), file) {
    rdbuf(&buffer_);
    exceptions(std::ios::badbit);
  }

 private:
  UnpackingBuffer buffer_;
};

std::unique_ptr<std::istream> try_to_open(const InputFile& file) {
  if (!file.is_packed()) {
    auto stream = std::make_unique<std::ifstream>(file.path, std::ios::binary);
    return *stream ? std::move(stream) : nullptr;
  }
  const GdalErrors quiet;
  // GDAL would otherwise write a file with the properties of a .gz beside it
  CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
  PackedFile packed(VSIFOpenL(file.path.c_str(), "rb"));
  return packed ? std::make_unique<UnpackingStream>(std::move(packed), file) : nullptr;
}

}  // namespace

std::unique_ptr<std::istream> open_input(const InputFile& file) {
  if (file.pipe) return file.pipe->take_all();
  if (auto stream = try_to_open(file)) return stream;
  if (file.is_packed())
    throw InputError(file.name + " cannot be unpacked: the archive is damaged, or packed in a way that is not known.");
  throw InputError(file.name + " cannot be opened. Check its permissions.");
}

std::optional<std::string> find_beginning(const InputFile& file, std::size_t most_bytes) {
  std::error_code error;
  if (!file.is_packed() && !std::filesystem::is_regular_file(file.path, error)) return std::nullopt;
  if (!try_to_open(file)) return std::nullopt;
  return read_beginning(file, most_bytes);
}

}  // namespace farlod::ingest
