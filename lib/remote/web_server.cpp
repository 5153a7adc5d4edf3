#include "remote/web_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include <libwebsockets.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>

#include "base/utf8.h"
#include "remote/origin.h"

namespace robosim {
namespace {

/// No message of a page is nearly as long.
constexpr std::size_t kLongestMessage = 4096;
constexpr std::size_t kHttpPiece = 16 * 1024;
constexpr unsigned kMostConnections = 1024;

// Silent for so long a connection is asked whether it still stands, and after so long it counts for dead.
constexpr lws_retry_bo kIdle = {nullptr, 0, 0, 5, 10, 0};

/// What every answer says to browsers: run nothing but what comes from here, and show this page in no other.
constexpr std::array kSecurityHeaders{
    std::pair{
        "content-security-policy:",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    std::pair{"x-content-type-options:", "nosniff"},
    std::pair{"referrer-policy:", "no-referrer"},
    std::pair{"cache-control:", "no-cache"},
};

std::string headerOf(lws* wsi, lws_token_indexes which) {
  const int length = lws_hdr_total_length(wsi, which);
  if (length <= 0) return "";
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  const int copied = lws_hdr_copy(wsi, text.data(), length + 1, which);
  text.resize(static_cast<std::size_t>(std::max(copied, 0)));
  return text;
}

/// libwebsockets takes the first certificate of a text only; these are who signed it.
void addChain(SSL_CTX* context, const std::string& certificate_pem) {
  BIO* text = BIO_new_mem_buf(certificate_pem.data(), static_cast<int>(certificate_pem.size()));
  X509_free(PEM_read_bio_X509(text, nullptr, nullptr, nullptr));
  while (X509* signer = PEM_read_bio_X509(text, nullptr, nullptr, nullptr)) {
    SSL_CTX_add_extra_chain_cert(context, signer);  // now it is the context's
  }
  BIO_free(text);
}

}  // namespace

WebMessage::WebMessage(std::string_view first, std::string_view second, bool is_binary)
    : bytes_(LWS_PRE + first.size() + second.size()), is_binary_(is_binary) {
  std::copy(first.begin(), first.end(), bytes_.begin() + LWS_PRE);
  std::copy(second.begin(), second.end(), bytes_.begin() + LWS_PRE + static_cast<std::ptrdiff_t>(first.size()));
}

struct WebServer::Impl {
  /// libwebsockets keeps one for each connection, all zero at first.
  struct Session {
    GuestId guest;        ///< a WebSocket's; 0 for none
    const WebFile* file;  ///< that is being sent
    std::size_t sent;     ///< of it
  };
  struct Connection {
    lws* wsi;
    std::string message;   ///< what has come of one
    std::string farewell;  ///< why it is hung up on
    bool is_leaving = false;
  };
  struct Timer {
    lws_sorted_usec_list_t entry;  ///< the first member, which is what libwebsockets hands back
    Impl* owner;
  };

  Impl(const Options& the_options, WebGuests& the_guests);
  ~Impl() {
    connections.clear();  // whom it concerned may be gone by now
    lws_context_destroy(context);
  }

  static int onEvent(lws* wsi, lws_callback_reasons reason, void* session, void* in, std::size_t length);
  static void onTimer(lws_sorted_usec_list_t* entry);

  int request(lws* wsi, Session& session, const std::string& path);
  int sendPiece(lws* wsi, Session& session);
  bool mayCome(lws* wsi) const;
  void come(lws* wsi, Session& session);
  int receive(lws* wsi, Session& session, std::string_view piece);
  int write(lws* wsi, Session& session);
  void leave(Session& session);
  void setTimer() { lws_sul_schedule(context, 0, &timer.entry, onTimer, std::chrono::microseconds(kTick).count()); }

  Options options;
  WebGuests& guests;
  std::array<lws_protocols, 3> protocols;
  lws_context* context = nullptr;
  lws_vhost* vhost = nullptr;
  Timer timer{};
  std::map<GuestId, Connection> connections;
  GuestId last_guest = 0;
};

WebServer::Impl::Impl(const Options& the_options, WebGuests& the_guests) : options(the_options), guests(the_guests) {
  // The first protocol is plain HTTP, and WebSockets that do not name theirs.
  protocols = {lws_protocols{"http", onEvent, sizeof(Session), kLongestMessage, 0, nullptr, 0},
               lws_protocols{options.protocol.c_str(), onEvent, sizeof(Session), kLongestMessage, 1, nullptr, 0},
               lws_protocols{}};
  lws_set_log_level(0, nullptr);
  const auto colon = options.listen.rfind(':');
  const std::string host = options.listen.substr(0, colon);

  lws_context_creation_info info{};
  info.port = CONTEXT_PORT_NO_LISTEN_SERVER;
  info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                 (options.tls ? LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT : 0);
  info.gid = static_cast<gid_t>(-1);
  info.uid = static_cast<uid_t>(-1);
  info.user = this;
  info.fd_limit_per_thread = kMostConnections;
  context = lws_create_context(&info);
  if (!context) throw std::runtime_error("libwebsockets does not start; is there memory left?");

  info.port = std::stoi(options.listen.substr(colon + 1));
  info.iface = host == "0.0.0.0" ? nullptr : host.c_str();
  info.protocols = protocols.data();
  info.retry_and_idle_policy = &kIdle;
  info.keepalive_timeout = 30;
  info.alpn = "http/1.1";
  if (options.tls) {
    info.server_ssl_cert_mem = options.tls->certificate_pem.data();
    info.server_ssl_cert_mem_len = static_cast<unsigned>(options.tls->certificate_pem.size());
    info.server_ssl_private_key_mem = options.tls->key_pem.data();
    info.server_ssl_private_key_mem_len = static_cast<unsigned>(options.tls->key_pem.size());
  }
  vhost = lws_create_vhost(context, &info);
  if (!vhost || lws_get_vhost_listen_port(vhost) <= 0) {
    lws_context_destroy(context);
    throw std::runtime_error("cannot listen on " + options.listen +
                             ": is another program using the port? Name another with --listen, or :0 for any");
  }
  timer.owner = this;
  setTimer();
}

void WebServer::Impl::onTimer(lws_sorted_usec_list_t* entry) {
  Impl& self = *reinterpret_cast<Timer*>(entry)->owner;
  self.guests.tick();
  self.setTimer();
}

int WebServer::Impl::onEvent(lws* wsi, lws_callback_reasons reason, void* session_memory, void* in,
                             std::size_t length) {
  auto* self = static_cast<Impl*>(lws_context_user(lws_get_context(wsi)));
  auto* session = static_cast<Session*>(session_memory);
  switch (reason) {
    case LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS:
      addChain(static_cast<SSL_CTX*>(session_memory), self->options.tls->certificate_pem);
      return 0;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:  // somebody has rung; told once for each protocol
      if (lws_get_protocol(wsi)->id == 1) self->guests.tick();
      return 0;
    case LWS_CALLBACK_HTTP:
      return self->request(wsi, *session, std::string(static_cast<const char*>(in), length));
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return self->sendPiece(wsi, *session);
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
      return self->mayCome(wsi) ? 0 : 1;
    case LWS_CALLBACK_ESTABLISHED:
      self->come(wsi, *session);
      return 0;
    case LWS_CALLBACK_RECEIVE:
      return self->receive(wsi, *session, {static_cast<const char*>(in), length});
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return self->write(wsi, *session);
    case LWS_CALLBACK_CLOSED:
      self->leave(*session);
      return 0;
    default:
      return 0;
  }
}

int WebServer::Impl::request(lws* wsi, Session& session, const std::string& path) {
  const auto file =
      std::find_if(options.files.begin(), options.files.end(), [&](const auto& f) { return f.path == path; });
  const bool is_get = lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) > 0;
  if (file == options.files.end() || !is_get) {
    lws_return_http_status(wsi, is_get ? HTTP_STATUS_NOT_FOUND : HTTP_STATUS_METHOD_NOT_ALLOWED, nullptr);
    return lws_http_transaction_completed(wsi) ? -1 : 0;
  }
  std::array<unsigned char, LWS_PRE + 2048> buffer;
  unsigned char* begin = buffer.data() + LWS_PRE;
  unsigned char* at = begin;
  unsigned char* end = buffer.data() + buffer.size() - 1;
  bool fits = lws_add_http_common_headers(wsi, HTTP_STATUS_OK, file->type.c_str(), file->bytes.size(), &at, end) == 0;
  for (const auto& [name, value] : kSecurityHeaders) {
    fits = fits && lws_add_http_header_by_name(wsi, reinterpret_cast<const unsigned char*>(name),
                                               reinterpret_cast<const unsigned char*>(value),
                                               static_cast<int>(std::strlen(value)), &at, end) == 0;
  }
  if (!fits || lws_finalize_write_http_header(wsi, begin, &at, end) != 0) return -1;
  session.file = &*file;
  session.sent = 0;
  lws_callback_on_writable(wsi);
  return 0;
}

int WebServer::Impl::sendPiece(lws* wsi, Session& session) {
  if (!session.file) return 0;
  const auto rest = session.file->bytes.subspan(session.sent);
  const auto piece = rest.first(std::min(rest.size(), kHttpPiece));
  std::array<unsigned char, LWS_PRE + kHttpPiece> buffer;
  std::copy(piece.begin(), piece.end(), buffer.begin() + LWS_PRE);
  const bool is_last = piece.size() == rest.size();
  const int written =
      lws_write(wsi, buffer.data() + LWS_PRE, piece.size(), is_last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP);
  if (written < static_cast<int>(piece.size())) return -1;
  session.sent += piece.size();
  if (is_last) {
    session.file = nullptr;
    return lws_http_transaction_completed(wsi) ? -1 : 0;
  }
  lws_callback_on_writable(wsi);
  return 0;
}

bool WebServer::Impl::mayCome(lws* wsi) const {
  if (lws_get_protocol(wsi)->id != 1) return false;
  const std::string origin = headerOf(wsi, WSI_TOKEN_ORIGIN);
  const std::string host = headerOf(wsi, WSI_TOKEN_HOST);
  const bool may = isSameOrigin(origin, host, options.listen);
  if (!may) options.log("refused a page from " + inQuotes(origin) + " that wants to talk to " + inQuotes(host));
  return may;
}

void WebServer::Impl::come(lws* wsi, Session& session) {
  session.guest = ++last_guest;
  connections[session.guest].wsi = wsi;
  std::array<char, 64> peer{};
  lws_get_peer_simple(wsi, peer.data(), peer.size());
  const std::string_view address(peer.data());
  constexpr std::string_view mapped = "::ffff:";  // an IPv4 address, where the port takes both kinds
  guests.came(session.guest, std::string(address.substr(address.starts_with(mapped) ? mapped.size() : 0)));
}

int WebServer::Impl::receive(lws* wsi, Session& session, std::string_view piece) {
  Connection& connection = connections.at(session.guest);
  if (connection.is_leaving) return 0;
  std::string why;
  if (lws_frame_is_binary(wsi)) why = "a binary message; messages are text";
  if (connection.message.size() + piece.size() > kLongestMessage) {
    why = "a message of more than " + std::to_string(kLongestMessage) + " bytes";
  }
  if (why.empty()) {
    connection.message += piece;
    if (lws_remaining_packet_payload(wsi) > 0 || !lws_is_final_fragment(wsi)) return 0;
    const std::string message = std::exchange(connection.message, "");
    try {
      guests.said(session.guest, message);
    } catch (const WireError& error) {
      why = error.what();
    }
  }
  if (why.empty()) return 0;
  options.log("hung up on a page: " + why);
  connection.farewell = why;
  connection.is_leaving = true;
  lws_callback_on_writable(wsi);
  return 0;
}

int WebServer::Impl::write(lws* wsi, Session& session) {
  const auto found = connections.find(session.guest);
  if (found == connections.end()) return -1;
  Connection& connection = found->second;
  const auto message = guests.next(session.guest);
  if (message) {
    // libwebsockets writes the header into the room before the bytes, whoever it is for: the message stays the same.
    auto& bytes = const_cast<std::vector<unsigned char>&>(message->bytes_);
    const std::size_t size = bytes.size() - LWS_PRE;
    const int written =
        lws_write(wsi, bytes.data() + LWS_PRE, size, message->is_binary_ ? LWS_WRITE_BINARY : LWS_WRITE_TEXT);
    if (written < static_cast<int>(size)) return -1;
    lws_callback_on_writable(wsi);
    return 0;
  }
  if (!connection.is_leaving) return 0;
  constexpr std::size_t most = 123;  // of a closing frame, which must be UTF-8
  std::string why = connection.farewell.substr(0, most);
  while (!isUtf8(why)) why.pop_back();
  lws_close_reason(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, reinterpret_cast<unsigned char*>(why.data()), why.size());
  return -1;
}

void WebServer::Impl::leave(Session& session) {
  const GuestId guest = std::exchange(session.guest, 0);
  if (connections.erase(guest) > 0) guests.left(guest);
}

WebServer::WebServer(const Options& options, WebGuests& guests) : impl_(std::make_unique<Impl>(options, guests)) {}
WebServer::~WebServer() = default;

int WebServer::port() const { return lws_get_vhost_listen_port(impl_->vhost); }

void WebServer::serve(const std::function<bool()>& interrupted) {
  while (!interrupted() && lws_service(impl_->context, 0) >= 0) {
  }
}

void WebServer::ring() { lws_cancel_service(impl_->context); }

void WebServer::wake(GuestId guest) {
  const auto found = impl_->connections.find(guest);
  if (found != impl_->connections.end()) lws_callback_on_writable(found->second.wsi);
}

void WebServer::hangUp(GuestId guest, const std::string& why) {
  const auto found = impl_->connections.find(guest);
  if (found == impl_->connections.end()) return;
  found->second.farewell = why;
  found->second.is_leaving = true;
  lws_callback_on_writable(found->second.wsi);
}

}  // namespace robosim
