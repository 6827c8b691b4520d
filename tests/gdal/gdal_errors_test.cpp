// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/gdal_errors.hpp"

#include <cpl_error.h>
#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

void fail(const char* message) { CPLError(CE_Failure, CPLE_AppDefined, "%s", message); }
void warn(const char* message) { CPLError(CE_Warning, CPLE_AppDefined, "%s", message); }

TEST(GdalErrors, AWarningIsNoFailure) {
  GdalErrors errors;
  warn("by the way");
  EXPECT_FALSE(errors.any());
  EXPECT_EQ(errors.last(), "GDAL gives no reason");
  EXPECT_THAT(errors.take(), IsEmpty());
}

TEST(GdalErrors, AFailureIsNotForgottenForAWarningAfterIt) {
  GdalErrors errors;
  fail("the disk is full");
  warn("by the way");
  EXPECT_TRUE(errors.any());
  EXPECT_EQ(errors.last(), "the disk is full");
}

TEST(GdalErrors, FailuresAreTakenOnceInTheirOrder) {
  GdalErrors errors;
  fail("first");
  fail("second");
  EXPECT_EQ(errors.last(), "second");
  EXPECT_THAT(errors.take(), ElementsAre("first", "second"));
  EXPECT_THAT(errors.take(), IsEmpty());
  EXPECT_FALSE(errors.any());
}

TEST(GdalErrors, FailuresFromBeforeDoNotCount) {
  {
    const GdalErrors before;
    fail("long ago");
  }
  const GdalErrors errors;
  EXPECT_FALSE(errors.any());
}

TEST(GdalErrors, NothingIsPrinted) {
  testing::internal::CaptureStderr();
  const GdalErrors errors;
  fail("kept");
  warn("dropped");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace farlod
