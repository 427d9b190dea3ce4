#include "certificates/sets/counted_share.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "tests/support/binomial.hpp"

namespace veritrack::certificates {

TEST_CASE("limits of a share: those of the tables for 99 %, and the closed forms at both ends") {
  // C. J. Clopper and E. S. Pearson: 5 of 10.
  CHECK(counted_share(5, 10).low == doctest::Approx(0.1283).epsilon(1e-3));
  CHECK(counted_share(5, 10).high == doctest::Approx(0.8717).epsilon(1e-3));
  for (const int n : {1, 7, 2000}) {
    CAPTURE(n);
    const double end = std::pow(0.005, 1.0 / n);
    CHECK(counted_share(0, n).low == 0.0);
    CHECK(counted_share(0, n).high == doctest::Approx(1.0 - end).epsilon(1e-9));
    CHECK(counted_share(n, n).low == doctest::Approx(end).epsilon(1e-9));
    CHECK(counted_share(n, n).high == 1.0);
  }
}

TEST_CASE("limits of a share: those of another implementation") {
  for (const int count : {1, 3, 50, 900, 1000, 1570, 1999}) {
    CAPTURE(count);
    const CountedShare share = counted_share(count, 2000);
    const test::ConfidenceInterval expected = test::clopper_pearson(count, 2000, 0.005);
    CHECK(share.count == count);
    CHECK(share.low == doctest::Approx(expected.lower).epsilon(1e-9));
    CHECK(share.high == doctest::Approx(expected.upper).epsilon(1e-9));
    CHECK(share.low < count / 2000.0);
    CHECK(share.high > count / 2000.0);
  }
}

}  // namespace veritrack::certificates
