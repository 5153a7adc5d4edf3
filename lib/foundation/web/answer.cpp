#include "web/answer.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace robosim {
namespace {

namespace http = boost::beast::http;

constexpr std::array kSecurityHeaders{
    std::pair{
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    std::pair{"X-Content-Type-Options", "nosniff"},
    std::pair{"X-Frame-Options", "DENY"},
    std::pair{"Referrer-Policy", "no-referrer"},
    std::pair{"Cross-Origin-Opener-Policy", "same-origin"},
    std::pair{"Cross-Origin-Resource-Policy", "same-origin"},
    std::pair{"Cache-Control", "no-cache"},
};

/// A year, for this host name only, without its subdomains.
constexpr const char* kStrictTransport = "max-age=31536000";

std::string_view viewOf(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

void addSecurityHeaders(http::fields& fields, bool has_tls) {
  for (const auto& [name, value] : kSecurityHeaders) fields.set(name, value);
  if (has_tls) fields.set("Strict-Transport-Security", kStrictTransport);
}

WebAnswer refusalOf(http::status status, bool has_tls) {
  WebAnswer answer(status, 11);
  addSecurityHeaders(answer, has_tls);
  answer.set(http::field::content_type, "text/plain; charset=utf-8");
  const auto reason = http::obsolete_reason(status);
  answer.body() = std::string(reason.data(), reason.size()) + "\n";
  if (status == http::status::method_not_allowed) answer.set(http::field::allow, "GET, HEAD");
  answer.keep_alive(false);
  answer.prepare_payload();
  return answer;
}

WebAnswer answerTo(const WebRequest& request, bool has_body, std::span<const WebFile> files, bool has_tls) {
  const bool is_head = request.method() == http::verb::head;
  if (request.method() != http::verb::get && !is_head) return refusalOf(http::status::method_not_allowed, has_tls);
  if (has_body) return refusalOf(http::status::bad_request, has_tls);
  const std::string_view target = viewOf(request.target());
  const std::string_view path = target.substr(0, target.find('?'));
  const auto file = std::find_if(files.begin(), files.end(), [&](const WebFile& f) { return f.path == path; });
  if (file == files.end()) return refusalOf(http::status::not_found, has_tls);

  WebAnswer answer(http::status::ok, request.version());
  addSecurityHeaders(answer, has_tls);
  answer.set(http::field::content_type, file->type);
  answer.keep_alive(request.keep_alive());
  answer.content_length(file->bytes.size());
  if (!is_head) answer.body().assign(file->bytes.begin(), file->bytes.end());
  return answer;
}

}  // namespace robosim
