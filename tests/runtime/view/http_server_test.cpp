// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/http_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod {
namespace {

/// More than the system keeps of what is sent and not yet received.
constexpr std::size_t bytes_of_large_reply = std::size_t{32} << 20U;

/// A connection of a client that sends what it likes.
class Connection {
 public:
  explicit Connection(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { close(socket_); }

  bool say(const std::string& text) const {
    return send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  /// All that comes until the other side closes.
  [[nodiscard]] std::string heard() const {
    std::string text;
    char part[4096];
    for (ssize_t count = 0; (count = recv(socket_, part, sizeof(part), 0)) > 0;)
      text.append(part, static_cast<std::size_t>(count));
    return text;
  }

 private:
  int socket_;
};

class Served : public testing::Test {
 protected:
  explicit Served(const HttpServerSettings& settings = {})
      : server(settings, [this](std::string_view path, const ViewQuery& query) { return answer(path, query); }) {
    running = std::thread([this] { server.run(); });
  }
  void TearDown() override {
    server.stop();
    running.join();
  }
  ViewReply answer(std::string_view path, const ViewQuery& query) {
    ++asked;
    if (path == "wrong") throw std::runtime_error("the city fell over");
    if (path == "large") return {.type = "text/plain", .body = std::string(bytes_of_large_reply, 'x')};
    const auto found = query.find("q");
    return {.type = "text/plain", .body = std::string(path) + (found == query.end() ? "" : "?" + found->second)};
  }
  [[nodiscard]] std::string request(const std::string& line, const std::string& host, const std::string& more = "") const {
    const Connection connection(server.port());
    EXPECT_TRUE(connection.say(line + "\r\nHost: " + host + "\r\nConnection: close\r\n" + more + "\r\n"));
    return connection.heard();
  }
  [[nodiscard]] std::string own_host() const { return "127.0.0.1:" + std::to_string(server.port()); }
  static int status_of(const std::string& reply) { return reply.size() > 12 ? std::stoi(reply.substr(9, 3)) : 0; }

  std::atomic<int> asked = 0;
  HttpServer server;
  std::thread running;
};

TEST_F(Served, AnswersWithWhatTheFunctionSays) {
  const std::string reply = request("GET /a/b.glb?q=1%2B2 HTTP/1.1", own_host());
  EXPECT_EQ(status_of(reply), 200);
  EXPECT_TRUE(reply.ends_with("\r\n\r\na/b.glb?1+2")) << reply;
  EXPECT_NE(reply.find("Content-Security-Policy: default-src 'self'"), std::string::npos);
  EXPECT_NE(reply.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_EQ(status_of(request("GET / HTTP/1.1", "localhost:" + std::to_string(server.port()))), 200);
}

TEST_F(Served, NothingIsCompressed) {
  // The page would wait for that longer than for all else
  const std::string reply = request("GET /a HTTP/1.1", own_host(), "Accept-Encoding: gzip, deflate, br\r\n");
  EXPECT_EQ(reply.find("Content-Encoding"), std::string::npos) << reply;
  EXPECT_TRUE(reply.ends_with("\r\n\r\na")) << reply;
}

TEST_F(Served, AConnectionAnswersOneRequestAfterAnother) {
  const Connection connection(server.port());
  const std::string line = " HTTP/1.1\r\nHost: " + own_host() + "\r\n";
  ASSERT_TRUE(connection.say("GET /a" + line + "\r\nHEAD /b" + line + "\r\nGET /c" + line + "Connection: close\r\n\r\n"));
  const std::string replies = connection.heard();
  const std::size_t head = replies.find("\r\n\r\naHTTP/1.1 200");
  ASSERT_NE(head, std::string::npos) << replies;
  EXPECT_NE(replies.find("\r\n\r\nHTTP/1.1 200", head), std::string::npos) << "HEAD has no body: " << replies;
  EXPECT_TRUE(replies.ends_with("Connection: close\r\n\r\nc")) << replies;
}

TEST_F(Served, WhatGoesWrongEndsTheRequestAlone) {
  const std::string reply = request("GET /wrong HTTP/1.1", own_host());
  EXPECT_EQ(status_of(reply), 500);
  EXPECT_TRUE(reply.ends_with("the city fell over")) << reply;
  EXPECT_EQ(status_of(request("no request", own_host())), 400);
  EXPECT_EQ(status_of(request("GET /a HTTP/1.1", own_host())), 200);
}

TEST_F(Served, ALargeReplyArrivesWhole) {
  const std::string reply = request("GET /large HTTP/1.1", own_host());
  EXPECT_TRUE(reply.ends_with("\r\n\r\n" + std::string(bytes_of_large_reply, 'x'))) << reply.size();
}

TEST_F(Served, OtherHostsAreRefused) {
  for (const std::string& host :
       {std::string("city.example"), std::string("127.0.0.1"), "127.0.0.1:" + std::to_string(server.port() + 1)})
    EXPECT_EQ(status_of(request("GET /a HTTP/1.1", host)), 421) << host;
  EXPECT_EQ(asked, 0);
}

TEST_F(Served, NothingIsWritten) {
  EXPECT_EQ(status_of(request("POST /a HTTP/1.1", own_host(), "Content-Length: 3\r\n")), 405);
  EXPECT_EQ(status_of(request("DELETE /a HTTP/1.1", own_host())), 405);
  EXPECT_EQ(status_of(request("GET /a HTTP/1.1", own_host(), "Content-Length: 3\r\n")), 413);
  EXPECT_EQ(asked, 0);
}

TEST_F(Served, OversizedHeadsEndTheConnection) {
  const Connection connection(server.port());
  (void)connection.say("GET / HTTP/1.1\r\nHost: " + own_host() + "\r\n");
  for (int n = 0; n < 1000; ++n)
    if (!connection.say("X-" + std::to_string(n) + ": " + std::string(100, 'x') + "\r\n")) break;
  (void)connection.say("\r\n");
  EXPECT_NE(status_of(connection.heard()), 200);
  EXPECT_EQ(asked, 0);
  EXPECT_NE(status_of(request("GET /" + std::string(20000, 'x') + " HTTP/1.1", own_host())), 200);
  EXPECT_EQ(asked, 0);
}

/// A server that waits for a client so long that a test which has to wait with it fails by ctest's limit.
class ServedPatiently : public Served {
 protected:
  ServedPatiently() : Served({.time_for_request = an_hour, .idle_time = an_hour}) {}
  static constexpr std::chrono::hours an_hour{1};
};

TEST_F(ServedPatiently, WhoSendsSlowlyKeepsNobodyWaiting) {
  std::vector<std::unique_ptr<Connection>> slow;
  for (int n = 0; n < 60; ++n) {
    slow.push_back(std::make_unique<Connection>(server.port()));
    ASSERT_TRUE(slow.back()->say("GET /"));
  }
  EXPECT_EQ(status_of(request("GET /a HTTP/1.1", own_host())), 200);
}

class ServedImpatiently : public Served {
 protected:
  ServedImpatiently() : Served({.time_for_request = std::chrono::seconds(1)}) {}
};

TEST_F(ServedImpatiently, SlowRequestsEndThemselves) {
  const Connection connection(server.port());
  ASSERT_TRUE(connection.say("GET /a HTTP/1.1\r\nHost: "));
  // A byte now and then keeps a limit of single reads from ever being reached: until the server has closed, for minutes
  constexpr auto between = std::chrono::milliseconds(100);
  int said = 0;
  constexpr int most = 3000;
  while (said < most && connection.say("x")) {
    ++said;
    std::this_thread::sleep_for(between);
  }
  EXPECT_LT(said, most) << "the server still listens";
  EXPECT_NE(status_of(connection.heard()), 200);
}

TEST_F(Served, AHundredClientsAtOnce) {
  std::atomic<int> right = 0;
  std::vector<std::thread> clients;
  for (int n = 0; n < 100; ++n)
    clients.emplace_back([&, n] {
      if (request("GET /tile?q=" + std::to_string(n) + " HTTP/1.1", own_host()).ends_with("\ntile?" + std::to_string(n))) ++right;
    });
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(right, 100);
}

TEST(HttpServer, MayBeStoppedBeforeItRuns) {
  HttpServer server({}, [](std::string_view, const ViewQuery&) { return ViewReply{}; });
  server.stop();
  server.run();
}

TEST_F(ServedPatiently, StopsWhileClientsAreConnected) {
  const Connection idle(server.port()), half(server.port());
  ASSERT_TRUE(half.say("GET /a HTTP/1.1\r\n"));
  EXPECT_EQ(status_of(request("GET /a HTTP/1.1", own_host())), 200);
  server.stop();
  EXPECT_EQ(half.heard(), "");
  EXPECT_EQ(idle.heard(), "");
}

TEST_F(Served, APortThatIsTakenIsSaid) {
  const std::string refusal =
      scenes::refusal_of<OutputError>([&] { const HttpServer second({.address = "127.0.0.1", .port = server.port()}, {}); });
  EXPECT_NE(refusal.find("--port"), std::string::npos) << refusal;
}

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
