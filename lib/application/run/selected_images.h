#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "environment/environment.h"
#include "sensors/image_source.h"

namespace robosim {

/// ImageSource that renders the pictures of selected robots only; those of the others are empty.
class SelectedImages final : public ImageSource {
 public:
  /// @param source renders
  explicit SelectedImages(std::unique_ptr<ImageSource> source) : source_(std::move(source)) {}

  /// Flags by robot; empty: none. Not while pictures are taken.
  std::vector<std::uint8_t> selected{};

  void take(const CameraView& camera, const SeenWorld& seen, std::span<const std::uint32_t> robots,
            std::span<std::string> jpegs) override;
  std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors,
                              unsigned pixels_min) override {
    return source_->findBlobs(jpeg, colors, pixels_min);
  }

 private:
  std::unique_ptr<ImageSource> source_;
};

/// Measures in the present state with the cameras and blob finders of these robots, as they did not in the step.
/// @param robots in ascending order; absent ones are left out
void measureWithCameras(Environment& environment, const std::vector<std::uint32_t>& robots);

}  // namespace robosim
