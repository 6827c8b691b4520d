// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <httplib.h>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "view/http_server.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t connections_at_once = 128;
constexpr std::size_t most_bytes_of_head = std::size_t{16} << 10U;
constexpr auto time_for_request = std::chrono::seconds(10), idle_time = std::chrono::seconds(5);
constexpr int misdirected_request = 421;

/// A connection, each of whose requests must arrive within a time and a size, however slowly it is sent: httplib limits the time
/// of single reads only.
class TimedStream : public httplib::Stream {
 public:
  /// `listening`: the socket of the server. When it is closed, all waiting ends.
  TimedStream(socket_t socket, const std::atomic<socket_t>& listening) : socket_(socket), listening_(listening) {}

  /// Waits for the first byte of a request. False, too, where the last one did not arrive: what follows is the rest of it.
  bool await_request() {
    if (has_failed_ || !wait(POLLIN, Clock::now() + idle_time)) return false;
    deadline_ = Clock::now() + time_for_request;
    bytes_left_ = most_bytes_of_head;
    return true;
  }
  bool is_readable() const override { return wait(POLLIN, deadline_); }
  bool is_writable() const override { return wait(POLLOUT, Clock::now() + time_for_request); }
  ssize_t read(char* bytes, std::size_t size) override {
    const std::size_t most = std::min(size, bytes_left_);
    const ssize_t count = most > 0 && is_readable() ? recv(socket_, bytes, most, 0) : -1;
    has_failed_ = count <= 0;
    if (count > 0) bytes_left_ -= static_cast<std::size_t>(count);
    return count;
  }
  ssize_t write(const char* bytes, std::size_t size) override {
    return is_writable() ? send(socket_, bytes, size, MSG_NOSIGNAL) : -1;
  }
  // Nobody asks who is at the other end
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool wait(short event, Clock::time_point until) const {
    constexpr int slice_ms = 100;
    pollfd waiting{socket_, event, 0};
    while (listening_ != INVALID_SOCKET && Clock::now() < until)
      if (const int ready = poll(&waiting, 1, slice_ms); ready != 0) return ready > 0;
    return false;
  }

  socket_t socket_;
  const std::atomic<socket_t>& listening_;
  Clock::time_point deadline_{};
  std::size_t bytes_left_ = 0;
  bool has_failed_ = false;
};

/// httplib's server with connections that are timed.
class TimedServer : public httplib::Server {
 public:
  /// httplib's own does nothing where the server does not answer yet, which then answers for ever.
  void stop_listening() {
    const socket_t socket = svr_sock_.exchange(INVALID_SOCKET);
    if (socket == INVALID_SOCKET) return;
    shutdown(socket, SHUT_RDWR);
    close(socket);
  }
  /// httplib lets five clients wait to be accepted, and the kernel loses others. To listen once more changes the number.
  void let_clients_wait() const { ::listen(svr_sock_, static_cast<int>(connections_at_once)); }

 private:
  bool process_and_close_socket(socket_t socket) override {
    TimedStream stream(socket, svr_sock_);
    bool is_open = true;
    while (is_open && stream.await_request()) {
      bool is_closed = false;
      is_open = process_request(stream, false, is_closed, nullptr) && !is_closed;
    }
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return true;
  }
};

/// Without SO_REUSEPORT, which httplib sets: a second server at the same port would take a part of the first one's requests.
void set_socket_options(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
}

/// The names by which browsers on this machine may call the server.
std::vector<std::string> hosts_of(const HttpServerSettings& settings, int port) {
  std::vector<std::string> hosts;
  const std::string suffix = ":" + std::to_string(port);
  for (const std::string& name : {settings.address, std::string("127.0.0.1"), std::string("localhost"), std::string("[::1]")})
    hosts.push_back(name + suffix);
  return hosts;
}

void set_headers(httplib::Server& server) {
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cache-Control", "no-store"},
                              {"Content-Security-Policy",
                               "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' blob: data:; worker-src "
                               "'self' blob:; style-src 'self' "
                               "'unsafe-inline'; frame-ancestors 'none'"}});
}

void send_text(httplib::Response& response, int status, const char* text) {
  response.status = status;
  response.set_content(text, "text/plain");
}

/// Without compression, by which httplib makes the page wait for 1.5 s (Brotli at its highest level); on one machine it saves
/// nothing.
void send_as_it_is(httplib::Response& response, ViewReply reply) {
  const auto body = std::make_shared<const std::string>(std::move(reply.body));
  response.set_content_provider(body->size(), reply.type,
                                [body](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                  return sink.write(body->data() + offset, length);
                                });
}

}  // namespace

struct HttpServer::Impl {
  TimedServer server;
  Answer answer;
  std::vector<std::string> hosts;
  int port = 0;

  void take(const httplib::Request& request, httplib::Response& response) const {
    ViewQuery query;
    for (const auto& [name, value] : request.params) query.emplace(name, value);
    ViewReply reply = answer(std::string_view(request.path).substr(1), query);
    response.status = reply.status;
    if (!reply.body.empty()) send_as_it_is(response, std::move(reply));
  }
  /// Before anything else is read of a request.
  httplib::Server::HandlerResponse refuse(const httplib::Request& request, httplib::Response& response) const {
    if (std::ranges::find(hosts, request.get_header_value("Host")) == hosts.end())
      send_text(response, misdirected_request, "This server is asked for by its address only.\n");
    else if (request.method != "GET" && request.method != "HEAD")
      send_text(response, 405, "This server is read, and not written to.\n");
    else
      return httplib::Server::HandlerResponse::Unhandled;
    response.set_header("Connection", "close");
    return httplib::Server::HandlerResponse::Handled;
  }
};

HttpServer::HttpServer(const HttpServerSettings& settings, Answer answer) : impl_(std::make_unique<Impl>()) {
  Impl& impl = *impl_;
  impl.answer = std::move(answer);
  impl.server.new_task_queue = [] { return new httplib::ThreadPool(connections_at_once); };
  impl.server.set_payload_max_length(0);
  impl.server.set_tcp_nodelay(true);
  impl.server.set_socket_options(set_socket_options);
  set_headers(impl.server);
  impl.server.set_pre_routing_handler([&impl](const auto& request, auto& response) { return impl.refuse(request, response); });
  impl.server.Get("/.*", [&impl](const auto& request, auto& response) { impl.take(request, response); });
  if (settings.port == 0)
    impl.port = impl.server.bind_to_any_port(settings.address);
  else
    impl.port = impl.server.bind_to_port(settings.address, settings.port) ? settings.port : -1;
  const std::string place = settings.address + ":" + std::to_string(settings.port);
  if (impl.port <= 0) throw OutputError(place, "nobody can listen there: is another server at it? Choose another --port");
  impl.server.let_clients_wait();
  impl.hosts = hosts_of(settings, impl.port);
}

HttpServer::~HttpServer() { stop(); }

int HttpServer::port() const { return impl_->port; }

void HttpServer::run() { impl_->server.listen_after_bind(); }

void HttpServer::stop() { impl_->server.stop_listening(); }

}  // namespace farlod
