// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/exported_view.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "farlod/error.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "view/one_page.hpp"

namespace farlod {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

TEST(ExportedView, APageThatGrowsTooLargeIsRefusedAndNotLeft) {
  const library::PackedSample sample;
  const scenes::TemporaryFolder folder;
  const Package package(sample.folder());
  const ViewCity city(package, "village.farlod", view_frame_of(package), {});
  const std::filesystem::path file = folder.file("village.html");
  std::size_t done = 0;
  const auto count = [&](std::size_t n, std::size_t /*all*/) { done = n; };
  const std::uint64_t bytes = export_page(city, file, count).bytes;
  EXPECT_EQ(std::filesystem::file_size(file), bytes);
  EXPECT_GT(done, 0U);
  std::filesystem::remove(file);
  EXPECT_THAT([&] { export_page(city, file, count, bytes - 1); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("village.html"), HasSubstr("MiB"), HasSubstr("--area"))));
  EXPECT_TRUE(std::filesystem::is_empty(file.parent_path()));
}

TEST(ExportedView, AGreatCityIsRefusedAtOnce) {
  EXPECT_THAT([] { require_page_is_possible("berlin.html", 10'000'000); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("berlin.html"), HasSubstr("64 MiB"))));
  EXPECT_NO_THROW(require_page_is_possible("rotterdam.html", 59'069));
}

TEST(OnePage, HasItsFilesBeforeItsScript) {
  std::ostringstream text;
  OnePage page(text);
  page.add("a/b.bin", std::string("</script>\0<!--", 14));
  page.finish();
  const std::string html = text.str();
  EXPECT_THAT(html, StartsWith("<!doctype html>"));
  EXPECT_EQ(html.size(), page.bytes());
  const std::size_t file = html.find("data-file=\"a/b.bin\""), script = html.find("<script type=\"module\">");
  ASSERT_NE(file, std::string::npos);
  EXPECT_LT(file, script);
  const std::string element = html.substr(file, html.find('\n', file) - file);
  EXPECT_EQ(element.find("<!--"), std::string::npos) << "bytes of a file are text";
  EXPECT_EQ(element.find('<'), element.rfind("</script>"));
  EXPECT_LT(html.find("Content-Security-Policy"), html.find("<script")) << "it holds for what follows";
}

}  // namespace
}  // namespace farlod
