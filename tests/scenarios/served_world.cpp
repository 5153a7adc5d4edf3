#include "tests/scenarios/served_world.h"

#include <gtest/gtest.h>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

RunOptions runOptions(const std::string& controller) {
  RunOptions options;
  options.controller = controller;
  return options;
}

}  // namespace

ServedWorld::LoadedRun::LoadedRun(LoadedWorld world, const WorldSource& source, const Options& options)
    : networked(world.fleet.robots.size(), options.robots_elsewhere ? 1 : 0),
      run(std::move(world), runOptions(options.controller), networked),
      run_info(run.environment(), source, 1, networked) {}

ServedWorld::ServedWorld(const Options& options) : options_(options) {
  run_ = loadedRunOf(readWorldSource(ROBOSIM_SOURCE_DIR "/" + options.world));
  options_.server.listen = ListenAddresses::parse("127.0.0.1:0");
  options_.server.log = [this](const std::string& line) {
    const std::lock_guard lock(mutex_);
    log_ += line + "\n";
    condition_.notify_all();
  };
  server_ = std::make_unique<EnvironmentServer>(options_.server, runInfo());
  thread_ = std::thread([this] {
    how_ = server_->serve(*this, [this] {
      const std::lock_guard lock(mutex_);
      return must_end_;
    });
  });
}

ServedWorld::~ServedWorld() { end(); }

ConnectOptions ServedWorld::connectOptions() const {
  ConnectOptions options;
  options.address = "127.0.0.1:" + std::to_string(port());
  return options;
}

Served ServedWorld::end() {
  {
    const std::lock_guard lock(mutex_);
    must_end_ = true;
  }
  return wait();
}

Served ServedWorld::wait() {
  if (thread_.joinable()) thread_.join();
  return how_;
}

std::string ServedWorld::log() const {
  const std::lock_guard lock(mutex_);
  return log_;
}

void ServedWorld::waitForLog(const std::string& text, std::size_t times) {
  std::unique_lock lock(mutex_);
  EXPECT_TRUE(condition_.wait_for(lock, kLongestWait, [&] { return countOf(text, log_) >= times; }))
      << "waited 5 minutes for '" << text << "' in\n"
      << log_;
}

void ServedWorld::setStepping(bool is_stepping) {
  const std::lock_guard lock(mutex_);
  is_stepping_ = is_stepping;
  condition_.notify_all();
}

void ServedWorld::waitUntilStepping() {
  std::unique_lock lock(mutex_);
  EXPECT_TRUE(condition_.wait_for(lock, kLongestWait, [&] { return is_stepping_; })) << "no step has begun";
}

std::shared_ptr<ServedWorld::LoadedRun> ServedWorld::loadedRunOf(const WorldSource& source) const {
  return std::make_shared<LoadedRun>(loadWorld(source, checkController), source, options_);
}

std::unique_ptr<PreparedRun> ServedWorld::prepare(const WorldSource& source) const {
  options_.before_preparing();
  auto prepared = std::make_unique<PreparedWorld>();
  prepared->loaded = loadedRunOf(source);
  return prepared;
}

void ServedWorld::replace(std::unique_ptr<PreparedRun> next) { run_ = static_cast<PreparedWorld&>(*next).loaded; }

}  // namespace robosim
