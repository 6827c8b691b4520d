// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <streambuf>
#include <string>
#include <vector>

namespace farlod::ingest {

/// The buffer of a stream that knows the place of the byte that is read next: a parser of JSON does not tell it.
class PlacedBuffer : public std::streambuf {
 public:
  /// Reads the stream piece by piece. What its buffer throws passes through.
  explicit PlacedBuffer(std::istream& source) : source_(&source), pieces_(piece_bytes) {}
  /// Reads a text that has a place in its file. The text must outlive it.
  PlacedBuffer(std::string& text, std::uint64_t begin) : begin_(begin) {
    setg(text.data(), text.data(), text.data() + text.size());
  }

  [[nodiscard]] std::uint64_t at() const { return begin_ + static_cast<std::uint64_t>(gptr() - eback()); }

 protected:
  int_type underflow() override {
    if (source_ == nullptr) return traits_type::eof();
    begin_ = at();
    source_->read(pieces_.data(), static_cast<std::streamsize>(pieces_.size()));
    setg(pieces_.data(), pieces_.data(), pieces_.data() + source_->gcount());
    return source_->gcount() == 0 ? traits_type::eof() : traits_type::to_int_type(pieces_.front());
  }

 private:
  static constexpr std::size_t piece_bytes = std::size_t{1} << 16;

  std::istream* source_ = nullptr;
  std::vector<char> pieces_;
  std::uint64_t begin_ = 0;  ///< of what the buffer holds
};

}  // namespace farlod::ingest
