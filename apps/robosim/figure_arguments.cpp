#include "robosim/figure_arguments.h"

#include <mrpt/core/format.h>

#include "base/error_list.h"
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

}  // namespace robosim
