#pragma once
#include <span>
#include <string>

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "web/server.h"

namespace robosim {

using WebRequest = boost::beast::http::request<boost::beast::http::empty_body>;
using WebAnswer = boost::beast::http::response<boost::beast::http::string_body>;

/// An answer without a file: the status and its name. It closes the connection, so that bytes after an invalid request
/// are never parsed as the next request.
WebAnswer refusalOf(boost::beast::http::status status, bool has_tls);

/// The answer to a request for a file: GET and HEAD of a known path without a body; anything else is refused.
/// @param has_body whether a body follows the header
WebAnswer answerTo(const WebRequest& request, bool has_body, std::span<const WebFile> files, bool has_tls);

/// Adds the headers of every answer: only resources of this server, no embedding in other pages, and with TLS
/// `Strict-Transport-Security` (RFC 6797).
void addSecurityHeaders(boost::beast::http::fields& fields, bool has_tls);

}  // namespace robosim
