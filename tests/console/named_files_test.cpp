// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/named_files.hpp"

#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

class NamedFiles : public testing::Test {
 protected:
  /// What is said of these outputs; empty where they may be written.
  [[nodiscard]] std::string refusal(const std::vector<NamedOutput>& outputs, const NamedInputs& inputs = {}) const {
    try {
      require_writable(outputs, inputs);
      return "";
    } catch (const OutputError& error) {
      return error.what();
    }
  }
  [[nodiscard]] NamedOutput output(const std::string& name) const { return {{"-o", folder.file(name)}, false}; }

  scenes::TemporaryFolder folder;
};

TEST_F(NamedFiles, MustHaveAPlace) {  // (1)
  EXPECT_THAT(refusal({output("lost/a")}), HasSubstr("there is no folder"));
  EXPECT_THAT(refusal({{{"-o", "/proc/a"}, false}}), HasSubstr("nothing can be written in /proc"));
  EXPECT_THAT(refusal({{{"-o", folder.path()}, false}}), HasSubstr("there is a folder of this name"));
  EXPECT_EQ(refusal({{{"-o", folder.path()}, true}}), "");
  EXPECT_EQ(refusal({output("a"), {{"--not-given", ""}, false}}), "");
}

TEST_F(NamedFiles, AreNoInputs) {  // (2)
  folder.write("a", "an input");
  folder.write("p/manifest.json", "{}");
  const std::vector<NamedFile> inputs{{"--points", folder.file("a")}};
  EXPECT_THAT(refusal({output("p/../a")}, {inputs, {}}), HasSubstr("it is the file of --points"));
  EXPECT_THAT(refusal({output("p/b")}, {{}, folder.file("p")}), HasSubstr("it lies in the package"));
  EXPECT_EQ(refusal({output("p.csv")}, {inputs, folder.file("p")}), "");
}

TEST_F(NamedFiles, AreDifferent) {  // (3)
  EXPECT_THAT(refusal({output("a"), {{"--summary", folder.file("./a")}, false}}), HasSubstr("both -o and --summary name it"));
}

TEST_F(NamedFiles, MayBeDevices) { EXPECT_EQ(refusal({{{"-o", "/dev/null"}, false}, {{"--summary", "/dev/null"}, false}}), ""); }

TEST_F(NamedFiles, AreNotMade) {
  EXPECT_EQ(refusal({output("a"), output("b")}), "");
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace farlod
