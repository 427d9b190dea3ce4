// Products of values of a loop, against the same products at single frequencies.
#include "checker/model/gain/linear_frame.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace veritrack::checker {
namespace {

/// constant + per_frequency omega.
LinearValue affine(double constant, double per_frequency) {
  LinearValue value;
  value.constant = Ball(constant);
  value.per_frequency = Ball(per_frequency);
  return value;
}

struct Ends {
  double low, high;
};

/// The base of the product of two states over a band; of the first with itself where they are the same one.
Ends base_of_product(const Ends& band, const LinearValue& x, const LinearValue& y, bool is_square) {
  LinearFrame frame(2, one, one, Ball(band.low), Ball(band.high), 2);
  const int first = frame.state(0, x);
  const int second = is_square ? first : frame.state(1, y);
  const Ball base = frame.base(frame.at(frame.product(first, second)));
  return {base.lower_double(), base.upper_double()};
}

TEST_CASE("the square of a value is no wider and no narrower than its squares at all frequencies") {
  for (const Ends& band : {Ends{1.0, 2.0}, Ends{-2.0, -1.0}, Ends{-1.0, 2.0}, Ends{-2.0, 1.0},
                           Ends{-2.0, 2.0}, Ends{0.0, 2.0}, Ends{-2.0, 0.0}}) {
    CAPTURE(band.low);
    CAPTURE(band.high);
    const Ends base = base_of_product(band, affine(0.0, 1.0), {}, true);
    const bool holds_zero = band.low <= 0.0 && 0.0 <= band.high;
    const double low = band.low * band.low;
    const double high = band.high * band.high;
    CHECK(base.low == doctest::Approx(holds_zero ? 0.0 : std::min(low, high)));
    CHECK(base.high == doctest::Approx(std::max(low, high)));
  }
}

TEST_CASE("the product of two values contains their products at all frequencies") {
  for (const Ends& band : {Ends{1.0, 2.0}, Ends{-2.0, -1.0}, Ends{-1.0, 2.0}, Ends{-2.0, 1.0}}) {
    for (const double constant : {-3.0, 0.0, 0.5, 3.0}) {
      for (const double slope : {-2.0, 0.0, 1.0}) {
        const Ends base = base_of_product(band, affine(0.0, 1.0), affine(constant, slope), false);
        constexpr int kSteps = 64;
        for (int i = 0; i <= kSteps; ++i) {
          const double omega = band.low + (band.high - band.low) * i / kSteps;
          const double product = omega * (constant + slope * omega);
          CHECK(base.low <= product);
          CHECK(product <= base.high);
        }
      }
    }
  }
}

}  // namespace
}  // namespace veritrack::checker
