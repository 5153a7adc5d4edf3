#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/scenarios/program.h"

namespace robosim {

/// A folder with cert.pem and key.pem for loopback; old.pem, which has expired; and other.pem with a different
/// key.
inline std::filesystem::path certificates() {
  const auto folder = emptyFolder();
  const std::string about = "-subj /CN=localhost -addext subjectAltName=DNS:localhost,IP:127.0.0.1";
  const std::string make =
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 30 " + about;
  // `openssl ca` sets any dates; OpenSSL 3.5 refuses `x509 -days -1`.
  std::ofstream(folder / "ca.cnf") << "[ca]\ndefault_ca=own\n[own]\ndatabase=index.txt\nrand_serial=yes\n"
                                      "new_certs_dir=.\ndefault_md=sha256\ncopy_extensions=copy\npolicy=any\n"
                                      "[any]\ncommonName=supplied\n";
  std::ofstream(folder / "index.txt").close();
  const std::string script = "cd '" + folder.string() + "' && ( " + make + " -keyout key.pem -out cert.pem && " + make +
                             " -keyout other_key.pem -out other.pem && openssl req -new -key key.pem " + about +
                             " -out request.pem && openssl ca -batch -notext -config ca.cnf -selfsign -keyfile key.pem"
                             " -in request.pem -startdate 20240101000000Z -enddate 20240102000000Z -out old.pem"
                             " ) 2>openssl.log";
  EXPECT_EQ(std::system(script.c_str()), 0) << textOf(folder / "openssl.log");
  return folder;
}

}  // namespace robosim
