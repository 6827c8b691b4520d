// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <system_error>

#include "base/expects.hpp"
#include "base/file_lock.hpp"
#include "farlod/answer_file.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

/// Before the bytes of a cell.
struct CellHead {
  std::uint64_t cell, bytes, xxh3;
};
/// Before the cells: the key, as text.
struct FileHead {
  std::array<char, 8> magic;
  std::uint64_t key_bytes, key_xxh3;
};
constexpr std::array<char, 8> magic{'F', 'A', 'R', 'L', 'O', 'D', 'A', '1'};
/// More than any key or cell has.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 34;

/// Each name and each value, with a zero behind it.
std::string text_of(const AnswerKey& key) {
  std::string text;
  for (const auto& [name, value] : key) text.append(name).append(1, '\0').append(value).append(1, '\0');
  return text;
}
AnswerKey key_from(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    words.emplace_back(text.c_str() + at);
    at += words.back().size() + 1;
  }
  AnswerKey key;
  for (std::size_t n = 0; n + 1 < words.size(); n += 2) key.emplace_back(words[n], words[n + 1]);
  return key;
}

/// "--height was 1.5, and is 2": a value that differs, if any does, for what is given in one run alone may follow from that.
/// Empty if nothing differs.
std::string difference(const AnswerKey& was, const AnswerKey& is) {
  const std::map<std::string, std::string> before(was.begin(), was.end()), now(is.begin(), is.end());
  std::set<std::string> names;
  for (const auto* values : {&before, &now})
    for (const auto& [name, value] : *values) names.insert(name);
  std::string first;
  for (const std::string& name : names) {
    const auto old_value = before.find(name), value = now.find(name);
    const bool was_given = old_value != before.end(), is_given = value != now.end();
    if (was_given && is_given && old_value->second != value->second)
      return name + " was " + old_value->second + ", and is " + value->second;
    if (!first.empty() || (was_given && is_given)) continue;
    first =
        was_given ? name + " was " + old_value->second + ", and is not given" : name + " was not given, and is " + value->second;
  }
  return first;
}

/// A descriptor of a file, with reading and writing at places.
class PlacedFile {
 public:
  PlacedFile(std::filesystem::path path, int flags)
      : path_(std::move(path)), file_(::open(path_.c_str(), flags | O_CLOEXEC, 0666)) {
    if (file_ < 0) throw OutputError(path_, std::generic_category().message(errno));
  }
  PlacedFile(PlacedFile&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
  PlacedFile& operator=(PlacedFile&&) = delete;
  ~PlacedFile() {
    if (file_ >= 0) close(file_);
  }

  /// False at the end of the file.
  [[nodiscard]] bool read(std::uint64_t place, void* to, std::size_t bytes) const {
    auto* at = static_cast<std::byte*>(to);
    while (bytes > 0) {
      const ssize_t count = pread(file_, at, bytes, static_cast<off_t>(place));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      at += count;
      place += static_cast<std::uint64_t>(count);
      bytes -= static_cast<std::size_t>(count);
    }
    return true;
  }
  void write(std::uint64_t place, const void* from, std::size_t bytes) const {
    const auto* at = static_cast<const std::byte*>(from);
    while (bytes > 0) {
      const ssize_t count = pwrite(file_, at, bytes, static_cast<off_t>(place));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw OutputError(path_, std::generic_category().message(errno));
      at += count;
      place += static_cast<std::uint64_t>(count);
      bytes -= static_cast<std::size_t>(count);
    }
  }
  void cut(std::uint64_t bytes) const {
    if (ftruncate(file_, static_cast<off_t>(bytes)) != 0) throw OutputError(path_, std::generic_category().message(errno));
  }
  [[nodiscard]] std::uint64_t size() const {
    struct stat found {};
    return fstat(file_, &found) == 0 ? static_cast<std::uint64_t>(found.st_size) : 0;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int file_;
};

/// The key of a file, if it is one of ours.
std::optional<AnswerKey> read_key(const PlacedFile& file, std::uint64_t& end) {
  FileHead head{};
  if (!file.read(0, &head, sizeof(head)) || head.magic != magic || head.key_bytes > most_bytes) return std::nullopt;
  if (head.key_bytes > file.size()) return std::nullopt;
  std::string text(head.key_bytes, '\0');
  if (!file.read(sizeof(head), text.data(), text.size()) || XXH3_64bits(text.data(), text.size()) != head.key_xxh3)
    return std::nullopt;
  end = sizeof(head) + text.size();
  return key_from(text);
}

std::uint64_t write_key(const PlacedFile& file, const AnswerKey& key) {
  const std::string text = text_of(key);
  const FileHead head{magic, text.size(), XXH3_64bits(text.data(), text.size())};
  file.cut(0);
  file.write(0, &head, sizeof(head));
  file.write(sizeof(head), text.data(), text.size());
  return sizeof(head) + text.size();
}

}  // namespace

struct AnswerFile::Contents {
  /// Where the bytes of a cell are.
  struct Place {
    std::size_t file;
    std::uint64_t begin, bytes, xxh3;
  };
  std::vector<PlacedFile> files;
  std::optional<FileLock> lock;  ///< of a file that is written
  std::uint64_t end = 0;
  bool is_read_only = false;
  std::string replaced;
  std::map<std::uint64_t, Place> places;
  std::mutex mutex;

  /// Finds the cells from `begin` on. Returns where what is whole ends.
  std::uint64_t find_cells(std::size_t n, std::uint64_t begin) {
    const PlacedFile& file = files[n];
    const std::uint64_t size = file.size();
    CellHead head{};
    while (begin + sizeof(head) <= size && file.read(begin, &head, sizeof(head))) {
      const std::uint64_t left = size - begin - sizeof(head);
      if (head.bytes > left) break;
      places[head.cell] = {n, begin + sizeof(head), head.bytes, head.xxh3};
      begin += sizeof(head) + head.bytes;
    }
    return begin;
  }
};

AnswerFile::AnswerFile(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
AnswerFile::AnswerFile(AnswerFile&&) noexcept = default;
AnswerFile& AnswerFile::operator=(AnswerFile&&) noexcept = default;
AnswerFile::~AnswerFile() = default;

AnswerFile AnswerFile::open(const std::filesystem::path& path, const AnswerKey& key, OfAnotherKey of_another) {
  auto contents = std::make_unique<Contents>();
  contents->lock = FileLock::try_lock(path, LockKind::exclusive);
  if (!contents->lock) throw Busy("another process is at work on " + path.string() + ": wait for it, or choose another output.");
  contents->files.emplace_back(path, O_RDWR | O_CREAT);
  const PlacedFile& file = contents->files.front();
  const bool is_new = file.size() == 0;
  if (const auto there = read_key(file, contents->end)) {
    const std::string what = difference(*there, key);
    if (what.empty()) {
      contents->end = contents->find_cells(0, contents->end);
      file.cut(contents->end);
      return AnswerFile(std::move(contents));
    }
    if (of_another == OfAnotherKey::refuse)
      throw OutputError(path.string() + " has answers of another run: " + what + ". Give the same options, or remove it.");
    contents->replaced = what;
  } else if (!is_new && of_another == OfAnotherKey::refuse) {
    throw OutputError(path.string() + " is damaged: remove it, and what it held is computed again.");
  }
  contents->end = write_key(file, key);
  return AnswerFile(std::move(contents));
}

AnswerFile AnswerFile::together(const std::vector<std::filesystem::path>& paths, const AnswerKey& key) {
  auto contents = std::make_unique<Contents>();
  contents->is_read_only = true;
  for (const std::filesystem::path& path : paths) {
    contents->files.emplace_back(path, O_RDONLY);
    std::uint64_t end = 0;
    const auto there = read_key(contents->files.back(), end);
    if (!there) throw OutputError(path.string() + " is damaged: run its shard again.");
    if (const std::string what = difference(*there, key); !what.empty())
      throw OutputError(path.string() + " has answers of another run: " + what + ". Give what the shards were given.");
    (void)contents->find_cells(contents->files.size() - 1, end);
  }
  return AnswerFile(std::move(contents));
}

std::size_t AnswerFile::cells() const {
  const std::lock_guard lock(contents_->mutex);
  return contents_->places.size();
}

const std::string& AnswerFile::replaced() const { return contents_->replaced; }

bool AnswerFile::is_read_only() const { return contents_->is_read_only; }

std::optional<std::vector<std::byte>> AnswerFile::find(std::uint64_t cell) const {
  Contents::Place place{};
  {
    const std::lock_guard lock(contents_->mutex);
    const auto found = contents_->places.find(cell);
    if (found == contents_->places.end()) return std::nullopt;
    place = found->second;
  }
  std::vector<std::byte> bytes(place.bytes);
  if (!contents_->files[place.file].read(place.begin, bytes.data(), bytes.size())) return std::nullopt;
  if (XXH3_64bits(bytes.data(), bytes.size()) != place.xxh3) return std::nullopt;
  return bytes;
}

void AnswerFile::keep(std::uint64_t cell, const std::vector<std::byte>& bytes) const {
  FARLOD_EXPECTS(!contents_->is_read_only);
  const CellHead head{cell, bytes.size(), XXH3_64bits(bytes.data(), bytes.size())};
  // In one piece, so that a kill leaves a whole cell or the beginning of one
  std::vector<std::byte> all(sizeof(head) + bytes.size());
  std::memcpy(all.data(), &head, sizeof(head));
  if (!bytes.empty()) std::memcpy(all.data() + sizeof(head), bytes.data(), bytes.size());
  const std::lock_guard lock(contents_->mutex);
  contents_->files.front().write(contents_->end, all.data(), all.size());
  contents_->places[cell] = {0, contents_->end + sizeof(head), bytes.size(), head.xxh3};
  contents_->end += all.size();
}

}  // namespace farlod
