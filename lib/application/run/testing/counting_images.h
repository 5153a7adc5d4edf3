#pragma once
#include <memory>
#include <string>
#include <vector>

#include "run/local_run.h"
#include "sensors/image_source.h"

namespace robosim {

/// Counts the pictures of this process's runs instead of rendering them, while it exists. A picture consists of the
/// number of its robot between the first and last bytes of a JPEG file.
class CountedPictures {
 public:
  /// @param robots number of robots of each run @param afterwards the maker of this process's other runs
  explicit CountedPictures(std::size_t robots, ImageSourceMaker afterwards = nullptr) : afterwards_(afterwards) {
    counts().assign(robots, 0);
    setImageSourceMaker(
        [](const World&, const Fleet&) -> std::unique_ptr<ImageSource> { return std::make_unique<Images>(); });
  }
  ~CountedPictures() { setImageSourceMaker(afterwards_); }
  CountedPictures(const CountedPictures&) = delete;
  CountedPictures& operator=(const CountedPictures&) = delete;

  /// By robot. Not while a run takes a step.
  const std::vector<int>& taken() const { return counts(); }
  static std::string pictureOf(std::size_t robot) {
    return "\xFF\xD8 picture of " + std::to_string(robot) + " \xFF\xD9";
  }

 private:
  ImageSourceMaker afterwards_;

  static std::vector<int>& counts() {
    static std::vector<int> of_robots;
    return of_robots;
  }

  class Images final : public ImageSource {
   public:
    void take(const CameraView&, const SeenWorld&, std::span<const std::uint32_t> robots,
              std::span<std::string> jpegs) override {
      for (std::size_t i = 0; i < robots.size(); ++i) {
        ++counts().at(robots[i]);
        jpegs[i] = pictureOf(robots[i]);
      }
    }
    std::vector<Blob> findBlobs(const std::string&, const std::vector<TargetColor>&, unsigned) override { return {}; }
  };
};

/// A world of robots "R0", "R1", …, which stand 1 m apart, each with a camera.
inline WorldSource worldOfCameras(std::size_t robots, double rate_hz) {
  WorldSource source;
  source.file = "w.xml";
  source.text = "<world><surface><size><xmin>-5</xmin><xmax>50</xmax><ymin>-5</ymin><ymax>5</ymax></size>";
  for (std::size_t i = 0; i < robots; ++i) {
    source.text += "<object><shape><robot><model>eye</model><name>R" + std::to_string(i) + "</name><x>" +
                   std::to_string(i) + "</x><y>0</y><direction>0</direction></robot></shape></object>";
  }
  source.text += "</surface></world>";
  source.robot_types["eye"] = {
      "eye.xml",
      "<robot name='eye' help='Sees.'><body radius_m='0.2' height_m='0.3'/><limits speed_max_mps='1' accel_mps2='1' "
      "decel_mps2='1' turn_max_degps='9' turn_accel_degps2='9'/><sensors><camera rate_hz='" +
          std::to_string(rate_hz) + "'/></sensors></robot>"};
  return source;
}

}  // namespace robosim
