// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/verification_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

TEST(VerificationCsv, HasPlacesValuesAndExactValues) {
  const scenes::TemporaryFolder folder;
  const std::vector<VerifiedReceiver> receivers{{{691000.25, 5335000.0, 512.5}, 0.75F, 0.5F}, {{1.0, 2.0, -3.0}, 0.0F, 1.0F}};
  write_verification_csv(receivers, "svf_solid", folder.path() / "v.csv");
  std::stringstream text;
  text << std::ifstream(folder.path() / "v.csv").rdbuf();
  EXPECT_EQ(text.str(),
            "x_m,y_m,z_m,svf_solid,svf_solid_exact\n"
            "691000.25,5335000,512.5,0.750000,0.500000\n1,2,-3,0.000000,1.000000\n");
}

}  // namespace
}  // namespace farlod
