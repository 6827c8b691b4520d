// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/bundled_fonts.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

TEST(BundledFonts, AreThoseBesideTheFolderOfTheProgram) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path program = folder.path() / "bin/farlod-svf",
                              settings = folder.path() / "lib/farlod/share/farlod/fonts.conf";
  EXPECT_EQ(bundled_font_settings(program), "");
  std::filesystem::create_directories(settings.parent_path());
  std::ofstream(settings) << "<fontconfig/>";
  EXPECT_EQ(bundled_font_settings(program), settings);
}

TEST(BundledFonts, AreNobodysWhereNoneWereBroughtAlong) {
  use_bundled_fonts();
  EXPECT_EQ(std::getenv("FONTCONFIG_FILE"), nullptr);  // NOLINT(concurrency-mt-unsafe): there is one thread
}

}  // namespace
}  // namespace farlod
