// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>

#include "farlod/answer_file.hpp"
#include "farlod/shard.hpp"

namespace farlod {

/// How far a run is: `done` of `all` parts of a stage, such as "tiles" or "sky view factors".
struct Progress {
  std::string_view stage;  ///< valid during the call only
  std::size_t done = 0, all = 0;
};

/// How a run is carried out. Nothing here changes an answer.
struct RunSettings {
  std::size_t threads = 0;  ///< 0: as many as the machine has cores; 4,096 at the most
  /// An evaluation that would need more ends with LimitReached before its long work; if empty, one that would need 1.2 times the
  /// memory of the machine. A packing keeps the resident memory of the process, mapped files included, below it, or ends so.
  std::optional<std::uint64_t> memory_limit_mib;
  /// What the caller holds of the results himself, counted against the limit.
  std::uint64_t caller_bytes = 0;
  /// Called by threads of the run, never by two at a time. What it throws ends the run.
  std::function<void(const Progress&)> on_progress;
  /// Ask its std::stop_source to stop, from any thread or from a callback, and the run ends with Cancelled, unless its work is
  /// done.
  std::stop_token stop;
  /// An evaluation takes the answers that are in the file from there, and adds others to it. If the file is read only and lacks
  /// an answer, the run ends with OutputError. A file serves one run at a time.
  std::shared_ptr<const AnswerFile> answers = nullptr;
  /// An evaluation with `answers` computes the answers of a part of the cells, and does nothing else. Nothing is delivered or
  /// verified. What the summary says about answers is about these.
  std::optional<Shard> shard = {};
};

}  // namespace farlod
