// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/input_file.hpp"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <streambuf>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"

namespace farlod::ingest {

void run_in_order(std::size_t places, const OrderedWork& work) {
  using oneapi::tbb::filter_mode, oneapi::tbb::make_filter;
  // Pieces end in their order, so that those at work follow each other, and each has a place of its own. What the pipeline itself
  // held when work ends early, oneTBB would lose
  std::size_t next = 0;
  const auto begin = [&](oneapi::tbb::flow_control& flow) {
    const std::size_t place = next++ % places;
    if (!work.begin(place)) flow.stop();
    return place;
  };
  const auto do_work = [&](std::size_t place) {
    work.work(place);
    return place;
  };
  // A thread that waits for its last pieces does not begin a piece of the work around this one, for which others would wait
  oneapi::tbb::this_task_arena::isolate([&] {
    oneapi::tbb::parallel_pipeline(places, make_filter<void, std::size_t>(filter_mode::serial_in_order, begin) &
                                               make_filter<std::size_t, std::size_t>(filter_mode::parallel, do_work) &
                                               make_filter<std::size_t, void>(filter_mode::serial_in_order, work.end));
  });
}

std::size_t threads_here() { return static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency()); }

std::size_t places_for_threads() {
  constexpr std::size_t places_of_a_thread = 2, most_threads = 16;
  return places_of_a_thread * std::min(threads_here(), most_threads);
}

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
