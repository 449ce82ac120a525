// SPDX-License-Identifier: BSD-3-Clause
#include "cases/measured/LogReport.hpp"

#include <fmt/format.h>
#include <map>

#include "common/Text.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"

namespace tooljoint::cases {

namespace {

/// The ratio is called stick-slip index for speeds and fluctuation for other quantities.
const char* indexName(const MeasuredQuantity& quantity) {
  return quantity.si == "rad/s" ? "stick-slip index" : "fluctuation";
}

std::string firstPeak(const ComparedSignal& signal) {
  return signal.peaks.empty() ? "-" : fmt::format("{:.4g} Hz", signal.peaks.front().frequency);
}

std::string line(const MeasuredColumn& column, const SignalComparison& found) {
  const auto& usual = column.quantity.usual;
  return fmt::format(
      "  {}: difference {}, {} rms\n"
      "    {} {:.3g} (measured {:.3g}), largest peak {} (measured {})",
      column.name, deck::printed(found.mean, usual, 4), deck::printed(found.rms, usual, 4),
      indexName(column.quantity), found.computed.figures.fluctuationIndex(),
      found.measured.figures.fluctuationIndex(), firstPeak(found.computed),
      firstPeak(found.measured));
}

void set(const char* which, const ComparedSignal& signal, io::SummaryRow& row) {
  const std::string key = which;
  row.set(key + "_mean", signal.figures.mean())
      .set(key + "_min", signal.figures.min())
      .set(key + "_max", signal.figures.max())
      .set(key + "_index", signal.figures.fluctuationIndex());
  if (signal.peaks.empty()) return;
  row.set(key + "_peak_hz", signal.peaks.front().frequency)
      .set(key + "_peak_amplitude", signal.peaks.front().amplitude);
}

void writeSpectrum(const std::string& path, const ComparedSignal& signal,
                   const MeasuredColumn& column, const char* which, io::ResultsFile& file) {
  const auto& spectrum = signal.spectrum;
  if (spectrum.frequency.empty()) return;
  const io::Shape shape{spectrum.frequency.size()};
  file.write(path + "_frequency", spectrum.frequency, shape, "Hz",
             std::string("Frequencies of the spectrum, ") + which);
  file.write(path + "_spectrum", spectrum.density, shape, "(" + column.quantity.si + ")2/Hz",
             std::string("One-sided power density, ") + which);
}

}  // namespace

std::string describe(const ComparedLog& compared) {
  std::string text = fmt::format("measured    {:.6g} to {:.6g} s of {}, computed less measured:",
                                 compared.columns.front().begin, compared.columns.front().end,
                                 compared.log.settings.file);
  for (std::size_t i = 0; i < compared.columns.size(); ++i)
    text += "\n" + line(compared.log.settings.columns[i], compared.columns[i]);
  return text;
}

void summarise(const ComparedLog& compared, io::Summary& summary) {
  const auto& settings = compared.log.settings;
  summary.set("measured.file", settings.file);
  summary.set("measured.time_offset", settings.offset);
  for (std::size_t i = 0; i < compared.columns.size(); ++i) {
    const auto& column = settings.columns[i];
    const auto& found = compared.columns[i];
    io::SummaryRow row;
    row.set("name", column.name)
        .set("column", column.column)
        .set("quantity", column.quantity.name)
        .set("unit", column.quantity.si)
        .set("begin", found.begin)
        .set("end", found.end)
        .set("samples", static_cast<long>(found.difference.size()))
        .set("mean_difference", found.mean)
        .set("rms_difference", found.rms)
        .set("largest_difference", found.largest);
    set("computed", found.computed, row);
    set("measured", found.measured, row);
    summary.append("measured.columns", row);
  }
}

void write(const ComparedLog& compared, io::ResultsFile& file) {
  for (std::size_t i = 0; i < compared.columns.size(); ++i) {
    const auto& column = compared.log.settings.columns[i];
    const auto& found = compared.columns[i];
    const auto& samples = found.measured.samples;
    const std::string group = "/measured/" + column.name + "/";
    const io::Shape shape{samples.time.size()};
    file.write(group + "time", samples.time, shape, "s",
               "Times of the measured samples in the window, time of the motion");
    file.write(group + "measured", samples.value, shape, column.quantity.si,
               "Measured " + lower(column.quantity.name) + ", column " + column.column);
    file.write(group + "difference", found.difference, shape, column.quantity.si,
               "Computed less measured");
    writeSpectrum(group + "computed", found.computed, column, "computed", file);
    writeSpectrum(group + "measured", found.measured, column, "measured", file);
  }
}

void stageTables(const ComparedLog& compared, io::OutputFolder& folder) {
  const auto& columns = compared.log.settings.columns;
  std::vector<io::Csv::Column> header{{"time", "s"}};
  std::map<double, std::vector<std::string>> rows;  // by time
  for (std::size_t i = 0; i < columns.size(); ++i) {
    header.push_back({columns[i].name + "_measured", columns[i].quantity.si});
    header.push_back({columns[i].name + "_computed", columns[i].quantity.si});
    const auto& found = compared.columns[i];
    const auto& samples = found.measured.samples;
    for (std::size_t k = 0; k < samples.time.size(); ++k) {
      auto& row = rows[samples.time[k]];
      row.resize(2 * columns.size());
      row[2 * i] = formatNumber(samples.value[k]);
      row[2 * i + 1] = formatNumber(samples.value[k] + found.difference[k]);
    }
  }
  io::Csv table(header);
  for (const auto& [time, cells] : rows) {
    std::vector<std::string> row{formatNumber(time)};
    row.insert(row.end(), cells.begin(), cells.end());
    table.row(row);
  }
  table.stage(folder.file("measured.csv"));
  io::Csv spectra({{"name", ""},
                   {"signal", ""},
                   {"peak", ""},
                   {"frequency", "Hz"},
                   {"amplitude", ""},
                   {"unit", ""}});
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const auto& [which, signal] : {std::pair{"computed", &compared.columns[i].computed},
                                        {"measured", &compared.columns[i].measured}})
      for (std::size_t k = 0; k < signal->peaks.size(); ++k)
        spectra.row(std::vector<std::string>{
            columns[i].name, which, std::to_string(k + 1), formatNumber(signal->peaks[k].frequency),
            formatNumber(signal->peaks[k].amplitude), columns[i].quantity.si});
  spectra.stage(folder.file("measured_peaks.csv"));
}

}  // namespace tooljoint::cases
