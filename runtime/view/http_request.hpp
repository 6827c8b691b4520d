// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace farlod
