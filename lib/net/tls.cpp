#include "net/tls.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "base/error_list.h"
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

Owned<BIO> bioOf(const std::string& text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

/// A key that asks for a passphrase is refused instead of asking on the terminal.
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
    throw ConfigError(file + ": the certificate expired on " + textOf(until) + "; make or ask for a new one");
  }
  if (X509_cmp_current_time(from) > 0) {
    throw ConfigError(file + ": the certificate is not valid before " + textOf(from) +
                      "; is this machine's clock right?");
  }
}

/// The host of "host:port", without the brackets of an IPv6 address.
std::string hostOf(const std::string& address) {
  std::string host = address.substr(0, address.rfind(':'));
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return host;
}

void trust(SSL_CTX* context, const std::string& trusted_pem) {
  if (trusted_pem.empty()) {
    SSL_CTX_set_default_verify_paths(context);
    return;
  }
  const Owned<BIO> pem = bioOf(trusted_pem);
  while (const Owned<X509> certificate = nextCertificate(pem.get())) {
    X509_STORE_add_cert(SSL_CTX_get_cert_store(context), certificate.get());
  }
}

}  // namespace

TlsIdentity TlsIdentity::read(const std::filesystem::path& certificate_file, const std::filesystem::path& key_file) {
  TlsIdentity identity{readSmallFile(certificate_file, "the certificate"),
                       readPrivateFile(key_file, "the private key")};
  const Owned<X509> certificate = nextCertificate(bioOf(identity.certificate_pem).get());
  if (!certificate) {
    throw ConfigError(certificate_file.string() + ": has no certificate; it begins with -----BEGIN CERTIFICATE-----");
  }
  const Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(bioOf(identity.key_pem).get(), nullptr, noPassphrase, nullptr));
  ERR_clear_error();
  if (!key) {
    throw ConfigError(key_file.string() +
                      ": has no private key that can be read without a passphrase; 'openssl pkey' takes one off");
  }
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    ERR_clear_error();
    throw ConfigError(key_file.string() + ": is not the key of the certificate in " + certificate_file.string() +
                      "; name two files that belong together");
  }
  checkDates(certificate.get(), certificate_file.string());
  return identity;
}

std::shared_ptr<grpc::ServerCredentials> TlsIdentity::credentials() const {
  grpc::SslServerCredentialsOptions options;
  options.pem_key_cert_pairs.push_back({key_pem, certificate_pem});
  return grpc::SslServerCredentials(options);
}

std::string readTrustedCertificates(const std::filesystem::path& file) {
  std::string pem = readSmallFile(file, "the trusted certificate");
  if (!nextCertificate(bioOf(pem).get())) {
    throw ConfigError(file.string() + ": has no certificate; it begins with -----BEGIN CERTIFICATE-----");
  }
  return pem;
}

std::string whyTlsFails(const std::string& address, const std::string& trusted_pem) {
  const Owned<BIO> tcp(BIO_new_connect(address.c_str()));
  if (BIO_do_connect(tcp.get()) != 1) {
    ERR_clear_error();
    return "";
  }
  const timeval patience{.tv_sec = 5, .tv_usec = 0};
  setsockopt(static_cast<int>(BIO_get_fd(tcp.get(), nullptr)), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));

  const Owned<SSL_CTX> context(SSL_CTX_new(TLS_client_method()));
  trust(context.get(), trusted_pem);
  const Owned<SSL> ssl(SSL_new(context.get()));
  const std::string host = hostOf(address);
  if (X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(ssl.get()), host.c_str()) != 1) {
    SSL_set1_host(ssl.get(), host.c_str());
    SSL_set_tlsext_host_name(ssl.get(), host.c_str());
  }
  SSL_set_verify(ssl.get(), SSL_VERIFY_NONE, nullptr);  // it goes on whatever it finds, and is then asked for that
  BIO_up_ref(tcp.get());
  SSL_set_bio(ssl.get(), tcp.get(), tcp.get());
  const bool is_tls = SSL_connect(ssl.get()) == 1;
  const long found = SSL_get_verify_result(ssl.get());
  ERR_clear_error();
  if (!is_tls) return "whoever listens there does not speak TLS";
  return found == X509_V_OK ? "" : X509_verify_cert_error_string(found);
}

}  // namespace robosim
