// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/work_options.hpp"

#include <CLI/CLI.hpp>

#include "console/shard_text.hpp"
#include "farlod/error.hpp"

namespace farlod {

void add_work_options(CLI::App& app, std::string& shard_text, SvfOptions& o) {
  app.add_flag("--resume", o.resume, "Go on with what a run with the same options has left, and with no other")->group("Run");
  auto* const shard =
      app.add_option("--shard", shard_text,
                     "Compute one part of N, counted from 0: I/N; auto in a job array of Slurm or AWS Batch; auto/N "
                     "in an indexed job of Kubernetes")
          ->type_name("I/N")
          ->group("Run");
  app.add_flag("--merge", o.merge, "Write the output from what all shards have computed")->excludes(shard)->group("Run");
}

void resolve_work(const std::string& shard_text, SvfOptions& o) {
  const bool is_divided = !shard_text.empty() || o.merge;
  const char* const option = o.merge ? "--merge" : "--shard";
  if (is_divided && o.source == ReceiverSource::at)
    throw CLI::ValidationError(option, "it goes with --grid, --grid-like, --points, --along and --surfaces");
  if (is_divided && o.evaluation.dry_run)
    throw CLI::ValidationError(option, "--dry-run computes nothing: leave one of the two out");
  if (shard_text.empty()) return;
  try {
    o.shard = shard_from(shard_text, environment_of_process);
  } catch (const InvalidArgument& error) {
    throw CLI::ValidationError("--shard", error.what());
  }
}

}  // namespace farlod
