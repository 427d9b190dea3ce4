#include "reports/recording/chi_square.hpp"

#include <doctest/doctest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace veritrack::reports {
namespace {

TEST_CASE("quantiles are those of Boost.Math") {
  const boost::math::normal normal;
  for (const double deviate : {-kNormal975, kNormal975, 4.0, kNormalFive}) {
    for (const double freedom : {30.0, 64.0, 128.0, 1e3, 1e4, 1e6}) {
      const boost::math::chi_squared distribution(freedom);
      const double exact =
          deviate > 0.0
              ? boost::math::quantile(complement(distribution, cdf(complement(normal, deviate)))) / freedom
              : boost::math::quantile(distribution, cdf(normal, deviate)) / freedom;
      INFO("freedom ", freedom, ", deviate ", deviate);
      CHECK(mean_square_quantile(freedom, deviate) ==
            doctest::Approx(exact).epsilon(std::fabs(deviate) < 2.0 ? 2e-3 : 1e-2));
    }
  }
  CHECK(boost::math::cdf(normal, kNormal975) == doctest::Approx(0.975).epsilon(1e-6));
}

}  // namespace
}  // namespace veritrack::reports
