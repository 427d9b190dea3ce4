// Levels of the images over a box against the level of the textbook's image at points of it.
#include "checker/quadrature/lock_level.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Textbook;

TEST_CASE("the levels at the corners bound those of all images in between, and not by much") {
  const Textbook book{{}, lock_test::WrittenSet().set()};
  const LockLevels levels(book.set, book.set.metric);
  test::Random random(5370);
  for (const double half_width : {0.3, 0.05}) {
    double least = 1e9;
    double most = 0.0;
    for (std::int64_t k = 0; k < test::effort(40); ++k) {
      std::array<double, 4> x = lock_test::somewhere(book.set, random);
      x[3] += half_width;
      std::array<double, 4> low{};
      std::array<double, 4> high{};
      for (std::size_t i = 0; i < 4; ++i) {
        low[i] = x[i] - half_width;
        high[i] = x[i] + half_width;
      }
      const LockBox box(low, high);
      const LockStep step = lock_step(book.design.filter(), book.set, box.u, box.level);
      std::array<Ball, kLockCorners> found;
      REQUIRE(levels.find(box, step, found));
      CHECK(
          std::fabs(
              levels.near_middle(step) -
              std::max(book.level_of(book.step(book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]),
                                               book.low(x[3]))
                                         .covariance),
                       book.level_of(book.step(book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]),
                                               book.high(x[3]))
                                         .covariance))) < 1e-6);
      for (int l = 0; l < 20; ++l) {
        std::array<double, 4> share{};
        for (double& s : share) {
          s = random.uniform(0.0, 1.0);
        }
        double t = 0.0;
        for (std::size_t corner = 0; corner < kLockCorners; ++corner) {
          double weight = 1.0;
          for (std::size_t i = 0; i < 4; ++i) {
            weight *= ((corner >> i) & 1U) != 0U ? share[i] : 1.0 - share[i];
          }
          t += weight * found[corner].near();
        }
        std::array<double, 4> y{};
        for (std::size_t i = 0; i < 4; ++i) {
          y[i] = low[i] + share[i] * (high[i] - low[i]);
        }
        const lock_test::Vector e = book.metric().inverse() * lock_test::Vector(y[0], y[1], y[2]);
        for (const auto& p : {book.low(y[3]), book.high(y[3]), book.covariance_of_level(y[3], random)}) {
          const double truly = book.level_of(book.step(e, p).covariance);
          CHECK(truly <= t);
          least = std::min(least, t - truly);
        }
        most = std::max(most, t - std::max(book.level_of(book.step(e, book.low(y[3])).covariance),
                                           book.level_of(book.step(e, book.high(y[3])).covariance)));
      }
    }
    MESSAGE("half width " << half_width << ": at least " << least << ", at most " << most << " too high");
    CHECK(most < 10.0 * half_width * half_width + 0.1);
  }
}
