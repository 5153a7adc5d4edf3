#include "replay/file_functions.h"

#include <utility>

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "rendering/plan.h"
#include "replay/read_recording.h"

namespace robosim {
namespace {

using Poses = std::span<const mrpt::math::TPose2D>;

std::string drawn(PictureFormat format, const World& world, const Fleet& fleet, Poses world_from_robot) {
  DrawnRun run;
  run.world_from_robot.assign(world_from_robot.begin(), world_from_robot.end());
  return planPicture(format, world, fleet, run);
}

RgbPicture plan(const World& world, const Fleet& fleet, Poses world_from_robot) {
  std::string file = drawn(PictureFormat::png, world, fleet, world_from_robot);
  const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8U, file.data());
  const cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_COLOR);  // blue, green, red
  RgbPicture rgb{static_cast<std::size_t>(picture.rows), static_cast<std::size_t>(picture.cols), {}};
  rgb.values.reserve(3 * rgb.rows * rgb.columns);
  for (int row = 0; row < picture.rows; ++row) {
    const std::uint8_t* pixel = picture.ptr(row);
    for (int column = 0; column < picture.cols; ++column, pixel += 3) {
      rgb.values.insert(rgb.values.end(), {pixel[2], pixel[1], pixel[0]});
    }
  }
  return rgb;
}

std::string planSvg(const World& world, const Fleet& fleet, Poses world_from_robot) {
  return drawn(PictureFormat::svg, world, fleet, world_from_robot);
}

SeriesOfRecording read(const std::string& file, const std::function<void(std::uint64_t)>& progress) {
  RecordingContents contents = readRecording(file, {}, progress);
  return {std::move(*contents.table).takeSeries(), std::move(contents.read_error), contents.is_damaged};
}

}  // namespace
}  // namespace robosim

__attribute__((visibility("default"))) robosim::FileFunctions robosimFileFunctions() {
  using namespace robosim;
  return {.record = recordSimulation, .plan = plan, .plan_svg = planSvg, .read = read};
}
