// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/http_server.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <cerrno>
#include <charconv>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include "farlod/error.hpp"

namespace farlod {
namespace {

namespace http = boost::beast::http;

/// Empty where the field is missing.
std::string_view value_of(const http::request_header<>& header, http::field field) {
  const auto value = header[field];
  return {value.data(), value.size()};
}

/// What stands in front of the separator, which is taken off `text` with it; all of `text` where there is none.
std::string_view take_until(std::string_view& text, std::string_view separator) {
  const std::size_t end = text.find(separator);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + separator.size());
  return taken;
}

/// The character of two hexadecimal digits. Nothing where they are none.
std::optional<char> character_of(std::string_view digits) {
  unsigned char value = 0;
  const char* const end = digits.data() + digits.size();
  const bool is_number = digits.size() == 2 && std::from_chars(digits.data(), end, value, 16).ptr == end;
  return is_number ? std::optional(static_cast<char>(value)) : std::nullopt;
}

/// A per cent sign that begins no character stays as it is.
std::string decoded(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const auto character = text.front() == '%' ? character_of(text.substr(1, 2)) : std::nullopt;
    plain += character.value_or(text.front());
    text.remove_prefix(character ? 3 : 1);
  }
  return plain;
}

/// A value of a query, where a plus sign is a blank.
std::string decoded_value(std::string_view text) {
  std::string blanks(text);
  std::ranges::replace(blanks, '+', ' ');
  return decoded(blanks);
}

/// The first value of a name is taken.
ViewQuery query_of(std::string_view text) {
  ViewQuery query;
  while (!text.empty()) {
    std::string_view value = take_until(text, "&");
    const std::string_view name = take_until(value, "=");
    query.emplace(decoded_value(name), decoded_value(value));
  }
  return query;
}

/// The head of a message, if that is all of the text. Beast refuses what RFC 9112 does.
std::optional<http::request_header<>> header_of(std::string_view head) {
  const std::string text = std::string(head) + "\r\n\r\n";
  http::request_parser<http::empty_body> parser;
  boost::system::error_code error;
  const std::size_t length = parser.put(boost::asio::buffer(text), error);
  if (error || !parser.is_header_done() || length != text.size()) return std::nullopt;
  return parser.release().base();
}

bool announces_body(const http::request_header<>& header) {
  const std::string_view length = value_of(header, http::field::content_length);
  return header.count(http::field::transfer_encoding) > 0 || (!length.empty() && length != "0");
}

using Clock = std::chrono::steady_clock;

constexpr std::size_t connections_at_once = 128;
constexpr std::size_t most_bytes_of_head = std::size_t{16} << 10U;
/// How long a wait may last before it asks whether the server has been stopped.
constexpr auto slice = std::chrono::milliseconds(100);

/// Nothing is compressed: on one machine it saves nothing, and the page waits for it.
constexpr std::string_view headers_of_all =
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cache-Control: no-store\r\n"
    "Content-Security-Policy: default-src 'self'; img-src 'self' blob: data:; connect-src 'self' blob: data:; "
    "worker-src 'self' blob:; style-src 'self' 'unsafe-inline'; frame-ancestors 'none'\r\n";

/// A socket that closes itself.
class Socket {
 public:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Socket& operator=(Socket&&) = delete;
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  void set_option(int level, int name) const {
    const int yes = 1;
    setsockopt(descriptor_, level, name, &yes, sizeof(yes));
  }

 private:
  int descriptor_;
};

/// A connection, each of whose requests must arrive within a time and a size, however slowly it is sent.
class TimedConnection {
 public:
  TimedConnection(Socket socket, const HttpServerSettings& times, const std::atomic<bool>& is_stopped)
      : socket_(std::move(socket)), times_(times), is_stopped_(is_stopped) {}

  /// The next head of a request, but for its empty line. Nothing where none arrives.
  std::optional<std::string> next_head() {
    constexpr std::string_view end_of_head = "\r\n\r\n";
    if (received_.empty() && !wait(POLLIN, Clock::now() + times_.idle_time)) return std::nullopt;
    const auto deadline = Clock::now() + times_.time_for_request;
    std::size_t end = 0;
    while ((end = received_.find(end_of_head)) == std::string::npos)
      if (!receive_more(deadline)) return std::nullopt;
    std::string head = received_.substr(0, end);
    received_.erase(0, end + end_of_head.size());
    return head;
  }
  /// False where the other side does not take it.
  bool send_all(std::string_view bytes) const {
    while (!bytes.empty() && wait(POLLOUT, Clock::now() + times_.time_for_request)) {
      const ssize_t count = send(socket_.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count < 0 && errno != EAGAIN) break;
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return bytes.empty();
  }

 private:
  bool receive_more(Clock::time_point deadline) {
    char bytes[4096];
    const std::size_t most = std::min(sizeof(bytes), most_bytes_of_head - std::min(received_.size(), most_bytes_of_head));
    const ssize_t count = most > 0 && wait(POLLIN, deadline) ? recv(socket_.descriptor(), bytes, most, 0) : -1;
    if (count > 0) received_.append(bytes, static_cast<std::size_t>(count));
    return count > 0;
  }
  bool wait(short event, Clock::time_point until) const {
    pollfd waiting{socket_.descriptor(), event, 0};
    while (!is_stopped_ && Clock::now() < until)
      if (const int ready = poll(&waiting, 1, static_cast<int>(slice.count())); ready != 0) return ready > 0;
    return false;
  }

  Socket socket_;
  const HttpServerSettings& times_;
  const std::atomic<bool>& is_stopped_;
  std::string received_;  ///< and not yet taken
};

/// A socket that listens at an address of the system's list. Nothing where it cannot.
std::optional<Socket> listening_at(const addrinfo& address) {
  Socket socket(::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC, address.ai_protocol));
  // Not SO_REUSEPORT: a second server at the same port would take a part of the first one's requests
  socket.set_option(SOL_SOCKET, SO_REUSEADDR);
  // Connections have it from here
  socket.set_option(IPPROTO_TCP, TCP_NODELAY);
  const bool listens = bind(socket.descriptor(), address.ai_addr, address.ai_addrlen) == 0 &&
                       listen(socket.descriptor(), static_cast<int>(connections_at_once)) == 0;
  return listens ? std::optional(std::move(socket)) : std::nullopt;
}

/// What to tell of an address at which bind() or listen() failed with this error.
std::string why_deaf(const HttpServerSettings& settings, int error) {
  const std::string port = std::to_string(settings.port);
  if (error == EADDRNOTAVAIL)
    return settings.address + " is not an address of this machine: choose another --listen, such as 127.0.0.1";
  if (error == EACCES) return "port " + port + " is for the system alone: choose another --port, from 1024 on";
  return "nobody can listen at port " + port + " of " + settings.address + ": is another server at it? Choose another --port";
}

Socket listening_socket(const HttpServerSettings& settings) {
  addrinfo wanted{};
  wanted.ai_flags = AI_PASSIVE;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(settings.address.c_str(), std::to_string(settings.port).c_str(), &wanted, &found) != 0)
    throw OutputError(settings.address + " is not an address: give --listen one like 127.0.0.1, and the port as --port");
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, [](addrinfo* list) {
    if (list != nullptr) freeaddrinfo(list);
  });
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next)
    if (auto socket = listening_at(*address)) return std::move(*socket);
  throw OutputError(why_deaf(settings, errno));
}

int port_of(const Socket& socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  getsockname(socket.descriptor(), reinterpret_cast<sockaddr*>(&address), &size);
  // The port is at the same place in both families
  return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

/// The names by which browsers on this machine may call the server.
std::vector<std::string> hosts_of(const HttpServerSettings& settings, int port) {
  std::vector<std::string> hosts;
  const std::string suffix = ":" + std::to_string(port);
  for (const std::string& name : {settings.address, std::string("127.0.0.1"), std::string("localhost"), std::string("[::1]")})
    hosts.push_back(name + suffix);
  return hosts;
}

ViewReply refusal(int status, const char* text) { return {.status = status, .type = "text/plain", .body = text}; }

/// All of a reply that stands in front of its body. The words behind the status are left out, as they may be.
std::string head_of(const ViewReply& reply, bool keeps_connection) {
  std::string head = "HTTP/1.1 " + std::to_string(reply.status) + " \r\n";
  head += headers_of_all;
  head += "Content-Type: " + reply.type + "\r\nContent-Length: " + std::to_string(reply.body.size()) + "\r\n";
  return head + (keeps_connection ? "\r\n" : "Connection: close\r\n\r\n");
}

}  // namespace

std::optional<HttpRequest> http_request_of(std::string_view head) {
  const auto header = header_of(head);
  // A second host is refused: a server in between could take the other one for what is meant
  if (!header || !header->target().starts_with('/') || header->count(http::field::host) > 1) return std::nullopt;
  std::string_view target(header->target().data(), header->target().size());
  const std::string path = decoded(take_until(target, "?"));
  return HttpRequest{.method = std::string(header->method_string()),
                     .path = path,
                     .query = query_of(target),
                     .host = std::string(value_of(*header, http::field::host)),
                     .has_body = announces_body(*header),
                     .keeps_connection = http::message<true, http::empty_body>(*header).keep_alive()};
}

struct HttpServer::Impl {
  HttpServerSettings settings;
  Socket listening;
  Answer answer;
  int port = port_of(listening);
  std::vector<std::string> hosts = {};
  std::atomic<bool> is_stopped = false;

  /// One of the threads that wait for connections, all at the same socket.
  void serve_connections() const {
    while (!is_stopped) {
      const int descriptor = accept4(listening.descriptor(), nullptr, nullptr, SOCK_CLOEXEC);
      if (descriptor >= 0)
        serve(TimedConnection(Socket(descriptor), settings, is_stopped));
      else if (!is_stopped)  // out of what the system will have again
        std::this_thread::sleep_for(slice);
    }
  }
  void serve(TimedConnection connection) const {
    bool is_open = true;
    while (is_open) {
      const auto head = connection.next_head();
      is_open = head && answer_one(connection, http_request_of(*head));
    }
  }
  /// Whether another request may follow.
  bool answer_one(const TimedConnection& connection, const std::optional<HttpRequest>& request) const {
    const std::optional<ViewReply> refused = refusal_of(request);
    const bool keeps_connection = !refused && request->keeps_connection;
    const ViewReply reply = refused ? *refused : answer_of(*request);
    const bool has_body = !request || request->method != "HEAD";
    return connection.send_all(head_of(reply, keeps_connection)) && (!has_body || connection.send_all(reply.body)) &&
           keeps_connection;
  }
  std::optional<ViewReply> refusal_of(const std::optional<HttpRequest>& request) const {
    if (!request) return refusal(400, "This is no request of HTTP/1.1.\n");
    if (std::ranges::find(hosts, request->host) == hosts.end())
      return refusal(421, "This server is asked for by its address only.\n");
    if (request->method != "GET" && request->method != "HEAD") return refusal(405, "This server is read, and not written to.\n");
    if (request->has_body) return refusal(413, "This server takes no bodies of requests.\n");
    return std::nullopt;
  }
  /// What goes wrong ends the request, and not the server.
  ViewReply answer_of(const HttpRequest& request) const {
    try {
      return answer(std::string_view(request.path).substr(1), request.query);
    } catch (const std::exception& error) {
      return refusal(500, error.what());
    }
  }
};

HttpServer::HttpServer(const HttpServerSettings& settings, Answer answer)
    : impl_(new Impl{.settings = settings, .listening = listening_socket(settings), .answer = std::move(answer)}) {
  impl_->hosts = hosts_of(settings, impl_->port);
}

HttpServer::~HttpServer() { stop(); }

int HttpServer::port() const { return impl_->port; }

void HttpServer::run() {
  std::vector<std::jthread> threads;
  for (std::size_t n = 0; n < connections_at_once; ++n) threads.emplace_back([this] { impl_->serve_connections(); });
}

void HttpServer::stop() {
  impl_->is_stopped = true;
  // Ends all waiting for connections
  shutdown(impl_->listening.descriptor(), SHUT_RDWR);
}

}  // namespace farlod
