#include "reports/recording/samples/csv_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "certificates/design/input_error.hpp"

namespace veritrack::reports {

namespace {

constexpr std::size_t kRowsForInterval = 1024;
constexpr std::size_t kShown = 40;  // bytes of a cell in a message

bool is_missing(std::string_view text) {
  return text.empty() || (text.size() == 3 && (text == "NaN" || text == "nan" || text == "NAN")) ||
         text == "NA";
}

/// The number that the text is; none when it is none.
std::optional<double> parsed(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

CsvSource::CsvSource(const std::string& path, const CsvColumns& columns)
    : records_(path), sample_rate_(columns.sample_rate) {
  read_header(columns);
  if (places_.time) {
    find_interval();
  }
}

void CsvSource::read_header(const CsvColumns& columns) {
  if (!records_.next()) {
    throw certificates::InputError(records_.lines().name(), {},
                                   "no samples; allowed: a header and a line for each sample");
  }
  const auto fields = records_.fields();
  if (fields.front().text.starts_with("RIFF") || fields.front().text.starts_with("fLaC") ||
      fields.front().text.starts_with("OggS")) {
    records_.refuse(fields.front().position, "a sound file; allowed: CSV, or --format sound");
  }
  width_ = fields.size();
  const bool is_data = std::all_of(fields.begin(), fields.end(), [](const CsvField& field) {
    return is_missing(field.text) || parsed(field.text).has_value();
  });
  std::vector<std::string> header;
  for (const CsvField& field : fields) {
    header.emplace_back(field.text);
  }
  if (is_data) {
    header.clear();
  }
  try {
    places_ = choose_columns(header, width_, columns);
  } catch (const ColumnError& error) {
    records_.refuse(fields.front().position, error.what());
  }
  if (is_data) {
    ahead_.push_back(parse());
  }
}

std::optional<double> CsvSource::number(const CsvField& field) const {
  if (is_missing(field.text)) {
    return std::nullopt;
  }
  const std::optional<double> value = parsed(field.text);
  if (!value) {
    records_.refuse(field.position,
                    fmt::format("{}; allowed: a finite decimal, or an empty cell or NaN for a missing sample",
                                certificates::printable(field.text, kShown)));
  }
  return value;
}

CsvSource::Row CsvSource::parse() const {
  const auto fields = records_.fields();
  if (fields.size() != width_) {
    records_.refuse(fields.back().position,
                    fmt::format("{} fields; allowed: {}, as in the first record", fields.size(), width_));
  }
  Row row;
  const std::optional<double> first = number(fields[places_.channels.front()]);
  const std::optional<double> last = number(fields[places_.channels.back()]);
  row.sample.is_present = first && last;
  if (row.sample.is_present) {
    row.sample.in_phase = *first;
    row.sample.quadrature = places_.channels.size() > 1 ? *last : 0.0;
  }
  if (places_.time) {
    const CsvField& field = fields[*places_.time];
    const std::optional<double> time = number(field);
    if (!time) {
      records_.refuse(field.position, "no time; allowed: seconds, or --time none");
    }
    row.time = *time;
    row.time_position = field.position;
  }
  return row;
}

std::optional<CsvSource::Row> CsvSource::next_row() {
  if (!ahead_.empty()) {
    const Row row = ahead_.front();
    ahead_.pop_front();
    return row;
  }
  return records_.next() ? std::optional(parse()) : std::nullopt;
}

void CsvSource::find_interval() {
  while (ahead_.size() < kRowsForInterval && records_.next()) {
    ahead_.push_back(parse());
  }
  if (ahead_.size() < 2) {
    return;
  }
  std::vector<double> steps;
  for (std::size_t i = 1; i < ahead_.size(); ++i) {
    steps.push_back(ahead_[i].time - ahead_[i - 1].time);
  }
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (!(*middle > 0.0)) {
    records_.refuse(ahead_[1].time_position, "times that do not advance; allowed: seconds that grow");
  }
  // Rounded times: their mean step is closer than any one of them.
  double total = 0.0;
  double count = 0.0;
  for (const double step : steps) {
    const double whole = std::round(step / *middle);
    if (whole >= 1.0) {
      total += step;
      count += whole;
    }
  }
  interval_ = total / count;
  sample_rate_ = 1.0 / interval_;
}

std::int64_t CsvSource::missing_before(const Row& row) {
  constexpr double kTolerance = 0.25;
  constexpr double kLongestGap = 1e8;
  if (!places_.time || !last_time_) {
    last_time_ = row.time;
    return 0;
  }
  const double intervals = (row.time - *last_time_) / interval_;
  const double whole = std::round(intervals);
  const double deviation = std::fabs(intervals - whole);
  if (!(whole >= 1.0 && whole < kLongestGap && deviation <= kTolerance)) {
    records_.refuse(row.time_position,
                    fmt::format("the time advances by {:.6g} s; allowed: {:.6g} s, the interval of this "
                                "recording, or whole multiples of it (up to 1e8) where samples are missing",
                                row.time - *last_time_, interval_));
  }
  largest_deviation_ = std::max(largest_deviation_, deviation);
  last_time_ = row.time;
  return static_cast<std::int64_t>(whole) - 1;
}

std::size_t CsvSource::read(std::span<RecordedSample> block) {
  std::size_t count = 0;
  while (count < block.size()) {
    if (missing_ > 0) {
      --missing_;
      block[count++] = {0.0, 0.0, false};
      continue;
    }
    if (!next_) {
      next_ = next_row();
      if (!next_) {
        break;
      }
      missing_ = missing_before(*next_);
      if (missing_ > 0) {
        continue;
      }
    }
    block[count++] = next_->sample;
    next_.reset();
  }
  return count;
}

std::vector<std::string> CsvSource::notes() const {
  if (interval_ <= 0.0) {
    return {};
  }
  return {
      fmt::format("The times give an interval of {:.6g} s; single intervals deviate from it by up to "
                  "{:.2g} %.",
                  interval_, 100.0 * largest_deviation_)};
}

}  // namespace veritrack::reports
