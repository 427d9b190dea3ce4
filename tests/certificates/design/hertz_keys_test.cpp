#include "certificates/design/hertz_keys.hpp"

#include <doctest/doctest.h>

#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/quadrature/quadrature_design.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::certificates;

QuadratureEkfTables tables_with(const std::string& assume, const std::string& require = "") {
  const std::string text =
      "name = 'x'\ntracker = 'quadrature-ekf'\n[design]\nq1 = 0.01\nq2 = 0.01\nr = 0.1\nepsilon = 0\n"
      "[assume]\nnoise = 0.001\ninitial_phase_error = 0\ninitial_amplitude_error = 0\n" +
      assume + "\n[require]\n" + require;
  return quadrature_tables(read_design(text, "x.toml"));
}

/// Whether the number is this decimal (an enclosure of it, to 1 part in 10^14), which was computed by hand.
void check_is(const Number& number, const std::string& decimal, const std::string& text) {
  const rigor::UpwardRounding upward;
  const rigor::Interval exact = rigor::parse_decimal(decimal);
  CHECK(number.tight.lower() <= exact.lower());
  CHECK(exact.upper() <= number.tight.upper());
  CHECK(number.tight.upper() - number.tight.lower() <= 1e-14 * exact.upper());
  CHECK(number.value.lower() <= number.nearest);
  CHECK(number.nearest <= number.value.upper());
  CHECK(number.text == text);
}

TEST_CASE("a frequency in Hz is 2 pi f/fs rad/sample") {
  const QuadratureEkfTables tables = tables_with(
      "sample_rate = 8000\nfrequency = { hz = [300, 1200] }\nslew = { hz_per_second = 200 }\n"
      "initial_frequency_error = { hz = 5 }",
      "frequency_error_below = { hz = 50 }\nlargest_slew_at_least = { hz_per_second = 1e2 }");
  // pi = 3.14159265358979323846264338327950288...
  check_is(tables.assume.frequency[0], "0.235619449019234492884698253745962716", "300 Hz");
  check_is(tables.assume.frequency[1], "0.942477796076937971538793014983850864", "1200 Hz");
  check_is(tables.assume.slew, "0.0000196349540849362077403915211454968930", "200 Hz per second");
  check_is(tables.assume.initial_frequency_error, "0.00392699081698724154807830422909937861", "5 Hz");
  check_is(tables.require.frequency_error_below.value(), "0.0392699081698724154807830422909937861", "50 Hz");
  check_is(tables.require.largest_slew_at_least.value(), "0.00000981747704246810387019576057274844",
           "1e2 Hz per second");
  CHECK(tables.assume.slew.in_hertz);
}

TEST_CASE("with a sample rate numbers without a unit are in rad/sample as ever") {
  const QuadratureEkfTables tables =
      tables_with("sample_rate = 8000\nfrequency = [0.25, 0.5]\ninitial_frequency_error = 0.125");
  CHECK(tables.assume.frequency[0].nearest == 0.25);
  CHECK(tables.assume.initial_frequency_error.text == "0.125");
  CHECK_FALSE(tables.assume.initial_frequency_error.in_hertz);
}

TEST_CASE("the same digits in two units are two numbers") {
  const QuadratureEkfTables tables =
      tables_with("sample_rate = 8000\nfrequency = [0.25, 0.5]\ninitial_frequency_error = { hz = 0.125 }",
                  "frequency_error_below = 0.125");
  CHECK_FALSE(
      same_number(tables.assume.initial_frequency_error, tables.require.frequency_error_below.value()));
}

TEST_CASE("0 Hz is exactly 0") {
  const QuadratureEkfTables tables =
      tables_with("sample_rate = 8000\nfrequency = { hz = [0, 10] }\ninitial_frequency_error = { hz = 0.0 }");
  CHECK(tables.assume.frequency[0].value == rigor::Interval(0.0));
  CHECK(tables.assume.initial_frequency_error.value == rigor::Interval(0.0));
}

}  // namespace
