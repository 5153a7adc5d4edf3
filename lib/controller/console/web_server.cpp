#include "console/web_server.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <openssl/ssl.h>

#include "base/log_limiter.h"
#include "console/origin.h"
#include "console/web_connection.h"
#include "net/host_port.h"
#include "net/wire_error.h"

namespace robosim {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Pause after an error of accept(), for which file descriptors may be missing.
constexpr std::chrono::milliseconds kAcceptPause{100};

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

std::unique_ptr<asio::ssl::context> contextOf(const TlsIdentity& identity) {
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

std::string adviceFor(const boost::system::error_code& error) {
  if (error == asio::error::address_in_use) {
    return "is another program using the port? Name another with --listen, or :0 for any";
  }
  if (error == asio::error::access_denied) return "ports below 1024 are reserved; name another with --listen";
  return "name an address of this machine with --listen, such as 127.0.0.1:8080";
}

tcp::acceptor listenOn(asio::io_context& context, const std::string& listen) {
  const auto [host, port] = HostPort::of(listen);
  tcp::acceptor acceptor(context);
  boost::system::error_code error;
  const auto found = tcp::resolver(context).resolve(host, port, error);
  if (!error) {
    const tcp::endpoint endpoint = found.begin()->endpoint();
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  }
  if (error) throw std::runtime_error("cannot listen on " + listen + ": " + error.message() + "; " + adviceFor(error));
  return acceptor;
}

}  // namespace

struct WebServer::Impl final : public WebConnectionOwner {
  using Error = boost::system::error_code;
  using ConnectionPtr = std::shared_ptr<WebConnection>;

  Impl(const Options& the_options, WebPageHandler& the_handler)
      : options(the_options),
        handler(the_handler),
        tls(options.tls ? contextOf(*options.tls) : nullptr),
        acceptor(listenOn(context, options.listen)) {
    accept();
    setTimer();
  }
  ~Impl() override {
    is_over = true;  // the handler may be destroyed by now
    for (const auto& connection : std::set(connections)) connection->drop();
  }

  void accept();
  void setTimer();
  void makeRoom();
  ConnectionPtr sharedOf(const WebConnection& connection) const;
  ConnectionPtr find(PageId page) const;

  /// @name Calls of the connections
  ///@{
  WebAnswer answer(const WebRequest& request, bool has_body) override {
    return answerTo(request, has_body, options.files, hasTls());
  }
  bool hasTls() const override { return tls != nullptr; }
  const std::string& protocol() const override { return options.protocol; }
  bool mayOpen(const std::string& origin, const std::string& host, const std::string& offered) override;
  std::optional<PageId> opened(WebConnection& connection) override;
  void received(PageId page, std::string_view text) override { handler.received(page, text); }
  void receivedInvalid(PageId page, const std::string& why) override { handler.receivedInvalid(page, why); }
  WebMessagePtr next(PageId page) override { return handler.next(page); }
  void closed(WebConnection& connection) override;
  ///@}

  Options options;
  WebPageHandler& handler;
  LogLimiter log{[this](const std::string& line) { options.log(line); }};
  std::unique_ptr<asio::ssl::context> tls;
  asio::io_context context{1};
  tcp::acceptor acceptor;
  asio::steady_timer timer{context};
  asio::steady_timer accept_pause{context};
  std::set<ConnectionPtr> connections;
  std::vector<ConnectionPtr> requests;    ///< connections without a WebSocket, the oldest first
  std::map<PageId, ConnectionPtr> pages;  ///< connections with one
  PageId last_page = 0;
  std::atomic<bool> is_tick_requested{false};
  bool is_over = false;
};

void WebServer::Impl::setTimer() {
  timer.expires_after(kTick);
  timer.async_wait([this](const Error& error) {
    if (error) return;
    log.reportSuppressed();
    handler.tick();
    setTimer();
  });
}

void WebServer::Impl::accept() {
  acceptor.async_accept([this](const Error& error, tcp::socket socket) {
    if (is_over) return;
    if (error) {  // of file descriptors, for example, which a closed connection frees
      makeRoom();
      accept_pause.expires_after(kAcceptPause);
      accept_pause.async_wait([this](const Error&) {
        if (!is_over) accept();
      });
      return;
    }
    if (requests.size() >= kMaxRequests) makeRoom();
    const auto connection = std::make_shared<WebConnection>(*this, std::move(socket), tls.get());
    connections.insert(connection);
    requests.push_back(connection);
    connection->start();
    accept();
  });
}

/// Closes the oldest connection without a WebSocket of the address that has most of them, so that a peer with many
/// connections displaces only its own.
void WebServer::Impl::makeRoom() {
  if (requests.empty()) return;
  std::map<std::string, std::size_t> count;
  for (const auto& connection : requests) ++count[connection->peer()];
  const auto most =
      std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto oldest = std::find_if(requests.begin(), requests.end(),
                                   [&](const ConnectionPtr& connection) { return connection->peer() == most->first; });
  const ConnectionPtr connection = *oldest;
  connection->drop();
}

bool WebServer::Impl::mayOpen(const std::string& origin, const std::string& host, const std::string& offered) {
  const bool may = isSameOrigin(origin, host, options.listen);
  if (!may) {
    log.write("refused pages", "refused a page from " + inQuotes(origin) + " for " + inQuotes(host));
  }
  // The header may be a list; the console's page names one.
  return may && offered == options.protocol;
}

std::optional<PageId> WebServer::Impl::opened(WebConnection& connection) {
  if (pages.size() >= kMaxPages) {
    const auto leaving =
        std::find_if(pages.begin(), pages.end(), [](const auto& page) { return page.second->isDisconnecting(); });
    if (leaving == pages.end()) {
      log.write("pages beyond the limit", "refused a page at " + connection.peer() + ": there are " +
                                              std::to_string(kMaxPages) + ", the maximum");
      return std::nullopt;
    }
    const ConnectionPtr page = leaving->second;
    page->drop();
  }
  const PageId page = ++last_page;
  const ConnectionPtr shared = sharedOf(connection);
  std::erase(requests, shared);
  pages[page] = shared;
  handler.opened(page, connection.peer());
  return page;
}

WebServer::Impl::ConnectionPtr WebServer::Impl::sharedOf(const WebConnection& connection) const {
  const auto found = std::find_if(connections.begin(), connections.end(),
                                  [&](const ConnectionPtr& shared) { return shared.get() == &connection; });
  return found == connections.end() ? nullptr : *found;
}

WebServer::Impl::ConnectionPtr WebServer::Impl::find(PageId page) const {
  const auto found = pages.find(page);
  return found == pages.end() ? nullptr : found->second;
}

void WebServer::Impl::closed(WebConnection& connection) {
  const ConnectionPtr shared = sharedOf(connection);
  connections.erase(shared);
  std::erase(requests, shared);
  const PageId page = connection.page();
  if (pages.erase(page) > 0 && !is_over) handler.closed(page);
}

WebServer::WebServer(const Options& options, WebPageHandler& handler)
    : impl_(std::make_unique<Impl>(options, handler)) {}
WebServer::~WebServer() = default;

int WebServer::port() const { return impl_->acceptor.local_endpoint().port(); }

void WebServer::serve(const std::function<bool()>& interrupted) {
  while (!interrupted()) impl_->context.run_one_for(kTick);
}

void WebServer::requestTick() {
  if (impl_->is_tick_requested.exchange(true)) return;
  asio::post(impl_->context, [impl = impl_.get()] {
    impl->is_tick_requested = false;
    if (!impl->is_over) impl->handler.tick();
  });
}

void WebServer::wake(PageId page) {
  if (const auto connection = impl_->find(page)) connection->wake();
}

void WebServer::disconnect(PageId page, const std::string& why) {
  if (const auto connection = impl_->find(page)) connection->disconnect(why);
}

}  // namespace robosim
