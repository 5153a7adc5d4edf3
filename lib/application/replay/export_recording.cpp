#include "replay/export_recording.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/log.h"
#include "base/parallel_executor.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "recording/observation_writer.h"
#include "recording/rawlog_reader.h"
#include "rendering/picture_format.h"
#include "replay/csv_field.h"
#include "replay/mcap_export.h"
#include "replay/npz_writer.h"
#include "replay/read_recording.h"
#include "replay/recording_table.h"

namespace robosim {
namespace {

/// Progress and interruption of an export.
class ExportProgress {
 public:
  explicit ExportProgress(const Interrupt* interrupt) : interrupt_(interrupt) {}

  /// @param what formatted only when shown
  void at(const std::function<std::string()>& what) {
    if (interrupt_ && interrupt_->isRequested()) throw Interrupted("interrupted; nothing was written");
    if (progress_.due()) progress_.show(what());
  }

 private:
  const Interrupt* interrupt_;
  Progress progress_;
};

RecordingContents contentsOf(const std::string& rawlog, const std::vector<RecordingOutput>& outs,
                             const ViewLayers& layers, const RobotSelection& only, ExportProgress& progress,
                             int threads) {
  RecordingParts parts{.table = false, .figure = false, .page = false, .layers = layers, .only = only};
  for (const auto& out : outs) {
    if (out.format == RecordingFormat::mcap || out.format == RecordingFormat::rawlog) continue;
    (out.format == RecordingFormat::picture ? parts.figure
     : out.format == RecordingFormat::page  ? parts.page
                                            : parts.table) = true;
  }
  const auto show = [&](std::uint64_t entries) {
    progress.at([&] { return "reading: " + withCommas(entries) + " entries …"; });
  };
  RecordingContents read = readRecording(rawlog, parts, show, threads);
  if (!read.unread.empty()) {
    const std::size_t count = read.unread.size();
    logWarning("export", rawlog + ": " + std::to_string(count) +
                             (count == 1 ? " topic or kind of message is" : " topics or kinds of messages are") +
                             " not read, which robosim replay lists");
  }
  for (const auto& assumption : read.assumptions) logWarning("export", assumption);
  if (read.read_error) logWarning("export", *read.read_error);
  if (read.page) {
    for (const auto& assumption : read.assumptions) read.page->addRemark(assumption);
    if (read.read_error) read.page->addRemark(*read.read_error);
  }
  return read;
}

/// The columns of a sensor of all robots.
class CsvColumns {
 public:
  explicit CsvColumns(const RecordingTable& table) : of_series_(table.series().size()) {
    // Sensors and their columns are in the order of their first appearance.
    std::map<std::string, std::vector<std::size_t>> series_of;
    std::vector<std::string> sensors;
    for (std::size_t i = 0; i < table.series().size(); ++i) {
      const std::string& sensor = table.series()[i].sensor;
      if (series_of[sensor].empty()) sensors.push_back(sensor);
      series_of[sensor].push_back(i);
    }
    for (const auto& sensor : sensors) {
      std::map<std::string, std::size_t> index_of;
      for (const std::size_t series : series_of[sensor]) {
        for (const auto& column : table.series()[series].columns) {
          const auto [found, is_new] = index_of.try_emplace(column.name, names_.size());
          if (is_new) names_.push_back(sensor + "/" + column.name);
          of_series_[series].push_back(found->second);
        }
      }
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  /// Index in names() of each column of a series.
  const std::vector<std::size_t>& of(std::size_t series) const { return of_series_[series]; }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<std::size_t>> of_series_;
};

/// A row of the table, with its line end. @param fields of the columns, to be reused
std::string lineOf(const RecordingTable::Row& row, const RecordingTable& table, const CsvColumns& columns,
                   std::vector<std::string>& fields) {
  fields.resize(columns.names().size());
  for (auto& field : fields) field.clear();
  for (const auto& [index, of_series] : row.observations) {
    const RecordedSeries& series = table.series()[index];
    for (std::size_t i = 0; i < series.columns.size(); ++i) {
      std::string text = csvField(series.columns[i].value(of_series));
      if (!text.empty()) fields[columns.of(index)[i]] = std::move(text);
    }
  }
  std::string line = std::to_string(row.step) + "," + fixed(row.time_s, 7) + "," + csvField(row.robot);
  for (const auto& field : fields) line.append(",").append(field);
  return line + "\n";
}

void writeCsv(const RecordingTable& table, AtomicFile& file, ExportProgress& progress, int threads) {
  constexpr std::size_t kRowsAtATime = 4096;
  const CsvColumns columns(table);
  std::string head = "step,time_s,robot";
  for (const auto& name : columns.names()) head += "," + csvField(name);
  file.write(head + "\n");
  const ParallelExecutor executor(threads);
  std::vector<std::string> lines(kRowsAtATime);
  const auto& rows = table.rows();
  for (std::size_t first = 0; first < rows.size(); first += kRowsAtATime) {
    progress.at([&] { return "writing: row " + withCommas(first) + " of " + withCommas(rows.size()) + " …"; });
    const std::size_t count = std::min(kRowsAtATime, rows.size() - first);
    executor.forChunks(count, 256, [&](std::size_t begin, std::size_t end) {
      std::vector<std::string> fields;
      for (std::size_t i = begin; i < end; ++i) lines[i] = lineOf(rows[first + i], table, columns, fields);
    });
    for (std::size_t i = 0; i < count; ++i) file.write(lines[i]);
  }
}

void addSeries(const RecordedSeries& series, NpzWriter& npz) {
  std::vector<const RecordedColumn*> numbers;
  std::vector<std::string> names;
  for (const auto& column : series.columns) {
    if (column.kind == RecordedColumn::Kind::text) continue;
    numbers.push_back(&column);
    names.push_back(column.name);
  }
  const std::size_t rows = series.steps.size();
  if (!numbers.empty()) {
    npz.addTable(series.label, rows, numbers.size(),
                 [&](std::size_t row, std::size_t column) { return numbers[column]->number(row); });
    npz.add(series.label + "/columns", names);
  }
  npz.add(series.label + "/step", series.steps);
  npz.add(series.label + "/time_s", series.times_s);
  for (const auto& column : series.columns) {
    if (column.kind != RecordedColumn::Kind::text) continue;
    std::vector<std::string> texts = column.texts;
    texts.resize(rows);
    npz.add(series.label + "/" + column.name, texts);
  }
}

void writeNpz(const RecordingTable& table, AtomicFile& file, ExportProgress& progress) {
  NpzWriter npz(file);
  for (const auto& series : table.series()) {
    progress.at([&] { return "writing: " + series.label + " …"; });
    addSeries(series, npz);
  }
  npz.writeDirectory();
}

/// Writes all observations. @returns the file, without its name yet
std::unique_ptr<ObservationWriter> writeRawlog(const std::string& recording, const std::filesystem::path& out,
                                               ExportProgress& progress, int threads) {
  RawlogReader reader(recording, RawlogReader::Access::sequential, threads);
  auto writer = std::make_unique<ObservationWriter>(out, reader.pictureFolder());
  while (const auto observation = reader.next()) {
    writer->write(*observation);
    progress.at([&] { return "rawlog: " + withCommas(reader.entries()) + " entries …"; });
  }
  return writer;
}

}  // namespace

bool exportRecording(const std::string& rawlog, const std::vector<RecordingOutput>& outs, const Interrupt* interrupt,
                     const FigurePage& page, const ViewLayers& layers, const RobotSelection& only, int threads) {
  std::vector<std::unique_ptr<AtomicFile>> files;  // null for MCAP and rawlogs
  for (const auto& out : outs) {
    const bool is_recording = out.format == RecordingFormat::mcap || out.format == RecordingFormat::rawlog;
    files.push_back(is_recording ? nullptr : std::make_unique<AtomicFile>(out.file));
  }
  ExportProgress progress(interrupt);
  std::vector<std::unique_ptr<ObservationWriter>> rawlogs;
  for (const auto& out : outs) {
    if (out.format == RecordingFormat::rawlog) rawlogs.push_back(writeRawlog(rawlog, out.file, progress, threads));
  }
  std::vector<McapExport> mcaps;
  for (const auto& out : outs) {
    if (out.format != RecordingFormat::mcap) continue;
    const auto show = [&](std::uint64_t steps) {
      progress.at([&] { return "MCAP: " + withCommas(steps) + " steps …"; });
    };
    mcaps.push_back(exportMcap(rawlog, out.file, out.distribution, show, threads));
  }
  if (mcaps.size() == outs.size()) {
    if (mcaps[0].read_error) logWarning("export", *mcaps[0].read_error);
    for (const auto& mcap : mcaps) mcap.file->commit();
    return !mcaps[0].is_damaged;
  }
  RecordingContents contents = contentsOf(rawlog, outs, layers, only, progress, threads);
  for (std::size_t i = 0; i < outs.size(); ++i) {
    if (!files[i]) continue;
    switch (outs[i].format) {
      case RecordingFormat::csv:
        writeCsv(*contents.table, *files[i], progress, threads);
        break;
      case RecordingFormat::npz:
        writeNpz(*contents.table, *files[i], progress);
        break;
      case RecordingFormat::mcap:
      case RecordingFormat::rawlog:
        break;  // above
      case RecordingFormat::picture:
        progress.at([] { return "drawing …"; });
        files[i]->write(contents.figure->draw(requirePictureFormat(outs[i].file), page, layers, only));
        break;
      case RecordingFormat::page:
        files[i]->write(
            contents.page->html([&](const std::string& what) { progress.at([&] { return "page: " + what + " …"; }); }));
        break;
    }
    files[i]->finish();
  }
  for (auto& file : files) {
    if (file) file->commit();
  }
  for (const auto& mcap : mcaps) mcap.file->commit();
  for (const auto& writer : rawlogs) writer->commit();
  return !contents.is_damaged;
}

}  // namespace robosim
