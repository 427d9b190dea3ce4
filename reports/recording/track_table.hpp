// A run over a recording as CSV (RFC 4180).
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "reports/recording/track_series.hpp"

namespace veritrack::reports {

/// A header and a line for each row of the series. Cells without a number are empty. `sample_rate` in Hz
/// gives a column with times.
[[nodiscard]] std::string series_table(const TrackSeries& series, std::optional<double> sample_rate);

/// A line for every sample, written as it comes.
class SampleTable {
 public:
  /// A regular file grows under another name beside it until it is whole; "-" is standard output. Throws
  /// certificates::OutputError.
  SampleTable(const std::filesystem::path& path, int channels, std::optional<double> sample_rate);
  ~SampleTable();
  SampleTable(const SampleTable&) = delete;
  SampleTable& operator=(const SampleTable&) = delete;
  SampleTable(SampleTable&&) = delete;
  SampleTable& operator=(SampleTable&&) = delete;

  void add(const TrackedSample& sample);
  /// Gives the file its name. Throws certificates::OutputError when not all of it could be written.
  void finish();

 private:
  struct Closing {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };

  [[noreturn]] void fail() const;
  void flush();

  std::filesystem::path path_;
  std::filesystem::path growing_;  ///< empty when the file is written as it is
  std::unique_ptr<std::FILE, Closing> file_;
  int channels_;
  std::optional<double> sample_rate_;
  std::string text_;
};

}  // namespace veritrack::reports
