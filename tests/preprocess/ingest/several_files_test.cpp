// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "reading.hpp"
#include "small_cities.hpp"

namespace farlod::ingest::test {
namespace {

using testing::HasSubstr;

TEST(SeveralFiles, AreReadInTheirOrder) {
  const std::vector<InputFile> files{write_file("b.obj", obj_of("b")), write_file("a.gml", citygml_of("a"))};
  Report report;
  const std::vector<SourceCity> cities = ingest_all(files, {}, report);
  ASSERT_EQ(cities.size(), 2u);
  EXPECT_EQ(cities[0].city.buildings()[0].id, "b");
  EXPECT_EQ(cities[1].city.buildings()[0].id, "a");
}

TEST(SeveralFiles, WhatCannotBeUsedCostsItselfOnly) {
  const std::vector<InputFile> files{write_file("empty.gml", ""), write_file("cut.gml", citygml_of("x").substr(0, 300)),
                                     write_file("good.obj", obj_of("good")), write_file("text.txt", "hello")};
  Report report;
  EXPECT_EQ(ingest_all(files, {}, report).size(), 1u);
  ASSERT_EQ(report.problems().size(), 3u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::empty_file);
  EXPECT_EQ(report.problems()[0].source, files[0].name);
  EXPECT_EQ(report.problems()[1].code, ProblemCode::unusable_file);
  EXPECT_THAT(report.problems()[1].detail, HasSubstr("not well-formed"));
  EXPECT_EQ(report.problems()[2].code, ProblemCode::unusable_file);
}

TEST(SeveralFiles, OfWhichNoneIsLeftEndTheRun) {
  const std::vector<InputFile> files{write_file("empty.gml", ""), write_file("text.txt", "hello")};
  Report report;
  try {
    (void)ingest_all(files, {}, report);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("none of the 2 files"), HasSubstr("empty.gml"), HasSubstr("0 bytes")));
  }
  EXPECT_EQ(report.problems().size(), 2u);
}

TEST(SeveralFiles, ASingleFileEndsTheRunItself) {
  Report report;
  const std::vector<InputFile> file{write_file("empty.gml", "")};
  EXPECT_THROW((void)ingest_all(file, {}, report), InputError);
  EXPECT_TRUE(report.problems().empty());
}

}  // namespace
}  // namespace farlod::ingest::test
