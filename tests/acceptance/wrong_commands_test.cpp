// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/wrong_commands.hpp"

#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::array words_of_libraries{"not in {", "Could not convert", "required FLOAT", "FILE missing",
                                        "At Most",  "gives no reason",   "not readable"};

/// A footprint with a street for a name, and a height.
std::string streets_geojson() {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"street":"East 86th","height":9},)"
         R"("geometry":{"type":"Polygon","coordinates":[[[9,49],[9.0001,49],[9.0001,49.0001],[9,49]]]}}]})";
}

/// A geometry in the metres of the town without a CRS, as exports have it.
std::string in_metres(const std::string& type, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{},"geometry":{"type":")" + type + R"(","coordinates":)" + coordinates + "}}";
}

/// The files that commands are wrong about: a package, its city, and what people take for a city, a table or a folder of their
/// own.
class WrongCommands : public testing::TestWithParam<WrongCommand> {
 protected:
  WrongCommands() {
    add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
    folder.must("mkdir cities empty folder.csv folder.gml");
    folder.write("cities/box.obj", box_obj());
    folder.write("box.obj", box_obj());
    folder.write("empty.gml", "");
    for (const char* name : {"page.gml", "page.csv"})
      folder.write(name, "<!DOCTYPE html><html><body>404 Not Found</body></html>");
    folder.write("paper.pdf", "%PDF-1.4\n1 0 obj\n");
    folder.write("cut.zip", std::string("PK\x03\x04\x14\x00\x00\x00", 8) + std::string(100, '\0'));
    folder.write("points.csv", "x,y\n500030,5500010\n");
    folder.write("streets.geojson", streets_geojson());
    folder.write("metre.geojson", in_metres("Point", "[500000,5500010]"));
    folder.write("metres.geojson", in_metres("LineString", "[[500000,5500010],[500090,5500010]]"));
    folder.write("quarter.geojson",
                 in_metres("Polygon", "[[[500000,5500010],[500090,5500010],[500090,5500090],[500000,5500010]]]"));
    folder.write("typo.toml", "rayz = 100\n");
    folder.write("far.asc", "ncols 2\nnrows 2\nxllcorner 100000\nyllcorner 200000\ncellsize 1\n1 1\n1 1\n");
  }
  WorkFolder folder;
};

TEST_P(WrongCommands, AreToldSoInOneLine) {
  const std::vector<std::string> before = folder.names();
  const Outcome outcome = folder.run(GetParam().command + " < /dev/null");
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code);
  EXPECT_EQ(outcome.out, "");
  const std::vector<std::string> lines = lines_of(outcome.err);
  ASSERT_EQ(lines.size(), 1U) << outcome.err;
  EXPECT_THAT(lines[0], StartsWith(GetParam().command.substr(0, GetParam().command.find(' ')) + ": "));
  for (const std::string& part : GetParam().said) EXPECT_THAT(lines[0], HasSubstr(part));
  for (const char* words : words_of_libraries) EXPECT_THAT(lines[0], Not(HasSubstr(words)));
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(Options, WrongCommands, testing::ValuesIn(wrong_options()));
INSTANTIATE_TEST_SUITE_P(Files, WrongCommands, testing::ValuesIn(wrong_files()));

TEST_F(WrongCommands, APortThatIsTakenIsNamed) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(socket, 1), 0);
  ASSERT_EQ(getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const std::string port = std::to_string(ntohs(address.sin_port));
  expect_refusal(folder.run("farlod-view a.farlod --port " + port), exit_unusable_input,
                 {"nobody can listen at port " + port + " of 127.0.0.1", "Choose another --port"});
  close(socket);
}

}  // namespace
}  // namespace farlod::acceptance
