#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <grpcpp/grpcpp.h>

struct ssl_ctx_st;
struct ssl_st;

namespace robosim {

/// The environment's certificate and its private key, as PEM text.
struct TlsIdentity {
  std::string certificate_pem;  ///< followed by the chain of its issuers, if any
  std::string key_pem;

  /// @throws ConfigError when a file cannot be read or is not PEM, the key can be read by others than its owner or
  /// belongs to another certificate, the certificate has expired or is not valid yet, or its key or signature is too
  /// weak for OpenSSL's default security level (RSA of less than 2,048 bits, SHA-1). A failure to listen therefore has
  /// other causes.
  static TlsIdentity read(const std::filesystem::path& certificate_file, const std::filesystem::path& key_file);

  std::shared_ptr<grpc::ServerCredentials> credentials() const;
};

/// Server's ends of TLS connections that gRPC does not handle itself, with the versions and ciphers of gRPC's.
class TlsServer {
 public:
  explicit TlsServer(const TlsIdentity& identity);
  ~TlsServer();
  TlsServer(const TlsServer&) = delete;
  TlsServer& operator=(const TlsServer&) = delete;

  /// One connection over a non-blocking socket, which the caller closes.
  class Connection {
   public:
    Connection(const TlsServer& server, int socket);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Continues the handshake, then reads or writes without waiting.
    /// @return number of bytes; 0 when it would wait, or has read a record without data, such as an update of the keys;
    /// -1 when the connection has ended
    int read(std::span<char> into);
    int write(std::string_view bytes);
    /// From now on, a read continues after records without data, until it would wait, which edge-triggered events
    /// require. Before, a client that sends nothing else does not hold the thread.
    void continueAfterControlRecords();
    /// Whether the handshake is complete.
    bool isEstablished() const;
    void close();  ///< sends the close notification

   private:
    int judge(int done) const;
    ssl_st* ssl_;
  };

 private:
  ssl_ctx_st* context_;
};

/// Reads the certificates that a client trusts: an authority's, or the environment's own.
/// @throws ConfigError when the file cannot be read or has no certificate.
std::string readTrustedCertificates(const std::filesystem::path& file);

/// Whether a server accepts a TCP connection. @param limit of the attempt, without the resolution of the host name
bool isListening(const std::string& address, std::chrono::milliseconds limit);

/// Determines why a TLS handshake with the server at `address` fails: an expired certificate, an issuer that is not
/// trusted, or another host name. gRPC only reports the failure.
/// @param trusted_pem as returned by readTrustedCertificates(); empty for the system's authorities
/// @param limit total time limit, without the resolution of the host name
/// @return empty when the handshake succeeds, or when the cause was not found within the limit
std::string diagnoseTls(const std::string& address, const std::string& trusted_pem, std::chrono::milliseconds limit);

}  // namespace robosim
