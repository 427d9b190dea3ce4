#include "certificates/model/model_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::certificates {

using rigor::Interval;

Interval ModelUnits::in_hertz(const Interval& radians) const {
  return radians * assume_->sample_rate.value().value / (Interval(2.0) * rigor::pi());
}

double ModelUnits::drawn(double radians) const {
  return has_hertz() ? radians * assume_->sample_rate.value().nearest / (2.0 * std::numbers::pi) : radians;
}

std::string ModelUnits::at_most(double radians) const {
  if (!std::isfinite(radians)) {
    return "unknown";
  }
  return rigor::to_decimal(radians, 4, rigor::Direction::up) + " rad/sample" +
         (has_hertz() ? fmt::format(" ({} Hz)", rigor::upper_decimal(in_hertz(Interval(radians)))) : "");
}

std::string ModelUnits::at_least(double radians) const {
  if (!std::isfinite(radians)) {
    return "unknown";
  }
  return rigor::to_decimal(radians, 4, rigor::Direction::down) + " rad/sample" +
         (has_hertz() ? fmt::format(" ({} Hz)", rigor::lower_decimal(in_hertz(Interval(radians)))) : "");
}

std::string ModelUnits::slew(double radians) const {
  std::string text = rigor::to_decimal(radians, 4, rigor::Direction::down) + " rad/sample per sample";
  if (has_hertz()) {
    const Interval per_second = in_hertz(Interval(radians)) * assume_->sample_rate.value().value;
    text += fmt::format(" ({} Hz per second)", rigor::lower_decimal(per_second));
  }
  return text;
}

std::string outward(const Interval& range, int digits) {
  return rigor::is_finite(range) ? fmt::format("[{}, {}]", rigor::lower_decimal(range, digits),
                                               rigor::upper_decimal(range, digits))
                                 : "unknown";
}

}  // namespace veritrack::certificates
