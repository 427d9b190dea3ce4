#include "certificates/tuning/design_values.hpp"

#include <fmt/format.h>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::certificates {

Number number_of(const std::string& decimal) {
  Number number;
  number.text = decimal;
  number.tight = number.value = rigor::parse_decimal(decimal);
  number.nearest = rigor::nearest_double(decimal);
  return number;
}

Number number_of(double value) {
  Number number = number_of(fmt::format("{}", value));  // the shortest decimal nearest to it
  return number;
}

}  // namespace veritrack::certificates
