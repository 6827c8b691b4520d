// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/kept_work.hpp"

#include <fmt/core.h>

#include <fstream>
#include <regex>
#include <set>
#include <system_error>
#include <vector>

#include "app/result_key.hpp"
#include "base/durable_file.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

std::string name_of(Shard shard) { return fmt::format("{}_of_{}", shard.index, shard.count); }

/// How many shards there are by the names of their files.
std::set<std::size_t> shard_counts_in(const fs::path& folder) {
  static const std::regex of_shard(R"([0-9]+_of_([0-9]+)\.(answers|done))");
  std::set<std::size_t> counts;
  std::error_code unread;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unread)) {
    std::smatch match;
    const std::string name = entry.path().filename().string();
    if (std::regex_match(name, match, of_shard)) counts.insert(std::stoul(match[1]));
  }
  return counts;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, error.message());
}

}  // namespace

KeptWork::KeptWork(const SvfOptions& options, const PackageDescription& package)
    : folder_(options.output.string() + ".unfinished"), shard_(options.shard) {
  // Single places and estimates take no time
  if (options.source == ReceiverSource::at || options.evaluation.dry_run) return;
  const AnswerKey key = key_of_answers(options, package);
  options.merge ? open_shards(options, key) : open_own(options, key);
}

void KeptWork::open_own(const SvfOptions& options, const AnswerKey& key) {
  make_folder(folder_);
  const auto of_another = options.resume || shard_ ? AnswerFile::OfAnotherKey::refuse : AnswerFile::OfAnotherKey::replace;
  if (shard_) {
    for (const std::size_t count : shard_counts_in(folder_))
      if (count != shard_->count)
        throw OutputError(
            fmt::format("{} is being computed in {} shards, and --shard says {}: give the same number to all, or "
                        "remove {}.",
                        options.output.string(), count, shard_->count, folder_.string()));
  }
  const fs::path file = folder_ / (shard_ ? name_of(*shard_) + ".answers" : "answers");
  answers_ = std::make_shared<AnswerFile>(AnswerFile::open(file, key, of_another));
  if (!answers_->replaced().empty())
    finding_ = "Removed what an earlier run had left of other answers (" + answers_->replaced() + ").";
  else if (answers_->cells() > 0)
    finding_ = fmt::format("Going on with what an earlier run has left: the answers of {} cells.", answers_->cells());
}

void KeptWork::open_shards(const SvfOptions& options, const AnswerKey& key) {
  const std::set<std::size_t> counts = shard_counts_in(folder_);
  if (counts.empty())
    throw OutputError(
        fmt::format("there is nothing to merge into {}: no shard has computed a part of it (--shard).", options.output.string()));
  if (counts.size() > 1)
    throw OutputError(fmt::format("{} holds shards of {} and of {}: remove those that are not wanted.", folder_.string(),
                                  *counts.begin(), *counts.rbegin()));
  std::vector<fs::path> files;
  std::string missing;
  for (Shard shard{0, *counts.begin()}; shard.index < shard.count; ++shard.index) {
    files.push_back(folder_ / (name_of(shard) + ".answers"));
    if (!fs::exists(folder_ / (name_of(shard) + ".done")))
      missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", shard.index, shard.count);
  }
  if (!missing.empty())
    throw OutputError(
        fmt::format("{} is not complete: these shards are missing: {}. Run them, then merge.", options.output.string(), missing));
  answers_ = std::make_shared<AnswerFile>(AnswerFile::together(files, key));
}

KeptWork::~KeptWork() {
  if (!answers_) return;
  const bool is_own = !answers_->is_read_only();
  if (!is_own || answers_->cells() > 0) return;
  std::error_code ignored;
  fs::remove(folder_ / (shard_ ? name_of(*shard_) + ".answers" : "answers"), ignored);
  fs::remove(folder_, ignored);  // where it is empty now
}

void KeptWork::tell(RunSettings& run) const {
  run.answers = answers_;
  run.shard = shard_;
}

void KeptWork::finish() {
  if (!answers_) return;
  if (shard_) return write_durably(folder_ / (name_of(*shard_) + ".done"), std::string_view(""));
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  answers_.reset();
}

}  // namespace farlod
