// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/input_pipe.hpp"

#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

#include "farlod/error.hpp"

namespace farlod::ingest {
namespace {

/// Gives the beginning, then the rest.
class PipeBuffer : public std::streambuf {
 public:
  PipeBuffer(std::string beginning, std::ifstream rest) : piece_(std::move(beginning)), rest_(std::move(rest)) {
    setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
  }

 protected:
  int_type underflow() override {
    constexpr std::size_t piece_bytes = std::size_t{1} << 20;
    piece_.resize(piece_bytes);
    rest_.read(piece_.data(), static_cast<std::streamsize>(piece_.size()));
    const std::streamsize count = rest_.gcount();
    setg(piece_.data(), piece_.data(), piece_.data() + count);
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(piece_[0]);
  }

 private:
  std::string piece_;
  std::ifstream rest_;
};

class PipeStream : public std::istream {
 public:
  PipeStream(std::string beginning, std::ifstream rest) : std::istream(nullptr), buffer_(std::move(beginning), std::move(rest)) {
    rdbuf(&buffer_);
  }

 private:
  PipeBuffer buffer_;
};

}  // namespace

bool is_pipe(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::is_fifo(path, unknown);
}

const std::string& InputPipe::beginning(std::size_t most_bytes) {
  const std::size_t known = beginning_.size();
  if (known < most_bytes) {
    beginning_.resize(most_bytes);
    rest_.read(beginning_.data() + known, static_cast<std::streamsize>(most_bytes - known));
    beginning_.resize(known + static_cast<std::size_t>(rest_.gcount()));
  }
  return beginning_;
}

std::unique_ptr<std::istream> InputPipe::take_all() {
  if (std::exchange(is_taken_, true))
    throw InputError(name_ + " is a pipe, and has to be read a second time: write it to a file first.");
  return std::make_unique<PipeStream>(std::move(beginning_), std::move(rest_));
}

}  // namespace farlod::ingest
