// A recording as CSV: a header, a column for each channel, and perhaps one with times.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "reports/recording/samples/csv_columns.hpp"
#include "reports/recording/samples/csv_records.hpp"
#include "reports/recording/samples/sample_source.hpp"

namespace veritrack::reports {

/// Empty cells and NaN are missing samples. So are instants that the times leave out: times advance by a
/// steady interval, or by whole multiples of it, up to 1e8 (to a quarter of the interval).
class CsvSource : public SampleSource {
 public:
  /// Reads the header and the first samples. "-" is standard input. Throws certificates::InputError.
  CsvSource(const std::string& path, const CsvColumns& columns);

  [[nodiscard]] int channels() const override { return static_cast<int>(places_.channels.size()); }
  [[nodiscard]] std::optional<double> sample_rate() const override { return sample_rate_; }
  std::size_t read(std::span<RecordedSample> block) override;
  [[nodiscard]] std::optional<double> progress() const override { return records_.lines().progress(); }
  [[nodiscard]] std::vector<std::string> notes() const override;

 private:
  struct Row {
    RecordedSample sample;
    double time = 0.0;  ///< s
    certificates::Position time_position;
  };

  void read_header(const CsvColumns& columns);
  void find_interval();
  /// The next row of the file; none at its end.
  [[nodiscard]] std::optional<Row> next_row();
  [[nodiscard]] Row parse() const;
  /// The number in a field; none when it is empty or NaN.
  [[nodiscard]] std::optional<double> number(const CsvField& field) const;
  /// How many samples are missing before this row, by its time.
  [[nodiscard]] std::int64_t missing_before(const Row& row);

  CsvRecords records_;
  CsvPlaces places_;
  std::size_t width_ = 0;  ///< fields of every record
  std::optional<double> sample_rate_;
  double interval_ = 0.0;     ///< s; 0 without times
  std::deque<Row> ahead_;     ///< rows that were read to find the interval
  std::optional<Row> next_;   ///< stands behind missing samples
  std::int64_t missing_ = 0;  ///< that come before it
  std::optional<double> last_time_;
  double largest_deviation_ = 0.0;  ///< of an interval, relative
};

}  // namespace veritrack::reports
