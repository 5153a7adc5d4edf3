#pragma once
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "rendering/figure_page.h"
#include "rendering/top_view.h"

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

/// --hide: layers that a picture is drawn without.
struct LayerArguments {
  std::vector<std::string> hidden;

  /// Adds the option. @param help before the names of the layers
  CLI::Option* addTo(CLI::App& command, const std::string& help);
  bool hides(const std::string& layer) const;
  TopViewLayers layers() const;
};

}  // namespace robosim
