// SPDX-License-Identifier: BSD-3-Clause
#include "cases/measured/LogRecorder.hpp"

#include <algorithm>

#include "common/Error.hpp"
#include "common/Message.hpp"
#include "common/Text.hpp"

namespace tooljoint::cases {

namespace {

constexpr const char* transientGroup = "/transient/";

/// The value with this name in a record: a column of motion.csv, or a channel with one value.
const double* valueOf(const MotionRecord& record, const std::string& name) {
  const auto columns = record.columns();
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return record.row().data() + i;
  for (const auto& channel : record.channels())
    if (channel.path == transientGroup + name && channel.shape.empty()) return channel.values;
  return nullptr;
}

/// Samples of an earlier run, on all ranks.
std::vector<double> carried(const io::ResultsFile& file, const std::string& path) {
  auto values = file.carried(path);
  parallel::broadcast(values);
  return values;
}

}  // namespace

LogRecorder::LogRecorder(const MeasuredLog& log, const RestingCase& rest,
                         const model::SecondOrderModel& model, const MotionRecord& record,
                         io::ResultsFile& file)
    : log_(log), time_(carried(file, "/transient/time")) {
  for (const auto& column : log.settings.columns) {
    const auto& quantity = column.quantity;
    Source source;
    if (quantity.ofNode()) {
      const auto row = findRow(rest, model, column.dof);
      const auto found =
          std::find(model.recoveryNodes.begin(), model.recoveryNodes.end(), row.number);
      if (found == model.recoveryNodes.end())
        throw DeckError(column.dof.where +
                        " names a node whose motion the model does not recover.");
      const auto node = found - model.recoveryNodes.begin();
      source.row = node * static_cast<Eigen::Index>(model.componentNames.size()) + row.component;
      source.rates = quantity.rates;
    } else if ((source.value = valueOf(record, quantity.source)) == nullptr) {
      throw DeckError(column.dof.where + "/Quantity is " + inQuotes(quantity.name) +
                      ", which the laws of this scene do not compute. Leave the column out.");
    }
    const std::string path = "/measured/" + column.name + "/computed";
    source.series = &file.series(path, {}, quantity.si, "Computed " + lower(quantity.name));
    values_.push_back(carried(file, path));
    sources_.push_back(source);
  }
}

void LogRecorder::sample(const Sample& sample) {
  const Vector* const motions[] = {&sample.displacement, &sample.velocity, &sample.acceleration};
  time_.push_back(sample.t);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const auto& source = sources_[i];
    const double value =
        source.value != nullptr ? *source.value : (*motions[source.rates])(source.row);
    values_[i].push_back(value);
    source.series->append(&value);
  }
}

std::vector<SignalComparison> LogRecorder::compare() const {
  std::vector<SignalComparison> found;
  for (std::size_t i = 0; i < values_.size(); ++i)
    found.push_back(compareSignals({time_, values_[i]}, log_.signals[i], log_.begin, log_.end,
                                   log_.settings.spectra));
  return found;
}

}  // namespace tooljoint::cases
