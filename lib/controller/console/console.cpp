#include "console/console.h"

#include <ctime>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include "base/atomic_file.h"
#include "base/input_file.h"
#include "base/log_limiter.h"
#include "console/console_session.h"
#include "console/page.h"
#include "net/audit.h"
#include "web/server.h"

namespace robosim {
namespace {

WebServer::Options serverOptions(const Console::Options& options) {
  WebServer::Options server;
  server.listen = options.listen;
  server.tls = options.tls;
  server.files = pageFiles();
  server.protocols = {kPageProtocol};
  server.log = options.log;
  return server;
}

RemoteControl::Options controlOptions(const Console::Options& options, WebServer& server) {
  RemoteControl::Options control = options.control;
  control.on_news = [&server] { server.requestTick(); };
  return control;
}

/// The results stored by an earlier console; none without a file.
BestOfDay readResults(const std::string& name) {
  if (name.empty()) return {};
  checkWritable(name);
  if (std::error_code error; !std::filesystem::exists(name, error)) return {};
  constexpr std::size_t kMaxBytes = 1 << 20;
  return BestOfDay::parse(readWholeFile(name, kMaxBytes, "is it a file of --results?"), name);
}

/// The local date, such as "2026-11-28".
std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[16] = "";
  std::strftime(text, sizeof text, "%Y-%m-%d", &local);
  return text;
}

}  // namespace

/// Adapter of ConsoleSession: passes it the events of the web server with the time, and performs its actions.
struct Console::Impl {
  Impl(const Options& the_options, const std::vector<RobotAddress>& team)
      : options(the_options),
        session(options.access, options.rounds, readResults(options.results)),
        server(serverOptions(options), events()),
        control(team, controlOptions(options, server)) {
    perform(update());
  }

  WebPageEvents events() {
    return {
        .opened = [this](PageId page,
                         const WebOpening& opening) { perform(session.pageOpened(page, opening.peer, now())); },
        .received = [this](PageId page, std::string_view text) { perform(session.pageMessage(page, text, now())); },
        .received_invalid = [this](PageId page, const std::string& why) { perform(session.pageInvalid(page, why)); },
        .closed = [this](PageId page) { perform(session.pageClosed(page)); },
        .next = [this](PageId page) { return session.nextMessage(page, now()); },
        .tick = [this] { tick(); }};
  }
  void tick() {
    limited_log.reportSuppressed();
    audit.reportSuppressed();
    control.tick();
    perform(update());
  }

  /// @name Actions. @return whether the team has changed
  ///@{
  bool operator()(const WakePage& action) {
    server.wake(action.page);
    return false;
  }
  bool operator()(const DisconnectPage& action) {
    server.disconnect(action.page, action.why);
    return false;
  }
  bool operator()(const SendOrder& action) {
    control.send(action.order);
    return action.order.has_set_mode();
  }
  bool operator()(const SetDriver& action) {
    control.setDriver(action.name);
    return true;
  }
  bool operator()(const SwitchPrimary& action) {
    control.switchTo(action.robot);
    return true;
  }
  bool operator()(const RestartRun& action) {
    if (options.run) options.run->restart(action.paused);
    return false;
  }
  bool operator()(const ResumeRun&) {
    if (options.run) options.run->resume();
    return false;
  }
  bool operator()(const SaveResults& action) {
    if (!options.results.empty()) save(action.text);
    return false;
  }
  bool operator()(const RecordRun& action) {
    if (options.run) options.run->setRecording(action.on);
    return false;
  }
  bool operator()(const WatchMap& action) {
    is_map_watched = action.watched;
    if (options.map) options.map->setWatched(action.watched);
    return false;
  }
  bool operator()(const WriteLog& action) {
    write(action.kind, action.line);
    return false;
  }
  bool operator()(const WriteAudit& action) {
    audit.write(action.client, action.peer, action.action);
    return false;
  }
  ///@}

  void perform(const ConsoleActions& actions) {
    bool has_changed = false;
    for (const auto& action : actions) has_changed |= std::visit(*this, action);
    if (has_changed) perform(update());
  }

  ConsoleActions update() {
    ConsoleSession::Inputs inputs;
    inputs.robots = control.robots();
    if (options.map && is_map_watched) inputs.map = options.map->newest();
    if (options.run) inputs.run = options.run->newest();
    inputs.access_version = options.access.refresh();
    inputs.today = today();
    return session.update(inputs, now());
  }

  /// The visitors play on when it fails, for example because the disk is full.
  void save(const std::string& text) {
    try {
      AtomicFile file(options.results);
      file.write(text);
      file.finish();
      file.commit();
    } catch (const std::exception& error) {
      write("results", std::string("the results of the day are not stored: ") + error.what());
    }
  }

  void write(std::string_view kind, const std::string& line) {
    if (kind.empty()) {
      options.log(line);
    } else {
      limited_log.write(kind, line);
    }
  }

  RemoteControl::Clock::time_point now() const { return options.control.now(); }

  Options options;
  LogLimiter limited_log{options.log, [this] { return now(); }};  ///< for events that any client can cause
  AuditLog audit{options.log, [this] { return now(); }};
  ConsoleSession session;
  bool is_map_watched = false;
  WebServer server;
  RemoteControl control;
};

Console::Console(const Options& options, const std::vector<RobotAddress>& team)
    : impl_(std::make_unique<Impl>(options, team)) {}
Console::~Console() = default;
int Console::port() const { return impl_->server.port(); }
void Console::serve(const std::function<bool()>& interrupted) { impl_->server.serve(interrupted); }

}  // namespace robosim
