#include "web/server.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <stdexcept>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <openssl/ssl.h>

#include "base/log_limiter.h"
#include "net/connection_acceptor.h"
#include "net/network_turns.h"
#include "net/processor_budget.h"
#include "net/wire_error.h"
#include "web/connection.h"
#include "web/origin.h"

namespace robosim {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Connections that are accepted, and started, before other events have their turn.
constexpr std::size_t kConnectionsAtOnce = 16;

/// Shares of the processor that accepting connections, and new connections until they have sent their request, use at
/// most, so that floods of them hardly delay the pages.
constexpr double kAcceptShare = 0.1, kNewConnectionsShare = 0.2;
constexpr std::chrono::milliseconds kNewConnectionsBurst{50};  ///< of processor time
/// Processor time of the server's thread that is charged to one new connection at most: a TLS handshake takes about
/// 1 ms.
constexpr std::chrono::milliseconds kNewConnectionMax{2};

/// Elliptic-curve Diffie-Hellman and authenticated encryption only: no CBC, and forward secrecy. TLS 1.3 has no other
/// ciphers.
constexpr const char* kTls12Ciphers = "ECDHE+AESGCM:ECDHE+CHACHA20";

int selectHttp11(SSL*, const unsigned char** out, unsigned char* out_size, const unsigned char* in, unsigned in_size,
                 void*) {
  static constexpr unsigned char kHttp11[] = "\x08http/1.1";
  unsigned char* selected = nullptr;
  const int found = SSL_select_next_proto(&selected, out_size, kHttp11, sizeof(kHttp11) - 1, in, in_size);
  *out = selected;
  return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_NOACK;
}

std::unique_ptr<asio::ssl::context> makeContext(const TlsIdentity& identity) {
  auto context = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
  SSL_CTX* native = context->native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(native, kTls12Ciphers);
  SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_alpn_select_cb(native, selectHttp11, nullptr);
  try {
    context->use_certificate_chain(asio::buffer(identity.certificate_pem));
    context->use_private_key(asio::buffer(identity.key_pem), asio::ssl::context::pem);
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(std::string("OpenSSL refuses the certificate or its key: ") + error.what() +
                             "; create new ones, as doc/security.md shows");
  }
  return context;
}

}  // namespace

struct WebServer::Impl {
  using Error = boost::system::error_code;
  using ConnectionPtr = std::shared_ptr<WebConnection>;

  Impl(const Options& the_options, WebPageEvents the_events)
      : options(the_options),
        events(std::move(the_events)),
        tls(options.tls ? makeContext(*options.tls) : nullptr),
        acceptor({std::make_shared<const ConnectionListener>(options.listen, options.option)},
                 {.pending = "connections without a WebSocket",
                  .max_pending = kMaxRequests,
                  .take = [this](const AcceptedConnection& accepted) { return take(accepted); },
                  .close = [this](ConnectionAcceptor::Number number) { drop(connections.at(number)); }}),
        listening(context, acceptor.descriptor()) {
    awaitConnections();
    setTimer();
  }
  ~Impl() {
    is_over = true;  // the object that handles events may be destroyed by now
    while (!connections.empty()) drop(connections.begin()->second);
    listening.release();
  }

  void awaitConnections();
  void startConnections();
  std::chrono::milliseconds chargeNewConnections();
  bool take(const AcceptedConnection& accepted);
  static void drop(ConnectionPtr connection) { connection->drop(); }  // which removes it from the others
  void setTimer();
  ConnectionPtr find(PageId page) const;

  /// @name Called by the connections
  ///@{
  std::optional<std::string> chooseProtocol(const std::string& origin, const std::string& host,
                                            const std::string& offered);
  std::optional<PageId> opened(WebConnection& connection, const std::string& target);
  void closed(WebConnection& connection);
  ///@}

  Options options;
  const WebPageEvents events;
  LogLimiter log{[this](const std::string& line) { options.log(line); }};
  std::unique_ptr<asio::ssl::context> tls;
  const SharedByConnections shared{
      .options = options,
      .events = events,
      .tls = tls.get(),
      .choose_protocol = [this](const std::string& origin, const std::string& host,
                                const std::string& offered) { return chooseProtocol(origin, host, offered); },
      .opened = [this](WebConnection& connection, const std::string& target) { return opened(connection, target); },
      .closed = [this](WebConnection& connection) { closed(connection); }};
  asio::io_context context{1};
  ConnectionAcceptor acceptor;
  asio::posix::stream_descriptor listening;  ///< of the acceptor, which owns it
  asio::steady_timer timer{context};
  asio::steady_timer accept_pause{context}, start_pause{context};
  NetworkTurns waiting;  ///< connections that have been accepted, and not started
  bool is_start_due = false;
  ProcessorBudget accept_budget{kAcceptShare, kNewConnectionsBurst};
  ProcessorBudget budget{kNewConnectionsShare, kNewConnectionsBurst};  ///< of new connections
  std::chrono::nanoseconds charged_until{0};                           ///< of the thread's processor time
  std::chrono::nanoseconds chargeable{0};                              ///< that new connections may still use
  std::map<ConnectionAcceptor::Number, ConnectionPtr> connections;
  std::map<PageId, ConnectionPtr> pages;  ///< those with a WebSocket
  PageId last_page = 0;
  std::atomic<bool> is_tick_requested{false};
  bool is_over = false;
};

void WebServer::Impl::setTimer() {
  timer.expires_after(kTick);
  timer.async_wait([this](const Error& error) {
    if (error) return;
    log.reportSuppressed();
    events.tick();
    setTimer();
  });
}

void WebServer::Impl::awaitConnections() {
  listening.async_wait(asio::posix::stream_descriptor::wait_read, [this](const Error& error) {
    if (error || is_over) return;
    const auto begin = processorTimeOfThread();
    const bool may_continue = acceptor.accept(kConnectionsAtOnce);
    accept_budget.spend(processorTimeOfThread() - begin, std::chrono::steady_clock::now());
    if (!is_start_due) startConnections();
    const auto pause = may_continue ? accept_budget.wait(std::chrono::steady_clock::now()) : ConnectionAcceptor::kPause;
    accept_pause.expires_after(pause);
    accept_pause.async_wait([this](const Error& canceled) {
      if (!canceled) awaitConnections();
    });
  });
}

/// Starts the connections that wait, as far as the budget permits, and the others later.
void WebServer::Impl::startConnections() {
  auto pause = chargeNewConnections();
  for (std::size_t i = 0; i < kConnectionsAtOnce && pause.count() == 0; ++i) {
    const auto number = waiting.next();
    if (!number) break;
    chargeable = std::min<std::chrono::nanoseconds>(chargeable + kNewConnectionMax, kNewConnectionsBurst);
    connections.at(*number)->start();
    pause = chargeNewConnections();
  }
  is_start_due = !waiting.isEmpty();
  if (!is_start_due) return;
  start_pause.expires_after(pause);
  start_pause.async_wait([this](const Error& canceled) {
    if (!canceled) startConnections();
  });
}

/// Charges the thread's processor time since the last call to the budget of new connections, as far as they can have
/// used it. @return the time until another may be started
std::chrono::milliseconds WebServer::Impl::chargeNewConnections() {
  const auto now = std::chrono::steady_clock::now();
  const auto used_until = processorTimeOfThread();
  const auto used = std::min(used_until - std::exchange(charged_until, used_until), chargeable);
  chargeable -= used;
  budget.spend(used, now);
  return budget.wait(now);
}

bool WebServer::Impl::take(const AcceptedConnection& accepted) {
  tcp::socket socket(context);
  Error error;
  socket.assign(accepted.peer.is_ipv6 ? tcp::v6() : tcp::v4(), accepted.socket, error);
  if (error) return false;
  const auto connection =
      std::make_shared<WebConnection>(shared, std::move(socket), accepted.number, accepted.peer.host);
  connections[accepted.number] = connection;
  waiting.add(accepted.number, accepted.peer.network());
  return true;
}

std::optional<std::string> WebServer::Impl::chooseProtocol(const std::string& origin, const std::string& host,
                                                           const std::string& offered) {
  if (!(options.may_open ? options.may_open(origin, host) : isSameOrigin(origin, host, options.listen))) {
    log.write("refused pages", "refused a page from " + inQuotes(origin) + " for " + inQuotes(host));
    return std::nullopt;
  }
  // The header is a list: "a, b".
  boost::beast::http::token_list list(offered);
  const auto found = std::find_if(options.protocols.begin(), options.protocols.end(),
                                  [&](const std::string& protocol) { return list.exists(protocol); });
  if (found == options.protocols.end()) return std::nullopt;
  return *found;
}

std::optional<PageId> WebServer::Impl::opened(WebConnection& connection, const std::string& target) {
  if (pages.size() >= kMaxPages) {
    const auto leaving =
        std::find_if(pages.begin(), pages.end(), [](const auto& page) { return page.second->isDisconnecting(); });
    if (leaving == pages.end()) {
      log.write("pages beyond the limit", "refused a page at " + connection.peer() + ": there are " +
                                              std::to_string(kMaxPages) + ", the maximum");
      return std::nullopt;
    }
    drop(leaving->second);
  }
  const PageId page = ++last_page;
  acceptor.release(connection.number());
  pages[page] = connections.at(connection.number());
  events.opened(page, {connection.peer(), target});
  return page;
}

WebServer::Impl::ConnectionPtr WebServer::Impl::find(PageId page) const {
  const auto found = pages.find(page);
  return found == pages.end() ? nullptr : found->second;
}

void WebServer::Impl::closed(WebConnection& connection) {
  const PageId page = connection.page();
  acceptor.release(connection.number());
  waiting.remove(connection.number());
  connections.erase(connection.number());
  if (pages.erase(page) > 0 && !is_over) events.closed(page);
}

WebServer::WebServer(const Options& options, WebPageEvents events)
    : impl_(std::make_unique<Impl>(options, std::move(events))) {}
WebServer::~WebServer() = default;

int WebServer::port() const { return impl_->acceptor.listeners().front()->port(); }

void WebServer::serve(const std::function<bool()>& interrupted) {
  while (!interrupted()) impl_->context.run_one_for(kTick);
}

void WebServer::requestTick() {
  if (impl_->is_tick_requested.exchange(true)) return;
  asio::post(impl_->context, [impl = impl_.get()] {
    impl->is_tick_requested = false;
    if (!impl->is_over) impl->events.tick();
  });
}

void WebServer::wake(PageId page) {
  if (const auto connection = impl_->find(page)) connection->wake();
}

bool WebServer::isSending() const {
  return std::any_of(impl_->pages.begin(), impl_->pages.end(),
                     [](const auto& page) { return page.second->isSending(); });
}

void WebServer::disconnect(PageId page, const std::string& why) {
  if (const auto connection = impl_->find(page)) connection->disconnect(why);
}

}  // namespace robosim
