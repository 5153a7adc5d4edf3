#include "serving/foxglove_serving.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "net/host_port.h"
#include "ros/cdr.h"

namespace robosim {
namespace {

using foxglove::StatusLevel;

constexpr const char* kPaused = "/run/paused";
constexpr const char* kSpeed = "/run/speed";
constexpr const char* kStepsLeft = "/run/steps_left";
constexpr const char* kRecording = "/run/recording";
constexpr const char* kWorld = "/run/world";
constexpr const char* kSeed = "/run/seed";
constexpr const char* kTime = "/run/time";
constexpr const char* kDuration = "/run/duration";

constexpr const char* kTrigger = "std_srvs/srv/Trigger";
constexpr const char* kTriggerResponse = "bool success\nstring message\n";
struct RunService {
  const char* name;
  const char* action;  ///< of the audit log, as of a control panel
  void (*execute)(RunControl&);
};
constexpr std::array kRunServices{
    RunService{"/run/start", "start", [](RunControl& control) { control.pause(false); }},
    RunService{"/run/pause", "pause", [](RunControl& control) { control.pause(true); }},
    RunService{"/run/step", "step 1", [](RunControl& control) { control.step(1); }},
};

constexpr const char* kMayNotOperate = "the token does not permit it; use one of the role operator";

/// Between two updates of the parameters, whose time is proportional to the number of robots.
constexpr std::chrono::milliseconds kParametersPause{50};

std::vector<foxglove::Service> services() {
  std::vector<foxglove::Service> all;
  for (const auto& service : kRunServices) all.push_back({service.name, kTrigger, "", kTriggerResponse});
  return all;
}

}  // namespace

std::string foxgloveAddress(const std::string& address) {
  const bool is_host =
      address.find(':') == std::string::npos && address.find_first_not_of("0123456789") != std::string::npos;
  return hostAndPort(is_host || address.ends_with(']') ? address + ":8765" : address);
}

std::string foxgloveLine(const foxglove::Server::Options& options, int port) {
  return "Foxglove: " + std::string(options.tls ? "wss" : "ws") + "://" + withPort(options.listen, port);
}

/// Passes the messages of topics to the hub, whose channels they are.
class FoxgloveServing::Outlet final : public TopicOutlet {
 public:
  explicit Outlet(foxglove::Hub& hub) : hub_(hub) {}

  bool wants(std::size_t topic, Audience audience) const override { return hub_.wants(topic, of(audience)); }
  bool isSubscribed(std::size_t topic) const override { return hub_.isSubscribed(topic); }
  bool hasFresh() const override { return hub_.hasFresh(); }
  void beginRound(std::uint64_t time_ns) override {
    hub_.beginRound();
    hub_.sendTime(time_ns);
  }
  void send(std::size_t topic, Audience audience, std::uint64_t time_ns, std::vector<std::uint8_t> message,
            bool latest_only) override {
    hub_.send(topic, of(audience), time_ns, std::make_shared<const std::vector<std::uint8_t>>(std::move(message)),
              latest_only);
  }
  void endRound() override { hub_.endRound(); }

 private:
  static foxglove::Hub::Audience of(Audience audience) {
    return audience == Audience::all ? foxglove::Hub::Audience::all : foxglove::Hub::Audience::fresh;
  }
  foxglove::Hub& hub_;
};

FoxgloveServing::FoxgloveServing(const FoxgloveOptions& options, RobotDrivers& drivers)
    : options_(options),
      drivers_(drivers),
      commands_(drivers),
      server_([&] {
        foxglove::Server::Options server = options.server;
        server.publications = &commands_;
        return server;
      }()),
      outlet_(std::make_unique<Outlet>(server_.hub())) {}

FoxgloveServing::~FoxgloveServing() = default;

void FoxgloveServing::begin(const FoxgloveRun& run) {
  run_.emplace(run);
  seek_s_.reset();
  playback_.reset();
  feed_.emplace(*outlet_, run.model, run.state, run.topics);
  std::vector<foxglove::Channel> channels;
  for (const auto& topic : feed_->topics()) {
    channels.push_back({topic.name, "cdr", topic.type->name, topic.type->definition(), "ros2msg"});
  }
  std::vector<std::string> capabilities{"time", "clientPublish", "parameters", "parametersSubscribe", "services"};
  std::optional<std::uint64_t> duration_ns;
  if (run.duration_s) {
    capabilities.emplace_back("playbackControl");
    duration_ns = nanosecondsOf(*run.duration_s);
  }
  server_.hub().offer(
      {{"RoboSim: " + run.model->world.name, std::move(capabilities), {"cdr", "json"}, run.id, duration_ns},
       std::move(channels),
       services()});
}

void FoxgloveServing::poll(RunControl& control, const FoxgloveRecording& recording) {
  foxglove::Hub& hub = server_.hub();
  if (const auto now = std::chrono::steady_clock::now(); now >= parameters_due_) {
    parameters_due_ = now + kParametersPause;
    hub.setParameters(parameters(control, recording));
    const foxglove::PlaybackState now_played = playback(control);
    if (run_->duration_s &&
        (!playback_ || playback_->status != now_played.status || playback_->speed != now_played.speed)) {
      playback_ = now_played;
      hub.setPlayback(now_played);
    }
  }
  for (const auto& request : hub.takeRequests()) {
    if (const auto* const of_parameters = std::get_if<foxglove::ParameterChange>(&request)) {
      change(*of_parameters, control, recording);
    } else if (const auto* const of_playback = std::get_if<foxglove::PlaybackRequest>(&request)) {
      play(*of_playback, control);
    } else {
      call(std::get<foxglove::ServiceRequest>(request), control);
    }
  }
  feed_->poll();
}

std::vector<foxglove::Parameter> FoxgloveServing::parameters(const RunControl& control,
                                                             const FoxgloveRecording& recording) const {
  std::vector<foxglove::Parameter> all{{kPaused, control.is_paused, ""},
                                       {kSpeed, control.speed, "float64"},
                                       {kStepsLeft, control.steps_left, ""},
                                       {kWorld, run_->model->world.name, ""}};
  if (run_->seed) all.push_back({kSeed, *run_->seed, ""});
  if (run_->duration_s) {
    all.push_back({kTime, run_->state.time.seconds(), "float64"});
    all.push_back({kDuration, *run_->duration_s, "float64"});
  }
  if (recording.is_possible) all.push_back({kRecording, recording.is_on, ""});
  for (const auto& [parameter, is_autonomous] : drivers_.autonomous()) all.push_back({parameter, is_autonomous, ""});
  return all;
}

void FoxgloveServing::change(const foxglove::ParameterChange& change, RunControl& control,
                             const FoxgloveRecording& recording) {
  foxglove::Hub& hub = server_.hub();
  for (const auto& parameter : change.parameters) {
    const std::string why = setParameter(change.client, parameter, control, recording);
    if (!why.empty()) hub.sendStatus(change.client.id, StatusLevel::error, parameter.name + ": " + why);
  }
  hub.setParameters(parameters(control, recording));
  hub.answer(change);
}

/// @return why not; empty when it is set
std::string FoxgloveServing::setParameter(const foxglove::Client& client, const foxglove::Parameter& parameter,
                                          RunControl& control, const FoxgloveRecording& recording) {
  foxglove::Hub& hub = server_.hub();
  const auto& [name, value, type] = parameter;
  if (drivers_.hasParameter(name)) {
    if (!value.is_boolean()) return "must be true or false";
    const std::string why = drivers_.setAutonomous(driverOf(client), name, value.get<bool>());
    if (why.empty()) hub.audit(client, name + (value.get<bool>() ? " on" : " off"));
    return why;
  }
  const bool is_played = run_->duration_s.has_value();
  if (name == kWorld || (name == kSeed && run_->seed)) return "cannot be changed during a run";
  if (name == kDuration && is_played) return "is that of the recording";
  const bool is_known = name == kPaused || name == kSpeed || name == kStepsLeft ||
                        (name == kRecording && recording.is_possible) || (name == kTime && is_played);
  if (!is_known) return "there is no such parameter";
  if (std::string why = whyNotOperated(client); !why.empty()) return why;
  if (name == kTime) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return "must be a number";
    seek_s_ = std::clamp(value.get<double>(), 0.0, *run_->duration_s);
    hub.audit(client, "time " + std::to_string(*seek_s_));
  } else if (name == kSpeed) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return "must be a number";
    const auto speed = value.get<double>();
    if (std::string fault = speedFault(speed, options_.is_realtime); !fault.empty()) return fault;
    control.speed = speed;
    hub.audit(client, "speed " + (speed == 0 ? "max" : std::to_string(speed)));
  } else if (name == kStepsLeft) {
    if (!value.is_number_unsigned()) return "must be a whole number";
    const auto steps = value.get<std::uint64_t>();
    if (std::string fault = steps == 0 ? "" : stepsFault(steps); !fault.empty()) return fault;
    control.pause(true);
    control.step(steps);
    hub.audit(client, "step " + std::to_string(steps));
  } else {
    if (!value.is_boolean()) return "must be true or false";
    const bool on = value.get<bool>();
    if (name == kPaused) {
      control.pause(on);
      hub.audit(client, on ? "pause" : "start");
    } else {
      try {
        recording.set(on);
      } catch (const ConfigError& error) {
        return error.what();
      }
      hub.audit(client, on ? "record on" : "record off");
    }
  }
  return "";
}

std::string FoxgloveServing::whyNotOperated(const foxglove::Client& client) {
  if (!run_->why_not_operated.empty()) return run_->why_not_operated;
  return server_.hub().may(client, Right::operate) ? "" : kMayNotOperate;
}

std::optional<double> FoxgloveServing::takeSeek() {
  if (seek_s_) feed_->restart();
  return std::exchange(seek_s_, std::nullopt);
}

foxglove::PlaybackState FoxgloveServing::playback(const RunControl& control) const {
  const double now_s = run_->state.time.seconds();
  const bool has_ended = run_->duration_s && now_s >= *run_->duration_s;
  return {has_ended           ? foxglove::PlaybackStatus::ended
          : control.is_paused ? foxglove::PlaybackStatus::paused
                              : foxglove::PlaybackStatus::playing,
          nanosecondsOf(now_s), static_cast<float>(control.speed), false};
}

void FoxgloveServing::play(const foxglove::PlaybackRequest& request, RunControl& control) {
  foxglove::Hub& hub = server_.hub();
  const auto& [plays, speed, seek_ns, id] = request.control;
  std::string why = whyNotOperated(request.client);
  if (why.empty()) why = std::isfinite(speed) ? speedFault(speed, options_.is_realtime) : "the speed must be a number";
  std::optional<double> own_seek_s;
  if (why.empty()) {
    control.speed = speed;
    control.pause(!plays);
    // The end of a recording is at most a step away.
    if (seek_ns) own_seek_s = seek_s_ = std::min(static_cast<double>(*seek_ns) * 1e-9, *run_->duration_s);
    hub.audit(request.client, std::string(plays ? "start" : "pause") + ", speed " + std::to_string(speed) +
                                  (own_seek_s ? ", time " + std::to_string(*own_seek_s) : ""));
  } else {
    hub.sendStatus(request.client.id, StatusLevel::error, "playback: " + why);
  }
  foxglove::PlaybackState state = playback(control);
  if (own_seek_s) {
    state.time_ns = nanosecondsOf(*own_seek_s);
    state.did_seek = true;
    if (plays || *own_seek_s < *run_->duration_s) {
      state.status = plays ? foxglove::PlaybackStatus::playing : foxglove::PlaybackStatus::paused;
    }
  }
  playback_ = state;
  hub.setPlayback(state, &request);
}

void FoxgloveServing::call(const foxglove::ServiceRequest& request, RunControl& control) {
  foxglove::Hub& hub = server_.hub();
  if (const std::string why = whyNotOperated(request.client); !why.empty()) return hub.refuse(request, why);
  if (request.encoding != "cdr" && request.encoding != "json") {
    hub.refuse(request, "the encoding must be cdr or json");
    return;
  }
  const RunService& service = kRunServices.at(request.service);
  service.execute(control);
  hub.audit(request.client, service.action);
  std::vector<std::uint8_t> response;
  if (request.encoding == "cdr") {
    ros::CdrWriter writer(response);
    writer.write(true);
    writer.write(std::string());
  } else {
    const std::string text = R"({"success":true,"message":""})";
    response.assign(text.begin(), text.end());
  }
  hub.answer(request, response);
}

}  // namespace robosim
