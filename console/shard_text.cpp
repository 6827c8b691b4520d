// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/shard_text.hpp"

#include <charconv>
#include <cstdlib>

#include "farlod/error.hpp"

namespace farlod {
namespace {

constexpr std::size_t most_shards = 1'000'000;

std::optional<std::size_t> whole_number(const std::string& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::size_t number_in(const std::string& text, const std::string& what) {
  if (const auto number = whole_number(text)) return *number;
  throw InvalidArgument(what + " is \"" + text + "\", which is not a whole number");
}

/// The numbers of a task that a scheduler has written into the environment.
struct ArrayTask {
  std::size_t index = 0;             ///< from 0
  std::optional<std::size_t> count;  ///< where the scheduler says it
};

/// Arrays of Slurm may begin anywhere, and leave numbers out.
std::optional<ArrayTask> task_of_slurm(const Environment& environment) {
  const auto id = environment("SLURM_ARRAY_TASK_ID");
  if (!id) return std::nullopt;
  const auto number = [&](const char* name, std::size_t otherwise) {
    const auto text = environment(name);
    return text ? number_in(*text, name) : otherwise;
  };
  const std::size_t task = number_in(*id, "SLURM_ARRAY_TASK_ID"), least = number("SLURM_ARRAY_TASK_MIN", 0),
                    step = number("SLURM_ARRAY_TASK_STEP", 1), most = number("SLURM_ARRAY_TASK_MAX", task);
  if (task < least || step == 0 || (task - least) % step != 0)
    throw InvalidArgument("the task " + *id + " of this Slurm array is none of " + std::to_string(least) + ", " +
                          std::to_string(least + step) + " …: number the array without gaps, or give --shard I/N");
  const std::size_t expected = most >= least ? (most - least) / step + 1 : 0;
  const std::size_t count = number("SLURM_ARRAY_TASK_COUNT", expected);
  if (count != expected)
    throw InvalidArgument("this Slurm array has gaps (" + std::to_string(count) + " tasks from " + std::to_string(least) +
                          " to " + std::to_string(most) + "): number it without gaps, or give --shard I/N");
  return ArrayTask{(task - least) / step, count};
}

std::optional<ArrayTask> task_of_aws_batch(const Environment& environment) {
  const auto index = environment("AWS_BATCH_JOB_ARRAY_INDEX");
  if (!index) return std::nullopt;
  ArrayTask task{number_in(*index, "AWS_BATCH_JOB_ARRAY_INDEX"), {}};
  if (const auto size = environment("AWS_BATCH_JOB_ARRAY_SIZE")) task.count = number_in(*size, "AWS_BATCH_JOB_ARRAY_SIZE");
  return task;
}

std::optional<ArrayTask> task_of_kubernetes(const Environment& environment) {
  const auto index = environment("JOB_COMPLETION_INDEX");
  if (!index) return std::nullopt;
  return ArrayTask{number_in(*index, "JOB_COMPLETION_INDEX"), {}};
}

ArrayTask task_of(const Environment& environment) {
  for (const auto& find : {task_of_slurm, task_of_aws_batch, task_of_kubernetes})
    if (const auto task = find(environment)) return *task;
  throw InvalidArgument(
      "this is no task of a job array: none of SLURM_ARRAY_TASK_ID, AWS_BATCH_JOB_ARRAY_INDEX and JOB_COMPLETION_INDEX is set. "
      "Give --shard I/N");
}

Shard shard_of_array(const std::string& count_text, const Environment& environment) {
  const ArrayTask task = task_of(environment);
  if (count_text.empty() && !task.count)
    throw InvalidArgument("this job array does not say how many tasks it has: give --shard auto/N");
  return {task.index, count_text.empty() ? *task.count : number_in(count_text, "N")};
}

}  // namespace

std::optional<std::string> environment_of_process(const char* name) {
  // Nobody changes the environment. NOLINTNEXTLINE(concurrency-mt-unsafe)
  const char* value = std::getenv(name);
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

Shard shard_from(const std::string& text, const Environment& environment) {
  const std::size_t slash = text.find('/');
  const std::string index = text.substr(0, slash), count = slash == std::string::npos ? "" : text.substr(slash + 1);
  const bool is_complete = index == "auto" ? slash == std::string::npos || !count.empty() : !count.empty();
  if (!is_complete || (index != "auto" && !whole_number(index)))
    throw InvalidArgument("\"" + text + "\" is not of the form I/N, auto or auto/N");
  const Shard shard = index == "auto" ? shard_of_array(count, environment) : Shard{number_in(index, "I"), number_in(count, "N")};
  if (shard.count == 0 || shard.count > most_shards)
    throw InvalidArgument("there are 1 to " + std::to_string(most_shards) + " shards, not " + std::to_string(shard.count));
  if (shard.index >= shard.count)
    throw InvalidArgument("there is no shard " + std::to_string(shard.index) + " of " + std::to_string(shard.count) +
                          ": they count from 0 to " + std::to_string(shard.count - 1));
  return shard;
}

}  // namespace farlod
