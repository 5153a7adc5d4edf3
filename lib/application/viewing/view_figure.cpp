#include <iostream>

#include "base/atomic_file.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "rendering/run_figure.h"
#include "rendering/snapshot_run.h"
#include "viewing/view_outputs.h"

namespace robosim {

void writeViewFigure(ViewSource& source, const ViewTimes& times, const std::string& file, const FigurePage& page,
                     ViewLayers layers, const RobotSelection& only) {
  AtomicFile whole(file);
  showPictureTime(source, times);
  const LoadedWorld& loaded = source.world();
  layers.paths_from_s = times.from_s.value_or(0);
  layers.only = only.flagsIn(loaded.fleet, RobotSelection::Unmatched::refused);
  DrawnRun run = drawnRun(loaded.fleet, source.snapshot(), source.paths(), layers, &source.events());
  run.objects = source.snapshot().objects;
  run.density = densityOf(layers, loaded.world, loaded.fleet, source.snapshot(), source.paths());
  if (source.snapshot().time_s > 0) run.title = loaded.world.name + ", " + fixed(source.snapshot().time_s, 1) + " s";
  whole.write(runFigure(requirePictureFormat(file), loaded.world, loaded.fleet, run, page));
  whole.commit();
  std::cout << printableText(file) << '\n';
  if (const auto remark = source.remark(); !remark.empty()) logWarning("view", remark);
}

}  // namespace robosim
