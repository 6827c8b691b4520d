// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "farlod/shard.hpp"

namespace farlod {

/// The value of a variable of the environment, where it is set.
using Environment = std::function<std::optional<std::string>(const char* name)>;
[[nodiscard]] std::optional<std::string> environment_of_process(const char* name);

/// What --shard says: "I/N", where I counts from 0; "auto", of a job array, as its scheduler numbers its tasks (Slurm, AWS
/// Batch); "auto/N", where the scheduler does not say how many there are (Kubernetes), or where only some of them run again.
/// Throws InvalidArgument, whose message says what would do.
[[nodiscard]] Shard shard_from(const std::string& text, const Environment& environment);

}  // namespace farlod
