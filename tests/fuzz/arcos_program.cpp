// Fuzzes the robot's side of ARCOS with the bytes that a program sends, in pieces; the first byte selects their length.
#include "arcos/board/arcos_board.h"
#include "arcos/board/arcos_session.h"
#include "environment/local_hardware.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"

using namespace robosim;

namespace {

struct NoSimulator final : Simulator {
  arcos::SimStat stat() const override { return {}; }
  void setTruePose(const arcos::SimPose&) override {}
  void resetTruePose() override {}
  std::string mapFile() const override { return "map"; }
  std::optional<arcos::SimMap> loadMap(const std::string&) override { return arcos::SimMap{}; }
  arcos::Scan scan(std::size_t) const override { return {.ranges_mm = ranges}; }
  void log(const std::string&) override {}
  std::vector<std::uint16_t> ranges = std::vector<std::uint16_t>(181, 1000);
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  LocalHardware hardware(smallMaze(), 0);
  Robot robot(hardware);
  static const arcos::Parameters parameters{.subclass = "p3dx", .front_bumpers = 5, .rear_bumpers = 5};
  ArcosBoard board(robot, parameters);
  NoSimulator simulator;
  const ArcosSession::Clock::time_point now;
  ArcosSession session(board, simulator, now);
  const std::size_t piece = data[0] + 1u;
  std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  while (!bytes.empty() && session.endReason().empty()) {
    session.receive(bytes.substr(0, piece), now);
    bytes.remove_prefix(std::min(piece, bytes.size()));
    session.beforeStep(now);
    session.cycle();
  }
  return 0;
}
