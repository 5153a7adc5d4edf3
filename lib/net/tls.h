#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <grpcpp/grpcpp.h>

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
