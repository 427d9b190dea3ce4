// The step over a box of errors against the textbook filter at points of it.
#include "checker/quadrature/lock_step.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"
#include "tests/support/oracles.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Matrix;
using lock_test::Textbook;

namespace {

std::array<Chord, 3> chords_around(const std::array<double, 3>& middle, double half_width) {
  std::array<Chord, 3> u;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = Chord(Ball(middle[i]), Ball(middle[i]) + Ball::within(Ball(half_width)), i, one);
  }
  return u;
}

/// The value lies in what the chords say of the way from the middle, and in the range.
void check_contains(const Chord& found, double value, const std::array<double, 3>& way) {
  Ball by_chords = found.centre + Ball::within(Ball(1e-11));
  for (std::size_t k = 0; k < 3; ++k) {
    by_chords += found.by[k] * Ball(way[k]);
  }
  CHECK(arb_contains(by_chords.raw(), Ball(value).raw()) != 0);
  CHECK(arb_contains((found.range + Ball::within(Ball(1e-11))).raw(), Ball(value).raw()) != 0);
}

Matrix middles_of(const Lower3<Chord>& x) {
  Matrix m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) =
          x[static_cast<std::size_t>(std::max(i, j))][static_cast<std::size_t>(std::min(i, j))].centre.near();
    }
  }
  return m;
}

}  // namespace

TEST_CASE(
    "images of the bounds, the error and the prediction are those of the textbook, everywhere in a box") {
  test::Random random(5340);
  for (std::int64_t k = 0; k < test::effort(120); ++k) {
    CAPTURE(k);
    const bool leaks = k % 2 == 1;
    Textbook book{leaks ? lock_test::leaking_variances() : lock_test::Variances(),
                  leaks ? lock_test::leaking_set() : lock_test::WrittenSet().set()};
    if (k % 4 == 3) {  // amplitude and phase depend on each other, and the frequency on neither
      for (LockCovariance* p : {&book.set.centre, &book.set.above, &book.set.below}) {
        p->p13 = p->p23 = zero;
      }
    }
    const double frequency = leaks ? random.uniform(1.4, 1.6) : 0.0;
    const std::array<double, 4> x = lock_test::somewhere(book.set, random);
    const double half_width = k % 3 == 0 ? 0.0 : random.uniform(0.0, 0.5);
    const LockStep step =
        lock_step(book.design.filter(), book.set, chords_around({x[0], x[1], x[2]}, half_width), Ball(x[3]));
    for (int l = 0; l < 10; ++l) {
      std::array<double, 3> way{};
      for (double& w : way) {
        w = half_width * random.uniform(-1.0, 1.0);
      }
      const lock_test::Vector e =
          book.metric().inverse() * lock_test::Vector(x[0] + way[0], x[1] + way[1], x[2] + way[2]);
      const auto low = book.step(e, book.low(x[3]), frequency);
      const auto high = book.step(e, book.high(x[3]), frequency);
      const double h = 1e-5;
      const Matrix low_slope =
          (book.step(e, book.low(x[3] + h)).covariance - book.step(e, book.low(x[3] - h)).covariance) /
          (2.0 * h);
      const Matrix high_slope =
          (book.step(e, book.high(x[3] + h)).covariance - book.step(e, book.high(x[3] - h)).covariance) /
          (2.0 * h);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        for (std::size_t j = 0; j <= i; ++j) {
          const auto column = static_cast<Eigen::Index>(j);
          check_contains(step.lower[i][j], low.covariance(row, column), way);
          check_contains(step.upper[i][j], high.covariance(row, column), way);
          const Chord wider_low = step.lower_slope[i][j] + Chord(Ball::within(Ball(1e-8)));
          const Chord wider_high = step.upper_slope[i][j] + Chord(Ball::within(Ball(1e-8)));
          check_contains(wider_low, low_slope(row, column), way);
          check_contains(wider_high, high_slope(row, column), way);
        }
        const Chord mean = i == 2 ? step.mean[i] + Chord(Ball::within(step.reach)) : step.mean[i];
        check_contains(mean, 0.5 * (low.mean[row] + high.mean[row]), way);
      }
      check_contains(step.prediction[0], low.prediction[0], way);
      check_contains(step.prediction[1], low.prediction[1], way);
    }
  }
}

TEST_CASE("tangents along the level bound the images from outside") {
  const Textbook book{{}, lock_test::WrittenSet().set()};
  test::Random random(5341);
  for (std::int64_t k = 0; k < test::effort(200); ++k) {
    const std::array<double, 4> x = lock_test::somewhere(book.set, random);
    const LockStep step =
        lock_step(book.design.filter(), book.set, chords_around({x[0], x[1], x[2]}, 0.0), Ball(x[3]));
    const lock_test::Vector e = book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]);
    const double s = random.uniform(0.0, 4.0);
    const Matrix above = middles_of(step.upper) + (s - x[3]) * middles_of(step.upper_slope) -
                         book.step(e, book.high(s)).covariance;
    const Matrix below = book.step(e, book.low(s)).covariance - middles_of(step.lower) -
                         (s - x[3]) * middles_of(step.lower_slope);
    CHECK(oracle::least_eigenvalue(above) >= -1e-15);
    CHECK(oracle::least_eigenvalue(below) >= -1e-15);
  }
}
