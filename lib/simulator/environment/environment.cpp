#include "environment/environment.h"

#include <stdexcept>
#include <utility>

#include "environment/environment_impl.h"
#include "environment/step_phases.h"

namespace robosim {

Environment::Environment(World world, Fleet fleet, const EnvironmentOptions& options, ImageSource* images) {
  auto model = std::make_shared<const Model>(std::move(world), std::move(fleet), options.seed, options.period_s);
  State start = options.share ? initialState(*model, options.share->kept) : initialState(*model);
  impl_ = std::make_unique<Impl>(std::move(model), std::move(start), options.threads, images, options.share);
  impl_->start();
}

Environment::Environment(std::shared_ptr<const Model> model, State state, int threads, ImageSource* images) {
  if (state.additions != model->additions) model = withAdditions(*model, state.additions);
  requireSameShape(state, initialState(*model));
  impl_ = std::make_unique<Impl>(std::move(model), std::move(state), threads, images);
}

Environment::~Environment() = default;

const std::shared_ptr<const Model>& Environment::model() const { return impl_->model; }
const State& Environment::state() const { return impl_->state; }
void Environment::restore(const State& state) { impl_->restore(state); }
void Environment::restart(const State& start) { impl_->restart(start); }

void Environment::setCommand(std::size_t robot, const Command& command) { impl_->setCommand(robot, command); }

const std::vector<std::string>& Environment::robotNames() const { return impl_->message_router.names().list(); }

void Environment::send(std::size_t from, const std::string& to, const std::string& text) {
  impl_->message_router.send(from, to, text, impl_->state.outboxes[from]);
  impl_->may_send[from] = 1;
}

void Environment::broadcast(std::size_t from, const std::string& text) {
  impl_->message_router.broadcast(from, text, impl_->state.outboxes[from]);
  impl_->may_send[from] = 1;
}

void Environment::receive(std::size_t to, std::size_t from, const std::string& text) {
  impl_->message_router.receiveNext(impl_->state.time, static_cast<std::uint32_t>(to), static_cast<std::uint32_t>(from),
                                    text, impl_->state.messages_in_flight);
}

void Environment::checkWin(std::size_t robot) { impl_->state.win_requests[robot] = 1; }

void Environment::countDroppedMessages(std::uint64_t messages) { impl_->state.messages_dropped += messages; }

bool Environment::enter(std::size_t robot) { return impl_->enter(robot); }

void Environment::setRobotCheck(RobotCheck check) { impl_->robot_check = std::move(check); }

void Environment::setImagesOf(ImagesOf images_of) { impl_->images_of = std::move(images_of); }

World Environment::presentWorld() const {
  World present = world();
  present.objects = objects();
  if (present.robots.empty()) return present;  // it was loaded without, to save memory
  for (const AddRobot& added : state().additions.list()) {
    RobotPlacement& robot = present.robots.emplace_back();
    robot.name = added.name;
    robot.model = added.model;
    robot.world_from_robot = added.world_from_robot;
    robot.color = added.color;
    robot.controller = added.controller;
    robot.neighbour = added.neighbour;
  }
  return present;
}

const Communication& Environment::communication() const {
  const auto& changed = impl_->state.communication;
  return changed ? *changed : world().communication;
}

void Environment::remove(std::span<const std::size_t> robots) { impl_->remove(robots); }

std::uint64_t Environment::poseChanges() const { return impl_->pose_changes; }

void Environment::measure(const Sensor& sensor, std::span<const std::uint32_t> robots, std::span<Readings> readings) {
  impl_->measure(sensor, robots, readings);
}

void Environment::senseOnly(IsSensed is_sensed) {
  if (impl_->state.digest) throw std::invalid_argument("a run with a digest computes all its sensors");
  impl_->is_sensed = std::move(is_sensed);
  impl_->robot_groups = RobotGroups(fleet(), model()->period_s, impl_->is_sensed);
}

StepPhases Environment::phases() { return StepPhases(*impl_); }

void Environment::step() {
  StepPhases phases = this->phases();
  phases.begin();
  const RobotRange every = impl_->everyRobot();  // of which the timeline may have added some
  phases.clip(every);
  phases.judge(every);
  phases.move();
  phases.senseFully(every);
  phases.conclude();
}

std::string Environment::digest() const {
  if (impl_->state.digest) return impl_->state.digest->text();
  throw std::invalid_argument(
      "this run computes no digest; start it from a state with a digest, as initialState() has");
}

}  // namespace robosim
