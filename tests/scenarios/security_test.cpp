// TLS, tokens, and the errors that a person meets on the way into an environment: each says what, where and the mend.
#include <csignal>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

/// A folder with cert.pem and key.pem for this machine's loopback, old.pem, which expired yesterday, and other.pem,
/// which is somebody else's.
std::filesystem::path certificates() {
  const auto folder = emptyFolder();
  const std::string about = "-subj /CN=localhost -addext subjectAltName=DNS:localhost,IP:127.0.0.1";
  const std::string make =
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 30 " + about;
  const std::string script = "cd '" + folder.string() + "' && ( " + make + " -keyout key.pem -out cert.pem && " + make +
                             " -keyout other_key.pem -out other.pem && openssl req -new -key key.pem " + about +
                             " -out request.pem && openssl x509 -req -in request.pem -signkey key.pem -days -1 "
                             "-copy_extensions copy -out old.pem ) 2>openssl.log";
  EXPECT_EQ(std::system(script.c_str()), 0) << textOf(folder / "openssl.log");
  return folder;
}

std::filesystem::path privateFile(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  return file;
}

void expectComplaint(const std::string& arguments, int exit_code, const std::vector<std::string>& words) {
  const Ended ended = runProgram(arguments);
  EXPECT_EQ(ended.exit_code, exit_code) << arguments;
  for (const auto& word : words) EXPECT_NE(ended.err.find(word), std::string::npos) << arguments << "\n" << ended.err;
}

constexpr int kBad = 1, kFailed = 2;
const char* const kViewer = "viewer-0123456789abcdef";
const char* const kPioneer = "robots-0123456789abcdef";
const char* const kOperator = "master-0123456789abcdef";

TEST(Security, RefusesToListenToOtherMachinesUnprotectedAndSaysWhatToAdd) {
  const auto folder = certificates();
  const auto tokens = privateFile(folder / "tokens", std::string(kOperator) + " operator\n");
  const std::string serve = "serve worlds/small_maze.xml --listen 0.0.0.0:0 ";
  const std::string tls =
      "--tls-cert " + (folder / "cert.pem").string() + " --tls-key " + (folder / "key.pem").string();
  expectComplaint(serve, kBad,
                  {"--listen 0.0.0.0:0 is open to other machines: add --tls-cert", "and --tokens", "--insecure"});
  expectComplaint(serve + tls, kBad, {"add --tokens FILE", "--insecure"});
  expectComplaint(serve + "--tokens " + tokens.string(), kBad, {"add --tls-cert FILE and --tls-key FILE"});
  expectComplaint("serve worlds/small_maze.xml --listen robots=0.0.0.0:0", kBad, {"--listen 0.0.0.0:0"});
}

TEST(Security, ListensToOtherMachinesWithTlsAndTokensOrWhenToldThatItIsInsecure) {
  const auto folder = certificates();
  const auto tokens = privateFile(folder / "tokens", std::string(kOperator) + " operator\n");
  for (const auto& options :
       {std::vector<std::string>{"--insecure"}, std::vector<std::string>{"--tls-cert", folder / "cert.pem", "--tls-key",
                                                                         folder / "key.pem", "--tokens", tokens}}) {
    std::vector<std::string> words{"serve", "worlds/small_maze.xml", "--listen", "0.0.0.0:0", "--paused"};
    words.insert(words.end(), options.begin(), options.end());
    StartedProgram program(words);
    program.waitForError("listening on 0.0.0.0:");
    program.interrupt();
    EXPECT_EQ(program.wait().exit_code, 0);
  }
}

TEST(Security, SpeaksTlsWithWhoTrustsItsCertificate) {
  const auto folder = certificates();
  const std::string cert = folder / "cert.pem";
  Serving serving({"--tls-cert", cert, "--tls-key", folder / "key.pem", "--wait-for-robots", "--time", "5"});
  const std::string status = "control " + serving.address() + " status ";
  EXPECT_EQ(runProgram(status + "--tls-ca " + cert).exit_code, 0);
  const auto port = serving.address().substr(serving.address().rfind(':'));
  EXPECT_EQ(runProgram("control localhost" + port + " status --tls-ca " + cert).exit_code, 0);
  expectComplaint(status, kFailed, {serving.address(), "if it is started with --tls-cert, add --tls-ca"});
  expectComplaint(status + "--tls-ca " + (folder / "other.pem").string(), kFailed,
                  {"no TLS with the environment at " + serving.address(), "self-signed certificate"});
  StartedProgram elsewhere({"serve", "worlds/small_maze.xml", "--paused", "--listen", "127.0.0.2" + port, "--tls-cert",
                            cert, "--tls-key", folder / "key.pem"});
  elsewhere.waitForError("listening on");
  expectComplaint("control 127.0.0.2" + port + " status --tls-ca " + cert, kFailed, {"IP address mismatch"});

  const Ended robots =
      runProgram("robot Pioneer1 Scout1 --controller still --environment " + serving.address() + " --tls-ca " + cert);
  EXPECT_EQ(robots.exit_code, 0) << robots.err;
  EXPECT_EQ(serving.program().wait().exit_code, 0);
}

TEST(Security, TellsAClientThatTheOtherEndSpeaksNoTls) {
  const auto folder = certificates();
  Serving serving({"--paused"});
  expectComplaint("control " + serving.address() + " status --tls-ca " + (folder / "cert.pem").string(), kFailed,
                  {"does not speak TLS"});
}

TEST(Security, TellsThatACertificateHasExpired) {
  const auto folder = certificates();
  expectComplaint("serve worlds/small_maze.xml --tls-cert " + (folder / "old.pem").string() + " --tls-key " +
                      (folder / "key.pem").string(),
                  kBad, {"old.pem: the certificate expired on ", "new one"});
  // An environment may outlive its certificate; another server stands in for that one.
  StartedProgram server("/usr/bin/openssl", {"s_server", "-www", "-accept", "127.0.0.1:0", "-alpn", "h2", "-cert",
                                             folder / "old.pem", "-key", folder / "key.pem"});
  server.waitForOutput("ACCEPT 127.0.0.1:");
  const std::string text = server.output();
  const auto at = text.find("127.0.0.1:");
  expectComplaint(
      "control " + text.substr(at, text.find('\n', at) - at) + " status --tls-ca " + (folder / "old.pem").string(),
      kFailed, {"no TLS with the environment at 127.0.0.1:", "certificate has expired"});
}

TEST(Security, RefusesFilesThatMakeNoIdentity) {
  const auto folder = certificates();
  const auto serve = [&](const std::string& cert, const std::string& key) {
    return "serve worlds/small_maze.xml --tls-cert '" + (folder / cert).string() + "' --tls-key '" +
           (folder / key).string() + "'";
  };
  expectComplaint(serve("cert.pem", "other_key.pem"), kBad, {"other_key.pem: is not the key of the certificate in"});
  expectComplaint(serve("none.pem", "key.pem"), kBad, {"none.pem: the certificate cannot be read"});
  expectComplaint(serve("key.pem", "key.pem"), kBad, {"key.pem: has no certificate"});
  std::filesystem::permissions(folder / "key.pem", std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  expectComplaint(serve("cert.pem", "key.pem"), kBad, {"key.pem: the private key is open to others", "chmod 600"});
  expectComplaint("serve worlds/small_maze.xml --tls-cert x", kBad, {"--tls-cert and --tls-key belong together"});
  expectComplaint("control status --tls-ca LICENSE", kBad, {"LICENSE: has no certificate"});
}

TEST(Security, LetsEachTokenDoWhatItsRoleMayAndNeverTellsIt) {
  const auto folder = emptyFolder();
  const auto tokens = privateFile(folder / "tokens", std::string(kViewer) + " viewer\n" + kPioneer +
                                                         " robot Pioneer1\n" + kOperator + " operator\n");
  const auto with = [&](const std::string& token) {
    return " --token-file '" + privateFile(folder / ("of_" + token.substr(0, 6)), token + "\n").string() + "'";
  };
  Serving serving({"--tokens", tokens, "--wait-for-robots", "--time", "2"});
  const std::string control = "control " + serving.address() + " ";
  const std::string at = " --controller still --environment " + serving.address();

  expectComplaint(control + "status", kFailed,
                  {serving.address(), "asks for a token", "--token-file", "ROBOSIM_TOKEN"});
  expectComplaint(control + "status" + with("wrong-0123456789abcdef"), kFailed,
                  {"the token is none of those known here"});
  expectComplaint(control + "status" + with(kPioneer), kFailed, {"the token is a robot's"});
  EXPECT_EQ(runProgram(control + "status" + with(kViewer)).exit_code, 0);
  expectComplaint(control + "stop" + with(kViewer), kFailed, {"the token is a viewer's"});
  EXPECT_EQ(runProgram(control + "pause" + with(kOperator)).exit_code, 0);
  EXPECT_EQ(runProgram(control + "start" + with(kOperator)).exit_code, 0);
  expectComplaint("geometry --environment " + serving.address() + with(kViewer), kFailed, {"the token is a viewer's"});
  expectComplaint("robot Pioneer1" + at + with(kViewer), kFailed, {"the token is a viewer's"});
  expectComplaint("robot Scout1" + at + with(kPioneer), kFailed, {"not for robot 'Scout1' but for Pioneer1"});

  StartedProgram pioneer({"robot", "Pioneer1", "--controller", "still", "--environment", serving.address(),
                          "--token-file", (folder / "of_robots").string()});
  setenv("ROBOSIM_TOKEN", kOperator, 1);
  const Ended scout = runProgram("robot Scout1" + at);
  unsetenv("ROBOSIM_TOKEN");
  EXPECT_EQ(scout.exit_code, 0) << scout.err;
  EXPECT_EQ(pioneer.wait().exit_code, 0);
  const Ended served = serving.program().wait();
  EXPECT_EQ(served.exit_code, 0);
  EXPECT_EQ((served.out + served.err).find("0123456789abcdef"), std::string::npos) << "no token is ever told";
}

TEST(Security, SendsNoTokenInTheClearToAnotherMachine) {
  setenv("ROBOSIM_TOKEN", kOperator, 1);
  expectComplaint("control 192.0.2.1:3000 status", kBad, {"for anyone on the way to read", "--tls-ca", "--insecure"});
  unsetenv("ROBOSIM_TOKEN");
}

TEST(Mistakes, OfOneWhoStartsTwoEnvironmentsOnOnePort) {
  Serving serving({"--paused"});
  expectComplaint("serve worlds/small_maze.xml --listen " + serving.address(), kFailed,
                  {"cannot listen on " + serving.address(), "another program using the port", "--listen"});
}

TEST(Mistakes, OfOneWhoCallsWhereNobodyListens) {
  const std::string nobody = "127.0.0.1:1";
  for (const std::string& call : {"control " + nobody + " status", "control " + nobody + " status --watch",
                                  "robot Pioneer1 --environment " + nobody, "geometry --environment " + nobody}) {
    expectComplaint(call, kFailed, {"no environment answers at 127.0.0.1:1", "is 'robosim serve' running"});
  }
  expectComplaint("control nonsense status", kBad, {"'nonsense' is no address", "127.0.0.1:3000"});
}

TEST(Mistakes, OfOneWhoNamesAnUnknownRobot) {
  Serving serving({"--wait-for-robots"});
  expectComplaint("robot Bogus --environment " + serving.address(), kFailed,
                  {serving.address(), "has no robot 'Bogus'; it has Pioneer1, Scout1"});
}

TEST(Mistakes, OfOneWhoListensOnPortsOfTheirOwnAndCallsTheWrongOne) {
  StartedProgram serve({"serve", "worlds/small_maze.xml", "--paused", "--listen",
                        "viewers=127.0.0.1:0,robots=127.0.0.2:0,geometry=127.0.0.3:0,control=127.0.0.4:0"});
  serve.waitForError("for control panels on 127.0.0.4:");
  const auto address = [&](const std::string& whose) {
    const std::string text = serve.error();
    const auto at = text.find("for " + whose + " on ") + std::string("for " + whose + " on ").size();
    return text.substr(at, text.find_first_of(",\n", at) - at);
  };
  EXPECT_EQ(runProgram("control " + address("control panels") + " status").exit_code, 0);
  expectComplaint("control " + address("robots") + " status", kFailed, {"is this the port for"});
  expectComplaint("robot Pioneer1 --environment " + address("viewers"), kFailed, {"is this the port for"});
}

}  // namespace
}  // namespace robosim
