#include "reports/recording/track_table.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <system_error>

#include "certificates/document/output_target.hpp"

namespace veritrack::reports {

namespace {

/// ",1.5", or an empty cell.
void add_cell(std::string& text, double value) {
  if (std::isfinite(value)) {
    fmt::format_to(std::back_inserter(text), ",{:.9g}", value);
  } else {
    text += ',';
  }
}

double least_of(const Spread& spread) {
  return spread.count > 0 ? spread.least : NAN;
}

double largest_of(const Spread& spread) {
  return spread.count > 0 ? spread.largest : NAN;
}

}  // namespace

std::string series_table(const TrackSeries& series, std::optional<double> sample_rate) {
  std::string text = "first_sample,last_sample,";
  text += sample_rate ? "time_s," : "";
  text +=
      "frequency_mean,frequency_min,frequency_max,deviation_mean,innovation_rms,nis_mean,nis_max,"
      "tone_share_min,state\r\n";
  for (const TrackRow& row : series.rows()) {
    fmt::format_to(std::back_inserter(text), "{},{}", row.first, row.last);
    if (sample_rate) {
      add_cell(text, static_cast<double>(row.first) / *sample_rate);
    }
    add_cell(text, row.frequency.mean());
    add_cell(text, least_of(row.frequency));
    add_cell(text, largest_of(row.frequency));
    add_cell(text, row.deviation.mean());
    add_cell(text, std::sqrt(row.innovation_squares.mean()));
    add_cell(text, row.nis.mean());
    add_cell(text, largest_of(row.nis));
    add_cell(text, least_of(row.tone_share));
    text += ',';
    text += name_of(row.worst);
    text += "\r\n";
  }
  return text;
}

SampleTable::SampleTable(const std::filesystem::path& path, int channels, std::optional<double> sample_rate)
    : path_(path), channels_(channels), sample_rate_(sample_rate) {
  if (path == "-") {
    file_.reset(::fdopen(::dup(STDOUT_FILENO), "w"));
  } else {
    const certificates::OutputTarget target = certificates::resolve_output(path);
    if (!target.as_it_is) {
      growing_ = target.file;
      growing_ += ".unfinished";
      path_ = target.file;
    }
    file_.reset(std::fopen((target.as_it_is ? target.file : growing_).c_str(), "wb"));
  }
  if (!file_) {
    growing_.clear();
    fail();
  }
  text_ = "sample,";
  text_ += sample_rate ? "time_s," : "";
  text_ += channels > 1 ? "in_phase,quadrature,frequency,deviation,innovation_in_phase,innovation_quadrature"
                        : "signal,frequency,deviation,innovation";
  text_ += ",nis,tone_share,state\r\n";
}

SampleTable::~SampleTable() {
  if (!growing_.empty()) {
    std::error_code ignored;
    std::filesystem::remove(growing_, ignored);
  }
}

void SampleTable::fail() const {
  throw certificates::OutputError(path_, std::strerror(errno));
}

void SampleTable::add(const TrackedSample& sample) {
  constexpr std::size_t kBytesKept = std::size_t{1} << 16;
  fmt::format_to(std::back_inserter(text_), "{}", sample.index);
  if (sample_rate_) {
    add_cell(text_, static_cast<double>(sample.index) / *sample_rate_);
  }
  add_cell(text_, sample.sample.is_present ? sample.sample.in_phase : NAN);
  if (channels_ > 1) {
    add_cell(text_, sample.sample.is_present ? sample.sample.quadrature : NAN);
  }
  add_cell(text_, sample.output.frequency);
  add_cell(text_, sample.output.frequency_deviation);
  add_cell(text_, sample.output.innovation[0]);
  if (channels_ > 1) {
    add_cell(text_, sample.output.innovation[1]);
  }
  add_cell(text_, sample.output.nis);
  add_cell(text_, sample.tone_share);
  text_ += ',';
  text_ += name_of(sample.state);
  text_ += "\r\n";
  if (text_.size() >= kBytesKept) {
    flush();
  }
}

void SampleTable::flush() {
  if (std::fwrite(text_.data(), 1, text_.size(), file_.get()) != text_.size()) {
    fail();
  }
  text_.clear();
}

void SampleTable::finish() {
  flush();
  if (std::fflush(file_.get()) != 0 || std::fclose(file_.release()) != 0) {
    fail();
  }
  if (!growing_.empty()) {
    std::error_code error;
    std::filesystem::rename(growing_, path_, error);
    if (error) {
      throw certificates::OutputError(path_, error.message());
    }
    growing_.clear();
  }
}

}  // namespace veritrack::reports
