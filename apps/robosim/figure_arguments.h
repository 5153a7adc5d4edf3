#pragma once
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "rendering/figure_page.h"
#include "robots/robot_selection.h"
#include "robots/view_layers.h"

namespace robosim {

/// --width-mm and --font-pt: the size of a figure on paper.
struct FigureArguments {
  std::optional<double> width_mm, font_pt;

  void addTo(CLI::App& command, const FigurePage& defaults);
  FigurePage page(const FigurePage& defaults = {}) const;
  /// @param is_figure whether `file` is a figure of a run in SVG or PDF
  /// @throws ConfigError when sizes are given for another file
  void check(bool is_figure, const std::string& file) const;
};

/// --hide, --show and --only: what pictures, videos, figures and windows show. Each command has all three.
struct LayerArguments {
  std::vector<std::string> hidden, shown, robots;

  /// Adds the options, in the order of their declaration above.
  std::vector<CLI::Option*> addTo(CLI::App& command);
  ViewLayers layers() const;
  RobotSelection only() const { return RobotSelection(robots); }
  /// Refuses what an output cannot show.
  /// @param output in the error text, such as "a plan of a world" @param drawn names of its layers
  /// @param has_robots whether it draws robots @throws ConfigError
  void check(const std::string& output, const std::vector<std::string>& drawn, bool has_robots = true) const;
};

/// Names of the layers of a window, picture or video, of a figure of a run or a step, of the page of a run, and of a
/// plan by run --picture.
std::vector<std::string> windowLayers();
std::vector<std::string> figureLayers();
std::vector<std::string> pageLayers();
std::vector<std::string> planLayers();

}  // namespace robosim
