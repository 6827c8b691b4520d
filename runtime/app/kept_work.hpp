// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/svf_options.hpp"
#include "farlod/answer_file.hpp"
#include "farlod/package.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// The folder beside an output, OUT.unfinished, in which a run keeps the answers that it has, for the case that it does not come
/// to its end: the same command goes on from there. Shards keep theirs in it, until they are merged.
///   answers                  of a run that is no shard
///   3_of_8.answers, .done    of a shard, and that it has all of its answers
class KeptWork {
 public:
  /// Opens what is to be kept, or what is to be merged. Throws OutputError, which names the option that differs or the shard that
  /// is missing; Busy.
  KeptWork(const SvfOptions& options, const PackageDescription& package);
  KeptWork(const KeptWork&) = delete;
  KeptWork& operator=(const KeptWork&) = delete;
  /// Removes the folder where it holds no answers.
  ~KeptWork();

  /// Tells a run what is kept, and which part of the work it has.
  void tell(RunSettings& run) const;
  /// What was found, for the user; empty if nothing.
  [[nodiscard]] const std::string& finding() const { return finding_; }
  /// The output is written, or the shard has all of its answers.
  void finish();

 private:
  void open_own(const SvfOptions& options, const AnswerKey& key);
  void open_shards(const SvfOptions& options, const AnswerKey& key);

  std::filesystem::path folder_;
  std::optional<Shard> shard_;
  std::shared_ptr<AnswerFile> answers_;  ///< null where nothing is kept
  std::string finding_;
};

}  // namespace farlod
