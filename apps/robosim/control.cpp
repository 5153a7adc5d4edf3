#include <chrono>
#include <functional>
#include <iostream>
#include <thread>

#include "base/error_list.h"
#include "net/control_panel.grpc.pb.h"
#include "net/wire_error.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/run_outputs.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

struct Arguments {
  ConnectionArguments connection;
  std::string world;
  std::uint64_t steps = 1;
  std::string speed;
  bool watch = false;
  double period_s = 1;
};

const char* wordFor(wire::RunPhase phase) {
  switch (phase) {
    case wire::WAITING:
      return "waits for robots";
    case wire::PAUSED:
      return "paused";
    case wire::RUNNING:
      return "running";
    case wire::ENDED:
      return "ended";
    default:
      return "in a state that this program does not know";
  }
}

std::string lineOn(const wire::RunStatus& status) {
  return "step " + withCommas(status.step()) + " (" + fixed(status.time_s(), 1) + " s): " + wordFor(status.phase()) +
         ", " + withCommas(static_cast<std::uint64_t>(status.steps_per_s())) + " steps/s, " +
         withCommas(status.robots_active()) + " of " + withCommas(status.robots()) + " robots active";
}

std::string pageOn(const wire::RunStatus& status) {
  std::string robots = withCommas(status.robots()) + ", of which " + withCommas(status.robots_active()) +
                       " are active and " + withCommas(status.robots_connected()) + " in processes of their own";
  const std::vector<std::string> absent(status.robots_absent().begin(), status.robots_absent().end());
  const std::string speed =
      status.speed() == 0 ? "as fast as it can" : fixed(status.speed(), 3) + " simulated seconds a second";
  Rows rows{{"world", status.world() + ", version " + status.world_version()},
            {"run", std::string(wordFor(status.phase())) + " at step " + withCommas(status.step()) + ", " +
                        fixed(status.time_s(), 1) + " s"},
            {"speed", speed + "; lately " + withCommas(static_cast<std::uint64_t>(status.steps_per_s())) + " steps/s"},
            {"robots", robots}};
  if (!absent.empty()) rows.push_back({"absent", listed(absent)});
  if (!status.winner().empty()) rows.push_back({"winner", status.winner()});
  if (status.late() > 0) rows.push_back({"late", withCommas(status.late()) + " commands (robots × steps)"});
  rows.push_back({"viewers", withCommas(status.viewers())});
  rows.push_back({"geometry", withCommas(status.geometry_workers()) + " workers"});
  return listing(rows);
}

/// A panel's end of the connection: makes one call after the other.
class Panel {
 public:
  explicit Panel(DialOptions options)
      : options_(std::move(options)), stub_(wire::ControlPanel::NewStub(dial(options_))) {}

  /// Calls, say, &Stub::Start with a request. @throws ConnectionError
  template <typename Method, typename Request>
  wire::RunStatus call(Method method, Request request) {
    grpc::ClientContext context;
    showToken(context, options_);
    request.set_protocol(kProtocolVersion);
    wire::RunStatus status;
    check((stub_.get()->*method)(&context, request, &status));
    return status;
  }

  wire::RunStatus load(const WorldSource& source) {
    constexpr std::size_t piece_bytes = 1 << 20;
    wire::WorldSource message;
    encode(source, message);
    const std::string bytes = message.SerializeAsString();
    grpc::ClientContext context;
    showToken(context, options_);
    wire::RunStatus status;
    const auto writer = stub_->Load(&context, &status);
    wire::WorldPiece piece;
    piece.set_protocol(kProtocolVersion);
    for (std::size_t at = 0; at < bytes.size(); at += piece_bytes) {
      piece.set_piece(bytes.substr(at, piece_bytes));
      if (!writer->Write(piece)) break;  // Finish() says why
    }
    writer->WritesDone();
    check(writer->Finish());
    return status;
  }

  /// Calls `show` with a report again and again, until the run is over.
  void watch(std::chrono::duration<double> period, const std::function<void(const wire::RunStatus&)>& show) {
    grpc::ClientContext context;
    showToken(context, options_);
    const auto stream = stub_->Watch(&context);
    wire::PanelRequest request;
    request.set_protocol(kProtocolVersion);
    wire::RunStatus status;
    while (stream->Write(request) && stream->Read(&status)) {
      show(status);
      std::this_thread::sleep_for(period);
    }
    while (stream->Read(&status)) show(status);  // the last
    check(stream->Finish());
  }

 private:
  void check(const grpc::Status& status) const {
    if (!status.ok()) throw ConnectionError(status, options_);
  }

  DialOptions options_;
  std::unique_ptr<wire::ControlPanel::Stub> stub_;
};

void showLine(const wire::RunStatus& status) { std::cout << lineOn(status) << std::endl; }

void showStatus(const Arguments& a) {
  Panel panel(a.connection.dialOptions());
  if (a.watch) {
    panel.watch(std::chrono::duration<double>(a.period_s), showLine);
  } else {
    std::cout << pageOn(panel.call(&wire::ControlPanel::Stub::Status, wire::PanelRequest()));
  }
}

void step(const Arguments& a) {
  wire::StepRequest request;
  request.set_steps(a.steps);
  showLine(Panel(a.connection.dialOptions()).call(&wire::ControlPanel::Stub::Step, request));
}

void setSpeed(const Arguments& a) {
  RunArguments run;
  run.speed = a.speed;
  wire::SpeedRequest request;
  request.set_speed(run.speedNumber());
  showLine(Panel(a.connection.dialOptions()).call(&wire::ControlPanel::Stub::SetSpeed, request));
}

}  // namespace

void addControl(CLI::App& program) {
  auto* control = program.add_subcommand("control", "The control panel of an environment elsewhere");
  auto a = std::make_shared<Arguments>();
  control->add_option("ADDRESS", a->connection.environment, "where 'robosim serve' listens")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  addSecurityOptions(*control, a->connection);
  control->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, const std::function<void()>& act) {
    auto* command = control->add_subcommand(name, help);
    command->fallthrough();  // options of `control` may stand at the end too
    command->callback(act);
    return command;
  };
  const auto add_plain = [&](const char* name, const char* help, auto method) {
    add(name, help, [a, method] { showLine(Panel(a->connection.dialOptions()).call(method, wire::PanelRequest())); });
  };

  add("load", "end the run, and begin another with this world, paused",
      [a] { showLine(Panel(a->connection.dialOptions()).load(readWorldSource(a->world))); })
      ->add_option("FILE", a->world, "world file")
      ->required();
  add_plain("start", "let the run go on", &wire::ControlPanel::Stub::Start);
  add_plain("pause", "halt after the step that is being taken", &wire::ControlPanel::Stub::Pause);
  add("step", "take so many steps, then pause; returns when they are done", [a] { step(*a); })
      ->add_option("N", a->steps)
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str();
  add("speed", "simulated seconds per second: a number (1 is real time) or max", [a] { setSpeed(*a); })
      ->add_option("X", a->speed)
      ->type_name("X|max")
      ->required();
  add_plain("stop", "end the run, and the program that serves it", &wire::ControlPanel::Stub::Stop);
  auto* status = add("status", "how the run stands", [a] { showStatus(*a); });
  status->add_flag("--watch", a->watch, "keep printing, a line for each report, until the run is over");
  status->add_option("--every", a->period_s, "with --watch: how long from one report to the next")
      ->check(numberIn(0.01, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
}

}  // namespace robosim
