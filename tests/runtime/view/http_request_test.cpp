// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/http_request.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

HttpRequest read(const std::string& head) { return http_request_of(head).value_or(HttpRequest{}); }

TEST(HttpRequest, IsALineAndFields) {
  const HttpRequest request = read("GET /tiles/1.glb?a=1&b HTTP/1.1\r\nhOsT: \t localhost:80 \r\nAccept:");
  EXPECT_EQ(request.method, "GET");
  EXPECT_EQ(request.path, "/tiles/1.glb");
  EXPECT_EQ(request.query, (ViewQuery{{"a", "1"}, {"b", ""}}));
  EXPECT_EQ(request.host, "localhost:80");
  EXPECT_FALSE(request.has_body);
  EXPECT_TRUE(request.keeps_connection);
}

TEST(HttpRequest, IsDecoded) {
  const HttpRequest request = read("GET /a%20b+c%2F?x%3d=1%2B2+3&&x%3D=4&y=%C3%a9 HTTP/1.1");
  EXPECT_EQ(request.path, "/a b+c/") << "a plus sign is a blank in a query alone";
  EXPECT_EQ(request.query, (ViewQuery{{"", ""}, {"x=", "1+2 3"}, {"y", "\u00e9"}}));
}

TEST(HttpRequest, SignsThatBeginNoCharacterStay) {
  for (const char* const path : {"/%", "/%4", "/%zz", "/%+1", "/%-1", "/%0x"})
    EXPECT_EQ(read("GET " + std::string(path) + " HTTP/1.1").path, path);
}

TEST(HttpRequest, SaysWhetherAnotherOneMayFollow) {
  EXPECT_FALSE(read("GET / HTTP/1.1\r\nConnection: Close").keeps_connection);
  EXPECT_TRUE(read("GET / HTTP/1.1\r\nConnection: keep-alive").keeps_connection);
  EXPECT_FALSE(read("GET / HTTP/1.0").keeps_connection);
}

TEST(HttpRequest, SaysWhetherItHasABody) {
  EXPECT_TRUE(read("GET / HTTP/1.1\r\nContent-Length: 3").has_body);
  EXPECT_TRUE(read("GET / HTTP/1.1\r\nTransfer-Encoding: chunked").has_body);
  EXPECT_FALSE(read("GET / HTTP/1.1\r\nContent-Length: 0").has_body);
}

TEST(HttpRequest, IsNothingElse) {
  for (const char* const head : {"", "\r\n", "GET", "GET /", "GET / HTTP/2", "GET / HTTP/1.1 x", "GET  / HTTP/1.1",
                                 "GET a HTTP/1.1", "GET http://a/ HTTP/1.1", "GET / HTTP/1.1\r\nno field",
                                 "GET / HTTP/1.1\r\n\r\nHost: a", "GET / HTTP/1.1\r\nHost: a\r\nHost: b"})
    EXPECT_FALSE(http_request_of(head)) << head;
}

}  // namespace
}  // namespace farlod
