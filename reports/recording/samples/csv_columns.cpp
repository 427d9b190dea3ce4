#include "reports/recording/samples/csv_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>

#include "certificates/design/nearest_key.hpp"

namespace veritrack::reports {

namespace {

constexpr std::array<std::string_view, 6> kTimes{"time", "t", "time_s", "timestamp", "seconds", "sec"};
constexpr std::array<std::string_view, 6> kInPhase{"i", "in_phase", "inphase", "re", "real", "y1"};
constexpr std::array<std::string_view, 6> kQuadrature{"q", "quadrature", "quad", "im", "imag", "y2"};

/// "In-phase [V]" as "in_phase".
std::string plain(std::string_view name) {
  std::string text;
  for (const char c : name.substr(0, name.find_first_of("[("))) {
    text += c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  text.erase(text.find_last_not_of('_') + 1);
  return text;
}

template <std::size_t Size>
std::optional<std::size_t> usual(const std::vector<std::string>& header,
                                 const std::array<std::string_view, Size>& names) {
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (std::find(names.begin(), names.end(), plain(header[i])) != names.end()) {
      return i;
    }
  }
  return std::nullopt;
}

/// The columns as a message lists them.
std::string listed(const std::vector<std::string>& header, std::size_t width) {
  return header.empty() ? fmt::format("numbers from 1 to {}", width)
                        : fmt::format("{}, or numbers from 1 to {}", fmt::join(header, ", "), width);
}

std::size_t column_called(const std::string& name, const std::vector<std::string>& header,
                          std::size_t width) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found != header.end()) {
    return static_cast<std::size_t>(found - header.begin());
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc() && end == name.data() + name.size() && number >= 1 && number <= width) {
    return number - 1;
  }
  throw ColumnError(header.empty()
                        ? fmt::format("no column {}; allowed: {}", name, listed(header, width))
                        : fmt::format("no column {}; nearest: {}; allowed: {}", name,
                                      certificates::nearest_key(name, header), listed(header, width)));
}

std::vector<std::size_t> usual_channels(const std::vector<std::string>& header, std::size_t width,
                                        std::optional<std::size_t> time) {
  const std::optional<std::size_t> in_phase = usual(header, kInPhase);
  const std::optional<std::size_t> quadrature = usual(header, kQuadrature);
  if (in_phase && quadrature) {
    return {*in_phase, *quadrature};
  }
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < width; ++i) {
    if (i != time) {
      others.push_back(i);
    }
  }
  if (others.size() != 1) {
    throw ColumnError(fmt::format(
        "{} columns beside the time, and none with the usual names; allowed: --columns with one channel, or "
        "with in phase and quadrature, of {}",
        others.size(), listed(header, width)));
  }
  return others;
}

}  // namespace

CsvPlaces choose_columns(const std::vector<std::string>& header, std::size_t width,
                         const CsvColumns& wanted) {
  CsvPlaces places;
  if (wanted.time.empty()) {
    places.time = usual(header, kTimes);
  } else if (wanted.time != "none") {
    places.time = column_called(wanted.time, header, width);
  }
  if (wanted.channels.empty()) {
    places.channels = usual_channels(header, width, places.time);
  } else {
    for (const std::string& name : wanted.channels) {
      places.channels.push_back(column_called(name, header, width));
    }
  }
  if (wanted.sample_rate) {
    places.time.reset();
  }
  return places;
}

}  // namespace veritrack::reports
