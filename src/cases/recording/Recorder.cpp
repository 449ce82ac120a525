// SPDX-License-Identifier: BSD-3-Clause
#include "cases/recording/Recorder.hpp"

#include <algorithm>
#include <utility>

#include "common/Text.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::cases {

namespace {

constexpr const char* motionSeries = "/transient/motion";
/// The channel with one value per node.
constexpr const char* contactForces = "/transient/normal_force";
/// Fraction of the motion between two flushes of the results file.
constexpr double flushFraction = 0.1;

}  // namespace

Recorder::Recorder(std::unique_ptr<MotionRecord> record, const model::SecondOrderModel& model,
                   const Recorded& wanted, TimeSpan span, io::ResultsFile& file)
    : record_(std::move(record)),
      model_(model),
      file_(file),
      recovery_(model),
      time_(file.series("/transient/time", {}, "s", "Time of the samples")),
      table_(record_->columns()),
      flushInterval_(flushFraction * (span.end - span.start)),
      nextFlush_(span.start + flushInterval_) {
  const auto& output = wanted.output;
  choose(wanted.nodes);
  const std::size_t nodes = rows_.empty() ? model.recoveryNodes.size() : rows_.size();
  const io::Shape shape{nodes, model.componentNames.size()};
  const auto texts = record_->fields();
  const auto field = [&](const char* name, const FieldText& text) -> io::TimeSeries* {
    if (!output.hasField(name)) return nullptr;
    return &file.series(std::string("/transient/") + name, shape, text.unit, text.longName);
  };
  displacementSeries_ = field("displacement", texts[0]);
  velocitySeries_ = field("velocity", texts[1]);
  accelerationSeries_ = field("acceleration", texts[2]);
  for (const auto& channel : record_->channels()) {
    const bool ofNodes = channel.path == contactForces;
    channels_.push_back({&file.series(channel.path, ofNodes ? io::Shape{nodes} : channel.shape,
                                      channel.unit, channel.longName),
                         channel.values, ofNodes});
  }
  if (output.xdmf && record_->picture() != nullptr)
    pictures_ = std::make_unique<io::XdmfRecorder>(file, *record_->picture(), output.xdmfInterval);
  addTable();
}

/// Rows of the recovery of the chosen nodes, and the dataset that names them.
void Recorder::choose(const std::vector<std::int64_t>& nodes) {
  std::vector<int> numbers;
  for (std::size_t row = 0; row < model_.recoveryNodes.size(); ++row) {
    if (!std::binary_search(nodes.begin(), nodes.end(), model_.recoveryNodes[row])) continue;
    rows_.push_back(row);
    numbers.push_back(static_cast<int>(row) + 1);
  }
  if (!rows_.empty())
    file_.write("/transient/node", numbers, {numbers.size()}, "1",
                "Rows of the recorded nodes in the arrays of /model, counted from 1");
}

void Recorder::append(io::TimeSeries& series, const double* values, std::size_t width) {
  if (rows_.empty()) return series.append(values);
  chosen_.clear();
  for (const auto row : rows_)
    chosen_.insert(chosen_.end(), values + row * width, values + (row + 1) * width);
  series.append(chosen_.data());
}

/// The series of the rows of motion.csv, with the rows of an earlier run.
void Recorder::addTable() {
  const auto columns = record_->columns();
  std::vector<std::string> names, units;
  for (const auto& column : columns) {
    names.push_back(column.name);
    if (std::find(units.begin(), units.end(), column.unit) == units.end())
      units.push_back(column.unit);
  }
  tableSeries_ = &file_.series(motionSeries, {columns.size()}, join(units, ", "),
                               "Rows of motion.csv: " + join(names, ", "));
  const auto width = static_cast<std::ptrdiff_t>(columns.size());
  const auto carried = file_.carried(motionSeries);
  for (auto row = carried.begin(); row != carried.end(); row += width)
    table_.row(std::vector<double>(row, row + width));
}

void Recorder::compareWith(const MeasuredLog& log, const RestingCase& rest) {
  measured_ = std::make_unique<LogRecorder>(log, rest, model_, *record_, file_);
}

std::vector<SignalComparison> Recorder::comparisons() const {
  return measured_ ? measured_->compare() : std::vector<SignalComparison>();
}

void Recorder::sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) {
  take(recovery_.recover(t, q, qDot, qDDot));
}

void Recorder::sampleShare(const transient::SampleShare& mine) {
  if (const auto sample = recovery_.gather(mine)) take(*sample);
}

void Recorder::take(const Sample& sample) {
  const double t = sample.t;
  record_->sample(sample);
  table_.row(record_->row());
  tableSeries_->append(record_->row().data());
  time_.append(t);
  const std::size_t width = model_.componentNames.size();
  if (displacementSeries_) append(*displacementSeries_, sample.displacement.data(), width);
  if (velocitySeries_) append(*velocitySeries_, sample.velocity.data(), width);
  if (accelerationSeries_) append(*accelerationSeries_, sample.acceleration.data(), width);
  for (const auto& channel : channels_)
    channel.ofNodes ? append(*channel.series, channel.values, 1)
                    : channel.series->append(channel.values);
  if (measured_) measured_->sample(sample);
  if (pictures_ && pictures_->due(t)) pictures_->append(frame(sample));
  if (t >= nextFlush_) file_.flush();
  while (t >= nextFlush_) nextFlush_ += flushInterval_;
}

io::XdmfFrame Recorder::frame(const Sample& sample) const {
  io::XdmfFrame out;
  out.time = sample.t;
  out.displacement = sample.displacement.data();
  out.velocity = sample.velocity.data();
  record_->complete(sample.t, out);
  return out;
}

void Recorder::save(std::vector<double>& memory) const {
  record_->save(memory);
  if (pictures_) pictures_->save(memory);
}

void Recorder::restore(const double*& memory) {
  record_->restore(memory);
  // only the set of fields of a picture is needed here
  const Vector any = Vector::Zero(1);
  if (pictures_) pictures_->restore(memory, frame({0.0, any, any, any, any, any, any}));
}

void Recorder::stagePictures(io::OutputFolder& folder) const {
  if (pictures_) io::stageText(folder.file("results.xdmf"), pictures_->text("results.h5"));
}

}  // namespace tooljoint::cases
