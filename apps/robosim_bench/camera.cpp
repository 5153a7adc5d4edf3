#include <cmath>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/data_folders.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "rendering/offscreen_renderer.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/min_time.h"
#include "robosim_bench/rounds.h"
#include "run/local_run.h"

namespace robosim {
namespace {

struct Pictures {
  std::uint32_t width_px, height_px;
  double aim_per_cpu_s;  ///< target; 0 for none
  bool is_antialiased = false;

  std::string text() const {
    return std::to_string(width_px) + " × " + std::to_string(height_px) + (is_antialiased ? ", antialiased" : "");
  }
};
constexpr Pictures kPictures[] = {{160, 120, 0}, {320, 240, 100}, {320, 240, 0, true}, {640, 480, 0}};

struct CameraArguments {
  std::string world;
  double min_s = 1;
  bool json = false;
};

std::string standardWorld() { return (shareFolder() / "worlds" / "opho2_1.xml").string(); }

/// Per robot: takes a picture, turns slightly, takes another: rendering, readback and compression.
class Photographers {
 public:
  Photographers(const LoadedWorld& world, OffscreenRenderer& renderer, const Pictures& pictures)
      : renderer_(renderer),
        camera_{.info = {pictures.width_px, pictures.height_px, M_PI / 3, 10},
                .robot_from_camera = {0.2, 0, 0.3, 0, 0.1, 0},
                .jpeg_quality = 85,
                .is_antialiased = pictures.is_antialiased} {
    for (const auto& robot : world.fleet.robots) {
      robots_.push_back(static_cast<std::uint32_t>(robots_.size()));
      poses_.push_back(robot.world_from_start);
    }
    jpegs_.resize(robots_.size());
  }

  double takePictures() {
    for (auto& pose : poses_) pose.phi = std::remainder(pose.phi + 0.3, 2 * M_PI);
    renderer_.take(camera_, poses_, robots_, jpegs_);
    for (const auto& jpeg : jpegs_) bytes_ += static_cast<double>(jpeg.size());
    pictures_ += static_cast<double>(jpegs_.size());
    return static_cast<double>(jpegs_.size());
  }
  double bytesEach() const { return bytes_ / pictures_; }

 private:
  OffscreenRenderer& renderer_;
  CameraView camera_;
  std::vector<std::uint32_t> robots_;
  std::vector<mrpt::math::TPose2D> poses_;
  std::vector<std::string> jpegs_;
  double bytes_ = 0, pictures_ = 0;
};

void benchCamera(const CameraArguments& arguments) {
  const LoadedWorld world = loadWorldToRun(arguments.world.empty() ? standardWorld() : arguments.world, "");
  OffscreenRenderer renderer(world.world, world.fleet);
  std::vector<Photographers> photographers;
  for (const Pictures& pictures : kPictures) photographers.emplace_back(world, renderer, pictures);
  std::vector<Contender> contenders;
  for (auto& p : photographers) contenders.push_back({.work = [&p] { return p.takePictures(); }});
  std::vector<Cost> costs;
  {
    Progress progress;
    if (progress.due()) progress.show("pictures of all sizes …");
    costs = measureAlternately(contenders, arguments.min_s);
  }
  Rows rows{{"pixels", "pictures/s of CPU time", "target", "pictures/s", "bytes each"}};
  for (std::size_t i = 0; i < std::size(kPictures); ++i) {
    const auto count = [](double number) { return withCommas(static_cast<std::uint64_t>(std::llround(number))); };
    const Pictures& pictures = kPictures[i];
    if (arguments.json) {
      std::cout << nlohmann::ordered_json{{"width_px", pictures.width_px},
                                          {"height_px", pictures.height_px},
                                          {"antialiased", pictures.is_antialiased},
                                          {"pictures_per_cpu_s", 1 / costs[i].cpu_s},
                                          {"pictures_per_s", 1 / costs[i].wall_s},
                                          {"bytes", photographers[i].bytesEach()}}
                       .dump()
                << std::endl;
    }
    rows.push_back({pictures.text(), count(1 / costs[i].cpu_s),
                    pictures.aim_per_cpu_s > 0 ? count(pictures.aim_per_cpu_s) : "–", count(1 / costs[i].wall_s),
                    count(photographers[i].bytesEach())});
  }
  if (!arguments.json) std::cout << table(rows);
}

}  // namespace

void addCameraBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("camera", "Measure the frame rate of robot cameras");
  auto a = std::make_shared<CameraArguments>();
  command->add_option("WORLD", a->world, "world file; default: the shipped opho2_1.xml")->type_name("FILE");
  addMinTime(*command, "each size", a->min_s);
  command->add_flag("--json", a->json, "print one JSON object per line");
  command->footer(
      "Each robot of the world takes JPEG pictures in all directions from its start. CPU time is that of all\n"
      "threads, including a software renderer; the time of a graphics card is in the last but one column only.");
  command->callback([a] { benchCamera(*a); });
}

}  // namespace robosim
