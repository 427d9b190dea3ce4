#include "certificates/design/hertz_keys.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

/// A unit that is not that of the key.
struct OtherUnit {
  std::string_view name;   ///< in the text of numbers
  std::string_view words;  ///< of its key
  Interval factor;         ///< from it to that of the key
};

/// The value in the braces, and its unit; the value itself when it has none.
struct Measured {
  TomlValue value;
  std::optional<OtherUnit> unit = std::nullopt;
};

Interval sample_rate(const TomlValue& value, std::string_view unit) {
  const std::optional<TomlValue> rate = value.elsewhere("assume", "sample_rate", kSampleRate);
  if (!rate) {
    value.refuse(fmt::format("in {}, and [assume] has no sample_rate", unit));
  }
  return rate->real(keys::positive).tight;
}

Measured measured(const TomlValue& value, std::string_view unit) {
  if (!value.is_table()) {
    return {value};
  }
  const auto fields = value.fields({unit});
  if (!fields) {
    value.refuse("a table with other keys");
  }
  if (unit == "seconds") {
    return {fields->front(), OtherUnit{" seconds", "samples", sample_rate(value, unit)}};
  }
  const Interval rate = sample_rate(value, "Hz");
  const Interval turn = Interval(2.0) * rigor::pi() / rate;
  const bool is_slew = unit == "hz_per_second";
  return {fields->front(),
          OtherUnit{is_slew ? " Hz per second" : " Hz", is_slew ? "rad/sample per sample" : "rad/sample",
                    is_slew ? Interval(turn / rate) : turn}};
}

Number read(const TomlValue& value, const std::optional<OtherUnit>& unit, RealPredicate is_allowed) {
  if (!unit) {
    return value.real(is_allowed);
  }
  Number number = value.real(keys::any_number);
  number.tight = number.tight * unit->factor;
  if (!rigor::is_finite(number.tight)) {
    value.refuse(printable(number.text, 60) + ", which is out of the range of double precision in " +
                 std::string(unit->words));
  }
  number.value = number.tight;
  number.nearest = rigor::midpoint(number.tight);
  number.text += unit->name;
  number.in_hertz = true;
  if (!is_allowed(number.value)) {
    value.refuse(fmt::format("{}, which is {} {}", printable(number.text, 80),
                             rigor::to_decimal(number.nearest, 6, rigor::Direction::up), unit->words));
  }
  return number;
}

}  // namespace

Number read_frequency(const TomlValue& value, RealPredicate is_allowed) {
  const Measured inside = measured(value, "hz");
  return read(inside.value, inside.unit, is_allowed);
}

std::array<Number, 2> read_band(const TomlValue& value, RealPredicate is_allowed) {
  const Measured inside = measured(value, "hz");
  const std::vector<TomlValue> ends = inside.value.elements(2);
  std::array<Number, 2> band{read(ends[0], inside.unit, is_allowed), read(ends[1], inside.unit, is_allowed)};
  // Two decimals within one ulp of each other pass in any order: the certificate is for the hull of the two
  // intervals.
  const bool hull_is_ordered = band[0].value.lower() <= band[1].value.upper();
  if (!hull_is_ordered) {
    value.refuse(fmt::format("[{}, {}]", printable(band[0].text, 40), printable(band[1].text, 40)));
  }
  return band;
}

Number read_slew(const TomlValue& value, RealPredicate is_allowed) {
  const Measured inside = measured(value, "hz_per_second");
  return read(inside.value, inside.unit, is_allowed);
}

Number read_time(const TomlValue& value, RealPredicate is_allowed) {
  const Measured inside = measured(value, "seconds");
  return read(inside.value, inside.unit, is_allowed);
}

bool is_one_frequency(const TomlValue& value) {
  if (!value.is_table()) {
    return value.is_number();
  }
  const auto fields = value.fields({"hz"});
  return fields && fields->front().is_number();
}

}  // namespace veritrack::certificates
