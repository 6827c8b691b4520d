// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/preprocess/app/help_options.hpp"

namespace farlod {
namespace {

using testing::ContainerEq;

/// All options of farlod-pack: an option that is added, renamed or removed changes this list.
TEST(PackHelp, ListsTheseOptionsAndNoOthers) {
  const std::set<std::string> options{
      "--help",         "--version",        "--crs",        "--out-crs",      "--origin",
      "--up",           "--height-field",   "--base-field", "--roof-field",   "--storeys-field",
      "--floor-height", "--default-height", "--lod",        "--terrain",      "--cell",
      "--neighborhood", "--max-error",      "--align",      "--assign",       "--far-map",
      "--output",       "--area",           "--force",      "--memory-limit", "--report",
      "--strict",       "--summary",        "--quiet",      "--threads",      "--config",
      "--resume",       "--shard",          "--merge",      "--trees",        "--tree-height-field",
      "--crown-field",  "--trunk-field",    "--canopy",     "--trunk",        "--canopy-absolute",
      "--trunk-ratio"};
  EXPECT_THAT(test::options_in(test::help_of("farlod-pack")), ContainerEq(options));
}

TEST(HelpOptions, AreTheLongNamesThatBeginALine) {
  const std::string help =
      "town — makes towns; see --size\n\nTry:\n  town -o a.obj --size 3\n\nOptions:\n  -h,--help   Print this\n"
      "  --size FLOAT:[1, 2]=1\n                --not-this\n  --to-centre   as --size\n";
  EXPECT_THAT(test::options_in(help), ContainerEq(std::set<std::string>{"--help", "--size", "--to-centre"}));
}

}  // namespace
}  // namespace farlod
