// Which columns of a CSV file hold the samples.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace veritrack::reports {

struct CsvColumns {
  /// Names of the header or numbers from 1: one channel, or in phase and quadrature. Empty: those with the
  /// usual names, or the only one that is not the time.
  std::vector<std::string> channels;
  /// Likewise, in seconds; empty: the one with a usual name, if there is one; "none": none.
  std::string time;
  std::optional<double> sample_rate;  ///< Hz, in place of times
};

/// The places of the columns, from 0.
struct CsvPlaces {
  std::vector<std::size_t> channels;
  std::optional<std::size_t> time;
};

/// Thrown when columns cannot be chosen: what() says what is allowed.
class ColumnError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `header` has the names of `width` columns, or is empty when there are none. Throws ColumnError.
[[nodiscard]] CsvPlaces choose_columns(const std::vector<std::string>& header, std::size_t width,
                                       const CsvColumns& wanted);

}  // namespace veritrack::reports
