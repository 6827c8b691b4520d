// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/shard_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "farlod/error.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;
using Variables = std::map<std::string, std::string>;

Environment environment_of(const Variables& variables) {
  return [variables](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found != variables.end() ? std::optional(found->second) : std::nullopt;
  };
}

Shard shard(const std::string& text, const Variables& variables = {}) { return shard_from(text, environment_of(variables)); }

std::string refusal(const std::string& text, const Variables& variables = {}) {
  try {
    (void)shard(text, variables);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "no refusal";
}

Variables slurm(const char* id, const char* least, const char* most, const char* step, const char* count) {
  return {{"SLURM_ARRAY_TASK_ID", id},
          {"SLURM_ARRAY_TASK_MIN", least},
          {"SLURM_ARRAY_TASK_MAX", most},
          {"SLURM_ARRAY_TASK_STEP", step},
          {"SLURM_ARRAY_TASK_COUNT", count}};
}

TEST(ShardText, IsANumberOfSo) {
  EXPECT_EQ(shard("0/1"), (Shard{0, 1}));
  EXPECT_EQ(shard("3/8"), (Shard{3, 8}));
  EXPECT_EQ(shard("999999/1000000"), (Shard{999'999, 1'000'000}));
}

TEST(ShardText, CountsFromZero) {
  EXPECT_THAT(refusal("8/8"), HasSubstr("there is no shard 8 of 8: they count from 0 to 7"));
  EXPECT_THAT(refusal("0/0"), HasSubstr("1 to 1000000 shards, not 0"));
  EXPECT_THAT(refusal("0/1000001"), HasSubstr("not 1000001"));
}

TEST(ShardText, OfAnotherFormIsRefused) {
  for (const char* text : {"", "3", "/8", "3/", "a/8", "-1/8", "3/8/2", "1.5/8", "auto/", "3 /8", "99999999999999999999/8"})
    EXPECT_NE(refusal(text), "no refusal") << text;
}

TEST(ShardText, IsTheTaskOfASlurmArray) {
  EXPECT_EQ(shard("auto", slurm("3", "0", "7", "1", "8")), (Shard{3, 8}));
  EXPECT_EQ(shard("auto", slurm("3", "1", "8", "1", "8")), (Shard{2, 8})) << "counted from the least index";
  EXPECT_EQ(shard("auto", slurm("30", "10", "40", "10", "4")), (Shard{2, 4})) << "in steps";
  EXPECT_EQ(shard("auto/16", slurm("3", "0", "7", "1", "8")), (Shard{3, 16})) << "the number may be given";
}

TEST(ShardText, OfASlurmArrayWithGapsIsRefused) {
  EXPECT_THAT(refusal("auto", slurm("7", "1", "7", "1", "3")), HasSubstr("has gaps"));
  EXPECT_THAT(refusal("auto", slurm("35", "10", "40", "10", "4")), HasSubstr("is none of 10, 20"));
  EXPECT_THAT(refusal("auto", slurm("x", "0", "7", "1", "8")), HasSubstr("SLURM_ARRAY_TASK_ID is \"x\""));
}

TEST(ShardText, IsTheIndexOfKubernetesOrAwsBatch) {
  EXPECT_EQ(shard("auto/8", {{"JOB_COMPLETION_INDEX", "5"}}), (Shard{5, 8}));
  EXPECT_THAT(refusal("auto", {{"JOB_COMPLETION_INDEX", "5"}}), HasSubstr("give --shard auto/N"));
  EXPECT_EQ(shard("auto", {{"AWS_BATCH_JOB_ARRAY_INDEX", "5"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "6"}}), (Shard{5, 6}));
  EXPECT_THAT(refusal("auto/5", {{"JOB_COMPLETION_INDEX", "5"}}), HasSubstr("no shard 5 of 5"));
}

TEST(ShardText, WithoutAnArraySaysWhatIsMissing) { EXPECT_THAT(refusal("auto"), HasSubstr("SLURM_ARRAY_TASK_ID")); }

}  // namespace
}  // namespace farlod
