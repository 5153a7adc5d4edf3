#include "robosim/figure_arguments.h"

#include <algorithm>

#include <mrpt/core/format.h>

#include "base/error_list.h"
#include "base/nearest_name.h"
#include "robosim/arguments.h"

namespace robosim {

void FigureArguments::addTo(CLI::App& command, const FigurePage& defaults) {
  command
      .add_option("--width-mm", width_mm, "figures in .svg and .pdf: width; the height follows from the world's shape")
      ->type_name("MM")
      ->check(numberIn(20, 2000))
      ->default_str(mrpt::format("%g", defaults.width_mm))
      ->group(kFigureGroup);
  command.add_option("--font-pt", font_pt, "figures in .svg and .pdf: size of the text")
      ->type_name("POINTS")
      ->check(numberIn(3, 72))
      ->default_str(mrpt::format("%g", defaults.font_pt))
      ->group(kFigureGroup);
}

FigurePage FigureArguments::page(const FigurePage& defaults) const {
  return {width_mm.value_or(defaults.width_mm), font_pt.value_or(defaults.font_pt)};
}

void FigureArguments::check(bool is_figure, const std::string& file) const {
  if (is_figure || (!width_mm && !font_pt)) return;
  const std::string option = width_mm ? "--width-mm" : "--font-pt";
  throw ConfigError(option + ": applies to figures of runs in .svg or .pdf" +
                    (file.empty() ? ", written by --offscreen" : ", and " + file + " is not one") + "; omit it");
}

namespace {

struct NamedLayer {
  const char* name;
  bool TopViewLayers::*is_shown;
};

/// To add a layer, add a line here.
constexpr NamedLayer kLayers[] = {
    {"paths", &TopViewLayers::paths},
    {"sensors", &TopViewLayers::sensors},
    {"events", &TopViewLayers::events},
    {"names", &TopViewLayers::names},
};

std::vector<std::string> layerNames() {
  std::vector<std::string> names;
  for (const auto& layer : kLayers) names.emplace_back(layer.name);
  return names;
}

std::string checkLayer(const std::string& name) {
  const auto names = layerNames();
  if (std::find(names.begin(), names.end(), name) != names.end()) return "";
  const std::string nearest = didYouMean(name, names);
  return "there is no layer '" + name + "'" + (nearest.empty() ? "; the layers are " + listed(names) : nearest);
}

}  // namespace

CLI::Option* LayerArguments::addTo(CLI::App& command, const std::string& help) {
  return command.add_option("--hide", hidden, help + ": " + listed(layerNames()))
      ->delimiter(',')
      ->type_name("LAYER,…")
      ->check(CLI::Validator(checkLayer, ""));
}

bool LayerArguments::hides(const std::string& layer) const {
  return std::find(hidden.begin(), hidden.end(), layer) != hidden.end();
}

TopViewLayers LayerArguments::layers() const {
  TopViewLayers layers;
  for (const auto& layer : kLayers) layers.*layer.is_shown = !hides(layer.name);
  return layers;
}

}  // namespace robosim
