#include <iostream>

#include "base/error_list.h"
#include "base/file_kind.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "recording/observation_writer.h"
#include "recording/rawlog_reader.h"
#include "replay/replay.h"
#include "replay/selection.h"

namespace robosim {

ReplayResult writeSelection(const ReplayArguments& arguments) {
  if (isMcapName(arguments.output)) {
    throw ConfigError(arguments.output + ": a selection is written as a rawlog; use a name that ends in .rawlog");
  }
  const Interrupt interrupt;
  RawlogReader reader(arguments.rawlog, RawlogReader::Access::sequential, arguments.threads);
  ObservationWriter writer(arguments.output, reader.pictureFolder());
  Selection selection(arguments);
  Progress progress;
  std::uint64_t observations = 0;
  while (const auto observation = reader.next()) {
    if (interrupt.isRequested()) throw Interrupted("interrupted; nothing was written");
    if (!selection.takes(*observation, reader)) continue;
    writer.write(*observation);
    ++observations;
    if (progress.due()) progress.show(withCommas(observations) + " observations …");
  }
  selection.checkFound();
  writer.commit();
  std::cout << arguments.output << ": " << withCommas(observations) << " observations\n";
  warnOf(reader);
  return resultOf(reader);
}

}  // namespace robosim
