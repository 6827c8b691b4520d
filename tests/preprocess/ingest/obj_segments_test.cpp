// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <oneapi/tbb/task_arena.h>

#include <sstream>

#include "base/cancellation.hpp"
#include "ingest/obj/obj_segment.hpp"
#include "reading.hpp"

namespace farlod::ingest::test {
namespace {

/// All that lines may say to each other: names, numbers that count backwards, lines that go on.
const std::string every_way =
    "\xEF\xBB\xBF# all of it\r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no first\ng\n\nv 0 0 1\nf -4 -3 -1\nl 1 2\n"
    "g north wing\nf 1 \\\n  2 \\ \r\n -1\nv 1 1 \\\n1\nf -1 1 2 x\nf 0 -9 7\n\\\n\np 1\no second\nf -2 -1 1\nf -1/1 2/2 3/3 # "
    "\\\n"
    "f 2 3 4\ng north wing\n v\t5 x 5\nf 1 2 -1\nf a b c\nv 9 9 9 \\";

/// What a mesh holds, as text.
std::string described(const ObjMesh& mesh) {
  std::ostringstream text;
  for (const Point3d& p : mesh.vertices) text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const ObjFace& face : mesh.faces) {
    text << "f of line " << face.line << " in " << face.group << ' ' << mesh.groups[face.group] << ", " << face.object << ' '
         << mesh.objects[face.object] << ':';
    for (std::size_t k = 0; k < face.corner_count; ++k) text << ' ' << mesh.corners[face.first_corner + k];
    text << '\n';
  }
  text << mesh.corners.size() << " corners, " << mesh.groups.size() << " groups, " << mesh.objects.size() << " objects\n";
  for (const std::uint64_t line : mesh.malformed_lines) text << "malformed " << line << '\n';
  text << mesh.unread_elements << " unread from " << mesh.first_unread_line << '\n';
  return text.str();
}

std::string scan(const std::string& text, std::size_t segment_bytes, int threads) {
  std::istringstream stream(text);
  return oneapi::tbb::task_arena(threads).execute([&] { return described(scan_obj(stream, {}, segment_bytes)); });
}

TEST(ObjSegments, MakeTheFileWhenPutTogether) {
  for (const std::size_t bytes : {1U, 2U, 3U, 7U, 20U, 64U, 10'000U}) {
    std::istringstream stream(every_way);
    ObjSegmentCutter cutter(stream, bytes);
    std::string text;
    for (auto segment = cutter.next(); segment; segment = cutter.next()) {
      EXPECT_FALSE(segment->empty());
      text += *segment;
    }
    EXPECT_EQ(text, every_way.substr(3)) << bytes;
  }
}

TEST(ObjSegments, EndWithALineThatIsNotContinued) {
  std::istringstream stream("v 1 \\\n 2 3\nf 1 \\ \r\n2\nf\n");
  ObjSegmentCutter cutter(stream, 1);
  std::vector<std::string> segments;
  for (auto segment = cutter.next(); segment; segment = cutter.next()) segments.push_back(*segment);
  EXPECT_THAT(segments, testing::ElementsAre("v 1 \\\n 2 3\n", "f 1 \\ \r\n2\n", "f\n"));
}

TEST(ObjSegments, SayTogetherWhatTheFileSays) {
  const std::string whole = scan(every_way, every_way.size(), 1);
  EXPECT_THAT(whole, testing::HasSubstr("f of line 15 in 2 north wing, 1 first: 0 1 3\n"));
  EXPECT_THAT(whole, testing::HasSubstr("f of line 24 in 2 north wing, 2 second: 3 4 0\n"));
  EXPECT_THAT(whole, testing::HasSubstr("malformed 18\nmalformed 30\n2 unread from 11\n"));
  for (std::size_t bytes = 1; bytes < every_way.size(); bytes += 3)
    for (const int threads : {1, 4}) EXPECT_EQ(scan(every_way, bytes, threads), whole) << bytes;
}

TEST(ObjSegments, AreNoneOfAnEmptyFile) {
  EXPECT_EQ(scan("", 10, 4), described(ObjMesh()));
  EXPECT_EQ(scan("\xEF\xBB\xBF", 10, 4), described(ObjMesh()));
}

TEST(ObjSegments, EndWhenAStopIsRequested) {
  std::istringstream stream(every_way);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW((void)scan_obj(stream, stop.get_token()), Cancelled);
}

/// Several batches of buildings, in which something is wrong here and there.
std::string houses(int count) {
  std::string text = "v 0 0 0\nv 9 0 0\nv 0 9 0\n";
  for (int n = 0; n < count; ++n) {
    const std::string x = std::to_string(n % 97), y = std::to_string(n / 97);
    text += "g " + (n % 500 == 499 ? "the same" : "house " + std::to_string(n)) + "\n";
    text += "v " + x + " " + y + " 0\nv " + x + ".5 " + y + " 0\nv " + x + " " + y + ".5 0\nv " + x + " " + y + " 7\n";
    text += "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n";
    if (n % 300 == 7) text += "f 1 2 99999999\nf -1 -1 -2\nf x\n";
    if (n % 700 == 8) text += "g broken\nf 0 1 2\n";
    if (n % 400 == 9) text += "f -4 -2 -3\n";
  }
  return text;
}

TEST(ObjBuildings, DoNotDependOnThreads) {
  const std::filesystem::path file = write_file("a.obj", houses(3'000));
  const auto read_on = [&](int threads) { return oneapi::tbb::task_arena(threads).execute([&] { return read_file(file); }); };
  const Reading one = read_on(1);
  EXPECT_EQ(one.city().buildings().size(), 3'000U);
  EXPECT_EQ(one.report.count(ProblemCode::repeated_id), 5U + 4U);
  EXPECT_EQ(one.report.count(ProblemCode::vertex_index_out_of_range), 10U + 5U);
  EXPECT_EQ(one.report.count(ProblemCode::duplicate_surface), 8U);
  for (const int threads : {2, 5}) {
    const Reading several = read_on(threads);
    EXPECT_EQ(test::described(several.source, several.report), test::described(one.source, one.report));
  }
}

}  // namespace
}  // namespace farlod::ingest::test
