#include "net/tls.h"

#include <csignal>
#include <ctime>
#include <new>
#include <stdexcept>

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <poll.h>

#include "base/error_list.h"
#include "net/host_port.h"
#include "net/private_file.h"

namespace robosim {
namespace {

struct Free {
  void operator()(BIO* bio) const { BIO_free_all(bio); }
  void operator()(X509* certificate) const { X509_free(certificate); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
  void operator()(SSL* ssl) const { SSL_free(ssl); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

/// For its lifetime, a write of the calling thread to a connection that the peer has closed is an error only. OpenSSL
/// writes without MSG_NOSIGNAL, and SIGPIPE would end the process.
class SigpipeBlock {
 public:
  SigpipeBlock() {
    sigemptyset(&sigpipe_);
    sigaddset(&sigpipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &sigpipe_, &before_);
  }
  ~SigpipeBlock() {
    if (sigismember(&before_, SIGPIPE) == 1) return;
    const timespec at_once{};
    while (sigtimedwait(&sigpipe_, nullptr, &at_once) > 0) {  // discards it
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SigpipeBlock(const SigpipeBlock&) = delete;
  SigpipeBlock& operator=(const SigpipeBlock&) = delete;

 private:
  sigset_t sigpipe_{}, before_{};
};

Owned<BIO> makeBio(const std::string& text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

/// Passphrase callback that refuses encrypted keys, instead of prompting on the terminal.
int noPassphrase(char*, int, int, void*) { return 0; }

Owned<X509> nextCertificate(BIO* pem) {
  Owned<X509> certificate(PEM_read_bio_X509(pem, nullptr, noPassphrase, nullptr));
  ERR_clear_error();
  return certificate;
}

std::string textOf(const ASN1_TIME* time) {
  const Owned<BIO> text(BIO_new(BIO_s_mem()));
  ASN1_TIME_print(text.get(), time);
  char* begin = nullptr;
  const auto size = BIO_get_mem_data(text.get(), &begin);
  return {begin, static_cast<std::size_t>(size)};
}

void checkDates(X509* certificate, const std::string& file) {
  const ASN1_TIME* from = X509_get0_notBefore(certificate);
  const ASN1_TIME* until = X509_get0_notAfter(certificate);
  if (X509_cmp_current_time(until) < 0) {
    throw ConfigError(file + ": the certificate expired on " + textOf(until) + "; create or request a new one");
  }
  if (X509_cmp_current_time(from) > 0) {
    throw ConfigError(file + ": the certificate is not valid before " + textOf(from) +
                      "; is this machine's clock right?");
  }
}

/// Minimum security bits of keys and signatures (NIST SP 800-57: until 2030 and beyond): RSA of 2,048 bits, curves of
/// 224 bits, SHA-2. Peers require the same by OpenSSL's default security level.
constexpr int kMinSecurityBits = 112;

void checkKeyStrength(X509* certificate, const std::string& file) {
  const EVP_PKEY* key = X509_get0_pubkey(certificate);
  if (key && EVP_PKEY_security_bits(key) >= kMinSecurityBits) return;
  throw ConfigError(file + ": the certificate's key is too weak: " + std::to_string(key ? EVP_PKEY_bits(key) : 0) +
                    " bits, which others refuse; create one with RSA of 2048 bits or more, or the curve P-256");
}

/// OpenSSL rates SHA-1 and MD5 at fewer security bits than half of their length, because collisions are known.
void checkSignature(X509* certificate, const std::string& file) {
  int digest = NID_undef;
  int key_type = NID_undef;
  int bits = 0;
  std::uint32_t flags = 0;
  const bool is_known = X509_get_signature_info(certificate, &digest, &key_type, &bits, &flags) == 1;
  if (is_known && bits >= kMinSecurityBits) return;
  const char* name = OBJ_nid2ln(X509_get_signature_nid(certificate));
  throw ConfigError(file + ": the certificate is signed with " + (name ? name : "an unknown algorithm") +
                    ", which is too weak and which others refuse; have it signed with SHA-256 or better");
}

/// OpenSSL's reason for refusing the certificate and the key; empty for none.
std::string refusalOfOpenSsl(X509* certificate, EVP_PKEY* key) {
  const Owned<SSL_CTX> context(SSL_CTX_new(TLS_server_method()));
  if (SSL_CTX_use_certificate(context.get(), certificate) == 1 && SSL_CTX_use_PrivateKey(context.get(), key) == 1) {
    return "";
  }
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return reason ? reason : "no reason given";
}

using Clock = std::chrono::steady_clock;

/// Waits until a connection can be read or written, or has failed. @return false when the time is over
bool waitFor(BIO* tcp, short what, Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  pollfd ready{static_cast<int>(BIO_get_fd(tcp, nullptr)), what, 0};
  return left.count() > 0 && poll(&ready, 1, static_cast<int>(left.count())) > 0;
}

void trust(SSL_CTX* context, const std::string& trusted_pem) {
  if (trusted_pem.empty()) {
    SSL_CTX_set_default_verify_paths(context);
    return;
  }
  const Owned<BIO> pem = makeBio(trusted_pem);
  while (const Owned<X509> certificate = nextCertificate(pem.get())) {
    X509_STORE_add_cert(SSL_CTX_get_cert_store(context), certificate.get());
  }
}

/// A connection, which does not block; null when there is none until this time.
Owned<BIO> connectTcp(const std::string& address, Clock::time_point until) {
  Owned<BIO> tcp(BIO_new_connect(address.c_str()));
  BIO_set_nbio(tcp.get(), 1);
  while (BIO_do_connect(tcp.get()) != 1) {
    const bool is_writable = BIO_should_retry(tcp.get()) != 0 && waitFor(tcp.get(), POLLOUT, until);
    ERR_clear_error();
    if (!is_writable) return nullptr;
  }
  return tcp;
}

}  // namespace

TlsIdentity TlsIdentity::read(const std::filesystem::path& certificate_file, const std::filesystem::path& key_file) {
  TlsIdentity identity{readSmallFile(certificate_file, "the certificate"),
                       readPrivateFile(key_file, "the private key")};
  const Owned<BIO> chain = makeBio(identity.certificate_pem);
  const Owned<X509> certificate = nextCertificate(chain.get());
  if (!certificate) {
    throw ConfigError(certificate_file.string() + ": has no certificate; it begins with -----BEGIN CERTIFICATE-----");
  }
  const Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(makeBio(identity.key_pem).get(), nullptr, noPassphrase, nullptr));
  ERR_clear_error();
  if (!key) {
    throw ConfigError(key_file.string() +
                      ": has no private key that can be read without a passphrase; 'openssl pkey' removes it");
  }
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    ERR_clear_error();
    throw ConfigError(key_file.string() + ": is not the key of the certificate in " + certificate_file.string() +
                      "; name two files that belong together");
  }
  const std::string file = certificate_file.string();
  checkDates(certificate.get(), file);
  checkKeyStrength(certificate.get(), file);
  checkSignature(certificate.get(), file);
  while (const Owned<X509> signer = nextCertificate(chain.get())) {
    checkDates(signer.get(), file);
    checkKeyStrength(signer.get(), file);
    const bool is_root =
        X509_check_issued(signer.get(), signer.get()) == X509_V_OK;  // the signature of a root is not checked
    if (!is_root) checkSignature(signer.get(), file);
  }
  const std::string refusal = refusalOfOpenSsl(certificate.get(), key.get());
  if (!refusal.empty()) throw ConfigError(file + ": OpenSSL cannot use the certificate: " + refusal);
  return identity;
}

std::shared_ptr<grpc::ServerCredentials> TlsIdentity::credentials() const {
  grpc::SslServerCredentialsOptions options;
  options.pem_key_cert_pairs.push_back({key_pem, certificate_pem});
  return grpc::SslServerCredentials(options);
}

TlsServer::TlsServer(const TlsIdentity& identity) {
  Owned<SSL_CTX> context(SSL_CTX_new(TLS_server_method()));
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(context.get(), "ECDHE+AESGCM:ECDHE+CHACHA20");
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(),
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_RELEASE_BUFFERS);
  const auto selectHttp2 = [](SSL*, const unsigned char** out, unsigned char* out_size, const unsigned char* in,
                              unsigned in_size, void*) {
    static constexpr unsigned char kHttp2[] = "\x02h2";
    unsigned char* selected = nullptr;
    const int found = SSL_select_next_proto(&selected, out_size, kHttp2, sizeof(kHttp2) - 1, in, in_size);
    *out = selected;
    return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_ALERT_FATAL;
  };
  SSL_CTX_set_alpn_select_cb(context.get(), selectHttp2, nullptr);
  const Owned<BIO> chain = makeBio(identity.certificate_pem), key_pem = makeBio(identity.key_pem);
  const Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(key_pem.get(), nullptr, noPassphrase, nullptr));
  const Owned<X509> leaf = nextCertificate(chain.get());
  if (!key || !leaf || SSL_CTX_use_certificate(context.get(), leaf.get()) != 1 ||
      SSL_CTX_use_PrivateKey(context.get(), key.get()) != 1) {
    ERR_clear_error();
    throw std::runtime_error("OpenSSL refuses the certificate or its key; create new ones, as doc/security.md shows");
  }
  while (const Owned<X509> issuer = nextCertificate(chain.get())) SSL_CTX_add1_chain_cert(context.get(), issuer.get());
  context_ = context.release();
}
TlsServer::~TlsServer() { SSL_CTX_free(context_); }

TlsServer::Connection::Connection(const TlsServer& server, int socket) : ssl_(SSL_new(server.context_)) {
  if (!ssl_) throw std::bad_alloc();
  SSL_set_fd(ssl_, socket);
  SSL_set_accept_state(ssl_);
  SSL_clear_mode(ssl_, SSL_MODE_AUTO_RETRY);
}
TlsServer::Connection::~Connection() { SSL_free(ssl_); }

int TlsServer::Connection::read(std::span<char> into) {
  const SigpipeBlock block;
  return judge(SSL_read(ssl_, into.data(), static_cast<int>(into.size())));
}
int TlsServer::Connection::write(std::string_view bytes) {
  const SigpipeBlock block;
  return bytes.empty() ? 0 : judge(SSL_write(ssl_, bytes.data(), static_cast<int>(bytes.size())));
}

int TlsServer::Connection::judge(int done) const {
  if (done > 0) return done;
  const int error = SSL_get_error(ssl_, done);
  ERR_clear_error();  // the queue of this thread, which OpenSSL consults next time
  return error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE ? 0 : -1;
}

void TlsServer::Connection::continueAfterControlRecords() { SSL_set_mode(ssl_, SSL_MODE_AUTO_RETRY); }

bool TlsServer::Connection::isEstablished() const { return SSL_is_init_finished(ssl_) == 1; }

void TlsServer::Connection::close() {
  const SigpipeBlock block;
  SSL_shutdown(ssl_);
  ERR_clear_error();
}

std::string readTrustedCertificates(const std::filesystem::path& file) {
  std::string pem = readSmallFile(file, "the trusted certificate");
  if (!nextCertificate(makeBio(pem).get())) {
    throw ConfigError(file.string() + ": has no certificate; it begins with -----BEGIN CERTIFICATE-----");
  }
  return pem;
}

bool isListening(const std::string& address, std::chrono::milliseconds limit) {
  return connectTcp(address, Clock::now() + limit) != nullptr;
}

std::string diagnoseTls(const std::string& address, const std::string& trusted_pem, std::chrono::milliseconds limit) {
  const SigpipeBlock block;
  const auto until = Clock::now() + limit;
  const Owned<BIO> tcp = connectTcp(address, until);
  if (!tcp) return "";
  const Owned<SSL_CTX> context(SSL_CTX_new(TLS_client_method()));
  trust(context.get(), trusted_pem);
  const Owned<SSL> ssl(SSL_new(context.get()));
  const std::string host = HostPort::of(address).host;
  if (X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(ssl.get()), host.c_str()) != 1) {
    SSL_set1_host(ssl.get(), host.c_str());
    SSL_set_tlsext_host_name(ssl.get(), host.c_str());
  }
  SSL_set_verify(ssl.get(), SSL_VERIFY_NONE, nullptr);  // completes the handshake; the result is queried afterwards
  BIO_up_ref(tcp.get());
  SSL_set_bio(ssl.get(), tcp.get(), tcp.get());
  int done = 0;
  while ((done = SSL_connect(ssl.get())) != 1) {
    const int needed = SSL_get_error(ssl.get(), done);
    if (needed != SSL_ERROR_WANT_READ && needed != SSL_ERROR_WANT_WRITE) break;
    if (!waitFor(tcp.get(), needed == SSL_ERROR_WANT_READ ? POLLIN : POLLOUT, until)) {
      ERR_clear_error();
      return "the server has not responded within " + std::to_string(limit.count()) + " ms";
    }
  }
  const bool is_tls = done == 1;
  const long found = SSL_get_verify_result(ssl.get());
  ERR_clear_error();
  if (!is_tls) return "the server does not use TLS";
  return found == X509_V_OK ? "" : X509_verify_cert_error_string(found);
}

}  // namespace robosim
