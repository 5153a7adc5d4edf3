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

/// @param keep whether a layer is among them
template <typename Keep>
std::vector<std::string> layerNames(const Keep& keep) {
  std::vector<std::string> names;
  for (const ViewLayer& layer : viewLayers()) {
    if (keep(layer)) names.emplace_back(layer.name);
  }
  return names;
}

std::vector<std::string> layersShown(bool at_first) {
  return layerNames([at_first](const ViewLayer& layer) { return layer.is_shown_first == at_first; });
}

/// For --hide the layers that are shown without an option, for --show the others.
CLI::Validator layerName(bool is_hidden) {
  return {[is_hidden](std::string& name) {
            const auto names = layersShown(is_hidden), others = layersShown(!is_hidden);
            if (std::find(names.begin(), names.end(), name) != names.end()) return std::string();
            if (std::find(others.begin(), others.end(), name) != others.end()) {
              return "the layer '" + name + "' is " +
                     (is_hidden ? "not shown without --show" : "shown unless --hide is given") + "; omit it";
            }
            const std::string nearest = didYouMean(name, names);
            return "there is no layer '" + name + "'" +
                   (nearest.empty() ? "; the layers are " + listed(names) : nearest);
          },
          ""};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<CLI::Option*> LayerArguments::addTo(CLI::App& command) {
  return {
      command
          .add_option("--hide", hidden,
                      "leave out these layers; in a window, until they are switched on: " + listed(layersShown(true)))
          ->delimiter(',')
          ->type_name("LAYER,…")
          ->check(layerName(true))
          ->group(kFigureGroup),
      command
          .add_option("--show", shown,
                      "color the floor by robots per m², where they are at that time (density), or by visits per m² "
                      "(visits)")
          ->type_name("density|visits")
          ->expected(1)
          ->check(layerName(false))
          ->group(kFigureGroup),
      command
          .add_option("--only", robots,
                      "show these robots only: names, with * and ? for any characters, or ranges as Robot3..12")
          ->delimiter(',')
          ->type_name("ROBOT,…")
          ->group(kFigureGroup)};
}

ViewLayers LayerArguments::layers() const {
  ViewLayers layers;
  for (const ViewLayer& layer : viewLayers()) {
    if (contains(hidden, layer.name)) setShown(layers, layer, false);
    if (contains(shown, layer.name)) setShown(layers, layer, true);
  }
  return layers;
}

void LayerArguments::check(const std::string& output, const std::vector<std::string>& drawn, bool has_robots) const {
  for (const auto& [option, names] : {std::pair{"--hide", &hidden}, {"--show", &shown}}) {
    for (const auto& name : *names) {
      if (contains(drawn, name)) continue;
      throw ConfigError(std::string(option) + " " + name + ": " + output + " has no " + name + "; omit it");
    }
  }
  if (!robots.empty() && !has_robots) throw ConfigError("--only: " + output + " has no robots; omit it");
}

std::vector<std::string> windowLayers() {
  return layerNames([](const ViewLayer& layer) { return layer.key != 0; });
}

std::vector<std::string> figureLayers() {
  return layerNames([](const ViewLayer&) { return true; });
}

std::vector<std::string> pageLayers() {
  return layerNames([](const ViewLayer& layer) {
    return  // which shows sensors only when they are switched on
        layer.is_shown_first && layer.is_shown != &ViewLayers::starts && layer.is_shown != &ViewLayers::sensors;
  });
}

std::vector<std::string> planLayers() {
  return layerNames([](const ViewLayer& layer) {
    return layer.is_shown != &ViewLayers::sensors && layer.is_shown != &ViewLayers::events;
  });
}

}  // namespace robosim
