// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/console/help_options.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

TEST(HelpOptions, AreTheLongNamesThatBeginALine) {
  const std::string help =
      "town — makes towns; see --size\n\nTry:\n  town -o a.obj --size 3\n\nOptions:\n  -h,--help   Print this\n"
      "  --size FLOAT:[1, 2]=1\n                --not-this\n  --to-centre   as --size\n[One of]\n    --in-a-group\n";
  EXPECT_EQ(test::options_in(help), (std::set<std::string>{"--help", "--in-a-group", "--size", "--to-centre"}));
}

}  // namespace
}  // namespace farlod
