// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "view/view_city.hpp"

namespace farlod {

/// What a server of pages needs of the head of a request (RFC 9112).
struct HttpRequest {
  std::string method;
  std::string path;  ///< with its first slash, and decoded
  ViewQuery query;
  std::string host;
  bool has_body = false;
  bool keeps_connection = true;
};

/// Reads a head, all its lines but for the empty one. Nothing where it is no request of HTTP/1.0 or 1.1 for a path.
[[nodiscard]] std::optional<HttpRequest> http_request_of(std::string_view head);

/// What a server listens to.
struct HttpServerSettings {
  std::string address = "127.0.0.1";
  int port = 0;                                             ///< 0: any that is free
  std::chrono::seconds time_for_request{10}, idle_time{5};  ///< of a connection: for one to arrive, and between two
};

/// A server of pages for browsers, by HTTP/1.1. It knows no files: all it sends comes from one function.
///   (1) a request for another host than the one it listens to is refused (status 421), so that a page of another site that gave
///       its name our address (DNS rebinding) reads nothing
///   (2) a request has 16 KiB of head, no body, and `time_for_request` to arrive; another one ends its connection
///   (3) who sends slowly, or connects and sends nothing, keeps nobody else waiting until there are more than 128 of them
class HttpServer {
 public:
  /// `answer` takes the path without its first slash; it is called by several threads at a time.
  using Answer = std::function<ViewReply(std::string_view path, const ViewQuery& query)>;

  /// Begins to listen. Throws OutputError where the address cannot be had.
  HttpServer(const HttpServerSettings& settings, Answer answer);
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  ~HttpServer();

  [[nodiscard]] int port() const;
  /// Answers until stop() is called, by another thread, or has been called before. Once only.
  void run();
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod
