#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// A certificate and its private key, as PEM text: who the environment is.
struct TlsIdentity {
  std::string certificate_pem;  ///< with the chain of those who signed it, if any
  std::string key_pem;

  /// @throws ConfigError when a file cannot be read, is no PEM, the key is open to others than its owner or belongs to
  /// another certificate, or the certificate has expired or is not valid yet.
  static TlsIdentity read(const std::filesystem::path& certificate_file, const std::filesystem::path& key_file);

  std::shared_ptr<grpc::ServerCredentials> credentials() const;
};

/// Reads the certificates that a client is to trust: an authority's, or the environment's own.
/// @throws ConfigError when the file cannot be read, or has no certificate.
std::string readTrustedCertificates(const std::filesystem::path& file);

/// Why a client would not talk TLS with whom it finds at `address`, in a few words: the certificate has expired, say,
/// is signed by nobody it trusts, or bears another name. gRPC alone tells no more than that it failed.
/// @param trusted_pem as readTrustedCertificates() has it; empty for the system's authorities
/// @return empty when there is nothing to say against it
std::string whyTlsFails(const std::string& address, const std::string& trusted_pem);

}  // namespace robosim
