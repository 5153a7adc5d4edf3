// TLS, tokens and connection errors: each error states the problem, its location and how to fix it.
#include <csignal>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/scenarios/certificates.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

std::filesystem::path privateFile(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  return file;
}

void expectErrorText(const std::string& arguments, int exit_code, const std::vector<std::string>& words) {
  const Ended ended = runProgram(arguments);
  EXPECT_EQ(ended.exit_code, exit_code) << arguments;
  for (const auto& word : words) EXPECT_NE(ended.err.find(word), std::string::npos) << arguments << "\n" << ended.err;
}

constexpr int kBad = 1, kFailed = 2;
const char* const kViewer = "viewer-0123456789abcdef";
const char* const kPioneer = "robots-0123456789abcdef";
const char* const kOperator = "master-0123456789abcdef";

TEST(Security, RefusesUnprotectedListeningOnOtherInterfaces) {
  const auto folder = certificates();
  const auto tokens = privateFile(folder / "tokens", std::string(kOperator) + " operator\n");
  const std::string serve = "serve worlds/small_maze.xml --listen 0.0.0.0:0 ";
  const std::string tls =
      "--tls-cert " + (folder / "cert.pem").string() + " --tls-key " + (folder / "key.pem").string();
  expectErrorText(
      serve, kBad,
      {"--listen 0.0.0.0:0 is open to other machines: add --tls-cert", "and --tokens", "--listen-unprotected"});
  expectErrorText(serve + tls, kBad, {"add --tokens FILE", "--listen-unprotected"});
  expectErrorText(serve + "--tokens " + tokens.string(), kBad, {"add --tls-cert FILE and --tls-key FILE"});
  expectErrorText("serve worlds/small_maze.xml --listen robots=0.0.0.0:0", kBad, {"--listen 0.0.0.0:0"});
}

TEST(Security, ListensOnOtherInterfacesWithProtectionOrExplicitOverride) {
  const auto folder = certificates();
  const auto tokens = privateFile(folder / "tokens", std::string(kOperator) + " operator\n");
  for (const auto& options : {std::vector<std::string>{"--listen-unprotected"},
                              std::vector<std::string>{"--tls-cert", folder / "cert.pem", "--tls-key",
                                                       folder / "key.pem", "--tokens", tokens}}) {
    std::vector<std::string> words{"serve", "worlds/small_maze.xml", "--listen", "0.0.0.0:0", "--paused"};
    words.insert(words.end(), options.begin(), options.end());
    StartedProgram program(words);
    program.waitForError("listening on 0.0.0.0:");
    program.interrupt();
    EXPECT_EQ(program.wait().exit_code, 0);
  }
}

TEST(Security, ConnectsOverTlsToClientsThatTrustItsCertificate) {
  const auto folder = certificates();
  const std::string cert = folder / "cert.pem";
  Serving serving({"--tls-cert", cert, "--tls-key", folder / "key.pem", "--wait-for-robots", "--time", "5"});
  const std::string status = "control " + serving.address() + " status ";
  EXPECT_EQ(runProgram(status + "--tls-ca " + cert).exit_code, 0);
  const auto port = serving.address().substr(serving.address().rfind(':'));
  EXPECT_EQ(runProgram("control localhost" + port + " status --tls-ca " + cert).exit_code, 0);
  expectErrorText(status, kFailed, {serving.address(), "if it is started with --tls-cert, add --tls-ca"});
  expectErrorText(status + "--tls-ca " + (folder / "other.pem").string(), kFailed,
                  {"no TLS with the environment at " + serving.address(), "self-signed certificate"});
  StartedProgram elsewhere({"serve", "worlds/small_maze.xml", "--paused", "--listen", "127.0.0.2" + port, "--tls-cert",
                            cert, "--tls-key", folder / "key.pem"});
  elsewhere.waitForError("listening on");
  expectErrorText("control 127.0.0.2" + port + " status --tls-ca " + cert, kFailed, {"IP address mismatch"});

  const Ended robots =
      runProgram("robot Pioneer1 Scout1 --controller still --environment " + serving.address() + " --tls-ca " + cert);
  EXPECT_EQ(robots.exit_code, 0) << robots.err;
  EXPECT_EQ(serving.program().wait().exit_code, 0);
}

TEST(Security, ReportsAServerWithoutTls) {
  const auto folder = certificates();
  Serving serving({"--paused"});
  expectErrorText("control " + serving.address() + " status --tls-ca " + (folder / "cert.pem").string(), kFailed,
                  {"does not use TLS"});
}

TEST(Security, ReportsAnExpiredCertificate) {
  const auto folder = certificates();
  expectErrorText("serve worlds/small_maze.xml --tls-cert " + (folder / "old.pem").string() + " --tls-key " +
                      (folder / "key.pem").string(),
                  kBad, {"old.pem: the certificate expired on ", "new one"});
  // An environment may outlive its certificate; simulated by another server here.
  StartedProgram server("/usr/bin/openssl", {"s_server", "-www", "-accept", "127.0.0.1:0", "-alpn", "h2", "-cert",
                                             folder / "old.pem", "-key", folder / "key.pem"});
  server.waitForOutput("ACCEPT 127.0.0.1:");
  const std::string text = server.output();
  const auto at = text.find("127.0.0.1:");
  expectErrorText(
      "control " + text.substr(at, text.find('\n', at) - at) + " status --tls-ca " + (folder / "old.pem").string(),
      kFailed, {"no TLS with the environment at 127.0.0.1:", "certificate has expired"});
}

TEST(Security, RejectsWeakAndUnusableCertificatesForEveryListener) {
  const auto folder = certificates();
  const std::string name = " -nodes -subj /CN=localhost";
  const std::string script =
      "cd '" + folder.string() + "' && ( openssl req -x509 -newkey rsa:1024 -days 30" + name +
      " -keyout short_key.pem -out short.pem && openssl req -x509 -newkey rsa:2048 -sha1 -days 30" + name +
      " -keyout sha1_key.pem -out sha1.pem && cat cert.pem short.pem >chain.pem" + " ) 2>openssl.log";
  ASSERT_EQ(std::system(script.c_str()), 0) << textOf(folder / "openssl.log");
  const auto tokens = privateFile(folder / "tokens", std::string(kOperator) + " operator\n");
  std::ofstream(folder / "team.xml") << "<RobotInfo><robot><hostname>127.0.0.1</hostname><port>9</port><name>A</name>"
                                        "<primary>1</primary></robot></RobotInfo>";
  for (const std::string& listener : {std::string("serve worlds/small_maze.xml --listen 127.0.0.1:0"),
                                      "remote '" + (folder / "team.xml").string() + "' --listen 127.0.0.1:0"}) {
    const auto with = [&](const std::string& cert, const std::string& key) {
      return listener + " --tokens '" + tokens.string() + "' --tls-cert '" + (folder / cert).string() +
             "' --tls-key '" + (folder / key).string() + "'";
    };
    expectErrorText(with("short.pem", "short_key.pem"), kBad,
                    {"short.pem: the certificate's key is too weak: 1024 bits", "2048"});
    expectErrorText(with("sha1.pem", "sha1_key.pem"), kBad,
                    {"sha1.pem: the certificate is signed with sha1WithRSAEncryption", "SHA-256"});
    expectErrorText(with("chain.pem", "key.pem"), kBad, {"chain.pem: the certificate's key is too weak: 1024 bits"});
    expectErrorText(with("old.pem", "key.pem"), kBad, {"old.pem: the certificate expired on "});
    expectErrorText(with("cert.pem", "other_key.pem"), kBad, {"other_key.pem: is not the key of the certificate in"});
  }
}

TEST(Security, RejectsMismatchedCertificateAndKey) {
  const auto folder = certificates();
  const auto serve = [&](const std::string& cert, const std::string& key) {
    return "serve worlds/small_maze.xml --tls-cert '" + (folder / cert).string() + "' --tls-key '" +
           (folder / key).string() + "'";
  };
  expectErrorText(serve("cert.pem", "other_key.pem"), kBad, {"other_key.pem: is not the key of the certificate in"});
  expectErrorText(serve("none.pem", "key.pem"), kBad, {"none.pem: the certificate cannot be read"});
  expectErrorText(serve("key.pem", "key.pem"), kBad, {"key.pem: has no certificate"});
  std::filesystem::permissions(folder / "key.pem", std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  expectErrorText(serve("cert.pem", "key.pem"), kBad, {"key.pem: the private key is open to others", "chmod 600"});
  expectErrorText("serve worlds/small_maze.xml --tls-cert x", kBad,
                  {"--tls-cert and --tls-key must be given together"});
  expectErrorText("control status --tls-ca LICENSE", kBad, {"LICENSE: has no certificate"});
}

TEST(Security, LimitsEachTokenToItsRoleAndNeverPrintsIt) {
  const auto folder = emptyFolder();
  const auto tokens = privateFile(folder / "tokens", std::string(kViewer) + " viewer\n" + kPioneer +
                                                         " robot Pioneer1\n" + kOperator + " operator\n");
  const auto with = [&](const std::string& token) {
    return " --token-file '" + privateFile(folder / ("of_" + token.substr(0, 6)), token + "\n").string() + "'";
  };
  Serving serving({"--tokens", tokens, "--wait-for-robots", "--time", "2"});
  const std::string control = "control " + serving.address() + " ";
  const std::string at = " --controller still --environment " + serving.address();

  expectErrorText(control + "status", kFailed,
                  {serving.address(), "requires a token", "--token-file", "ROBOSIM_TOKEN"});
  expectErrorText(control + "status" + with("wrong-0123456789abcdef"), kFailed, {"the token is unknown"});
  expectErrorText(control + "status" + with(kPioneer), kFailed, {"the token has the role robot"});
  EXPECT_EQ(runProgram(control + "status" + with(kViewer)).exit_code, 0);
  expectErrorText(control + "stop" + with(kViewer), kFailed, {"the token has the role viewer"});
  EXPECT_EQ(runProgram(control + "pause" + with(kOperator)).exit_code, 0);
  EXPECT_EQ(runProgram(control + "start" + with(kOperator)).exit_code, 0);
  const std::string geometry = "geometry --environment " + serving.address();
  expectErrorText(geometry + with(kViewer), kFailed, {"the token has the role viewer"});
  expectErrorText(geometry + with(kOperator), kFailed, {"use one of the role geometry"});
  expectErrorText("robot Pioneer1" + at + with(kViewer), kFailed, {"the token has the role viewer"});
  expectErrorText("robot Scout1" + at + with(kPioneer), kFailed, {"not for robot 'Scout1' but for Pioneer1"});

  StartedProgram pioneer({"robot", "Pioneer1", "--controller", "still", "--environment", serving.address(),
                          "--token-file", (folder / "of_robots").string()});
  setenv("ROBOSIM_TOKEN", kOperator, 1);
  const Ended scout = runProgram("robot Scout1" + at);
  unsetenv("ROBOSIM_TOKEN");
  EXPECT_EQ(scout.exit_code, 0) << scout.err;
  EXPECT_EQ(pioneer.wait().exit_code, 0);
  const Ended served = serving.program().wait();
  EXPECT_EQ(served.exit_code, 0);
  EXPECT_EQ((served.out + served.err).find("0123456789abcdef"), std::string::npos) << "no token is ever printed";
}

TEST(Security, SendsNoTokenUnencryptedToAnotherMachine) {
  setenv("ROBOSIM_TOKEN", kOperator, 1);
  expectErrorText("control 192.0.2.1:3000 status", kBad, {"unencrypted; add", "--tls-ca", "--send-token-unencrypted"});
  unsetenv("ROBOSIM_TOKEN");
}

TEST(Security, SeparatesTheFlagsForTheClientsTokenAndForTheListeningPort) {
  setenv("ROBOSIM_TOKEN", kOperator, 1);
  expectErrorText("robot Pioneer1 --environment 192.0.2.1:3000 --remote-port 0 --listen-unprotected", kBad,
                  {"unencrypted; add", "--send-token-unencrypted"});
  expectErrorText(
      "remote worlds/teams/small_maze.xml --listen 127.0.0.1:0 --environment 192.0.2.1:3000 "
      "--send-token-unencrypted --tls-cert x",
      kBad, {"--tls-cert and --tls-key must be given together"});
  unsetenv("ROBOSIM_TOKEN");
  for (const std::string command :
       {"remote worlds/teams/small_maze.xml --listen 0.0.0.0:0", "robot Pioneer1 --remote-port 0.0.0.0:0"}) {
    expectErrorText(command + " --send-token-unencrypted", kBad, {"is open to other machines", "--listen-unprotected"});
  }
  for (const std::string command :
       {"serve worlds/small_maze.xml", "robot Pioneer1", "remote worlds/teams/small_maze.xml", "geometry",
        "control status", "view 127.0.0.1:3000"}) {
    expectErrorText(command + " --insecure", kBad,
                    {"--insecure is now two options: --send-token-unencrypted", "--listen-unprotected"});
  }
}

TEST(Mistakes, ReportAPortInUse) {
  Serving serving({"--paused"});
  expectErrorText("serve worlds/small_maze.xml --listen " + serving.address(), kFailed,
                  {"cannot listen on " + serving.address(), "another program using the port", "--listen"});
}

TEST(Mistakes, ReportAnAddressWithoutAServer) {
  const std::string unused_address = "127.0.0.1:1";
  for (const std::string& call :
       {"control " + unused_address + " status", "control " + unused_address + " status --watch",
        "robot Pioneer1 --environment " + unused_address, "geometry --environment " + unused_address}) {
    expectErrorText(call + " --connect-timeout 0", kFailed,
                    {"no environment answers at 127.0.0.1:1", "is 'robosim serve' running"});
  }
  expectErrorText("control nonsense status", kBad, {"'nonsense' is no address", "127.0.0.1:3000"});
}

TEST(Mistakes, ReportAnUnknownRobot) {
  Serving serving({"--wait-for-robots"});
  expectErrorText("robot Bogus --environment " + serving.address(), kFailed,
                  {serving.address(), "has no robot 'Bogus'; it has Pioneer1, Scout1"});
}

TEST(Mistakes, ReportThePortOfAnotherService) {
  StartedProgram serve({"serve", "worlds/small_maze.xml", "--paused", "--listen",
                        "viewers=127.0.0.1:0,robots=127.0.0.2:0,geometry=127.0.0.3:0,control=127.0.0.4:0"});
  serve.waitForError("for control panels on 127.0.0.4:");
  const auto address = [&](const std::string& whose) {
    const std::string text = serve.error();
    const auto at = text.find("for " + whose + " on ") + std::string("for " + whose + " on ").size();
    return text.substr(at, text.find_first_of(",\n", at) - at);
  };
  EXPECT_EQ(runProgram("control " + address("control panels") + " status").exit_code, 0);
  expectErrorText("control " + address("robots") + " status", kFailed, {"check the port"});
  expectErrorText("robot Pioneer1 --environment " + address("viewers"), kFailed, {"check the port"});
}

}  // namespace
}  // namespace robosim
