// What is left over of the drift inequality at a point, against the Gaussian integral for covariances between
// the two images.
#include "checker/quadrature/lock_form.hpp"

#include <doctest/doctest.h>

#include "checker/quadrature/lock_proposal.hpp"
#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Matrix;
using lock_test::Textbook;

namespace {

struct FormAt {
  SquareMatrix<lock_form::kSize> matrix;
  double walk_loss = 0.0;
};

/// With l = `rest`.
FormAt form_at(const Textbook& book, const std::array<double, 4>& x, double multiplier, double rest) {
  std::array<Chord, 3> u;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = Chord(Ball(x[i]), Ball(x[i]), i, one);
  }
  const LockFilter filter = book.design.filter();
  const LockStep step = lock_step(filter, book.set, u, Ball(x[3]));
  const auto parts = lock_form::parts_of(step, book.set.metric, book.set.deviation, filter.r);
  const auto factors = lock_form::factors_of(Ball(multiplier), book.set.deviation, filter.r);
  FormAt form;
  const Ball walked = square(book.set.walk);
  const std::array<Ball, 3> t3{zero, book.set.metric.coupling, book.set.metric.frequency};
  for (std::size_t i = 0; i < lock_form::kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const Ball* factor = lock_form::factor_at(factors, i, j);
      const Ball& part = parts.value[i][j].centre;
      form.matrix[i][j] = factor != nullptr ? *factor * part : part;
      if (i == j) {
        form.matrix[i][j] += i == lock_form::kRest ? Ball(rest) : one;
      }
      if (i < 3) {
        form.matrix[i][j] -= walked * t3[i] * t3[j];
      }
    }
  }
  form.walk_loss = log(one - walked * (square(t3[1]) + square(t3[2]))).near();
  return form;
}

/// l - m'(M^-1 - Sigma)^-1 m + log det(I - Sigma M) for an image of the covariance between the two.
double textbook_left_over(const Textbook& book, const std::array<double, 4>& x, double rest,
                          const Matrix& p) {
  const lock_test::Vector e = book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]);
  const auto step = book.step(e, p);
  const lock_test::Vector e3(0.0, 0.0, 1.0);
  const double deviation = book.set.deviation.near();
  const double walk = book.set.walk.near();
  const Matrix sigma =
      deviation * deviation * step.gain * step.gain.transpose() + walk * walk * e3 * e3.transpose();
  const Matrix m = book.metric().transpose() * book.metric();
  return rest - step.mean.dot((Matrix(m.inverse()) - sigma).inverse() * step.mean) +
         std::log((Matrix::Identity() - sigma * m).determinant());
}

}  // namespace

TEST_CASE("what is left over is no more than for any covariance, and no less where there is but one") {
  const Textbook book{{}, lock_test::WrittenSet().set()};
  test::Random random(5360);
  int meaningful = 0;
  for (std::int64_t k = 0; k < test::effort(300); ++k) {
    CAPTURE(k);
    std::array<double, 4> x = lock_test::somewhere(book.set, random);
    if (k % 3 == 0) {
      x[3] = 0.0;
    }
    const double multiplier = std::exp(random.uniform(-2.0, 5.0));
    const FormAt form = form_at(book, x, multiplier, 20.0);
    const Ball found = lock_form::left_over(form.matrix);
    if (!found.finite()) {
      continue;
    }
    ++meaningful;
    CHECK(std::fabs(found.near() - lock_proposal::left_over(lock_proposal::near(form.matrix))) < 1e-9);
    const double least = found.near() + form.walk_loss;
    for (int l = 0; l < 20; ++l) {
      const double truly = textbook_left_over(book, x, 20.0, book.covariance_of_level(x[3], random));
      CHECK(least <= truly + 1e-4);
      if (x[3] == 0.0) {
        CHECK(least >= truly - 1e-4);
      }
    }
  }
  CHECK(meaningful > 60);
}

TEST_CASE("nothing is left over where a row is not definite") {
  SquareMatrix<lock_form::kSize> n;
  for (std::size_t i = 0; i < lock_form::kSize; ++i) {
    n[i][i] = two;
  }
  // log(2 * 2) + 2.
  CHECK(std::fabs(lock_form::left_over(n).near() - 2.0 - std::log(4.0)) < 1e-15);
  for (std::size_t i = 0; i < lock_form::kRest; ++i) {
    auto other = n;
    other[i][i] = Ball(-1.0);
    CHECK_FALSE(lock_form::left_over(other).finite());
    other[i][i] = zero;
    CHECK_FALSE(lock_form::left_over(other).finite());
    other[i][i] = Ball::everything();
    CHECK_FALSE(lock_form::left_over(other).finite());
  }
  n[lock_form::kRest][lock_form::kRest] = Ball(-5.0);
  CHECK_FALSE(certainly_positive(lock_form::left_over(n)));
}
