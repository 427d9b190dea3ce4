#include "analysis/rigor/norms.hpp"

#include <doctest/doctest.h>

#include "tests/support/matrices.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

/// |A x| / |x| in extended precision: a lower bound of the norm up to 1e-17 relative.
long double stretch(const Eigen::MatrixXd& a, const Eigen::VectorXd& x) {
  const Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> wide = a.cast<long double>();
  return (wide * x.cast<long double>()).norm() / x.cast<long double>().norm();
}

void check_enclosure(const Interval& norm, double truth, double relative_width) {
  CHECK(contains(norm, truth));
  CHECK(norm.upper() <= truth * (1.0 + relative_width));
  CHECK(norm.lower() >= truth * (1.0 - relative_width));
}

}  // namespace

TEST_CASE("norms that are known exactly: products with Hadamard matrices") {
  Random random(400);
  for (std::int64_t round = 0; round < effort(300); ++round) {
    const Eigen::Index size = Eigen::Index{1} << (1 + random.below(4));
    const Eigen::MatrixXd h = hadamard(size);
    const Eigen::VectorXd d = random_integers(random, size, 1, 1 + static_cast<int>(random.below(1000)));
    const double truth = static_cast<double>(size) * d.cwiseAbs().maxCoeff();
    const Eigen::MatrixXd a = h * d.asDiagonal() * h;
    if (truth > 0.0) {
      check_enclosure(spectral_norm(to_interval(a)), truth, 1e-13);
    }
    // Singular values sqrt(size) |d_i|, and a rectangular matrix with a multiple singular value.
    const Eigen::Index rows = 1 + static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(size)));
    const Interval root = spectral_norm(to_interval(Eigen::MatrixXd(h.topRows(rows))));
    const UpwardRounding upward;
    CHECK(contains(square(root), static_cast<double>(size)));
    CHECK(root.upper() <= root.lower() * (1.0 + 1e-13));
  }
}

TEST_CASE("norms that are known exactly: rank one, zero, one entry") {
  const Eigen::Vector2d u(3.0, 4.0);
  const Eigen::Vector3d v(2.0, -3.0, 6.0);
  check_enclosure(spectral_norm(to_interval(Eigen::Matrix<double, 2, 3>(u * v.transpose()))), 35.0, 1e-14);
  check_enclosure(spectral_norm(to_interval(Eigen::Matrix<double, 3, 2>(v * u.transpose()))), 35.0, 1e-14);
  check_enclosure(spectral_norm(to_interval(v)), 7.0, 1e-14);
  check_enclosure(spectral_norm(to_interval(v.transpose())), 7.0, 1e-14);
  CHECK(norm_upper_bound(to_interval(Matrix<3, 2>::Zero().eval())) == 0.0);
  IntervalMatrix<1> one;
  one << Interval::from_bounds(-3.0, 2.0);
  CHECK(norm_upper_bound(one) >= 3.0);
  CHECK(norm_upper_bound(one) <= 3.0 * (1 + 1e-14));
  CHECK(spectral_norm(one).lower() <= 0.0);
}

TEST_CASE("2 x 2 norms by the closed formula") {
  Random random(401);
  for (std::int64_t round = 0; round < effort(2000); ++round) {
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(40)) - 20);
    Matrix<2> a;
    for (Eigen::Index i = 0; i < 4; ++i) {
      a(i) = random.uniform(-1.0, 1.0) * (random.below(3) == 0 ? scale : 1.0);
    }
    const long double trace = a.cast<long double>().squaredNorm();
    const long double determinant =
        static_cast<long double>(a(0)) * a(3) - static_cast<long double>(a(1)) * a(2);
    const long double root = std::sqrt((trace - 2 * determinant) * (trace + 2 * determinant));
    const long double truth = std::sqrt((trace + root) / 2);
    const Interval norm = spectral_norm(to_interval(a));
    CHECK(static_cast<long double>(norm.upper()) >= truth * (1.0L - 1e-17L));
    CHECK(static_cast<long double>(norm.lower()) <= truth * (1.0L + 1e-17L));
    CHECK(static_cast<long double>(norm.upper()) <= truth * (1.0L + 1e-13L));
    CHECK(static_cast<long double>(norm.lower()) >= truth * (1.0L - 1e-13L));
  }
}

TEST_CASE("the bound of a box holds for its vertices, and is no worse than |mid| + |rad|") {
  Random random(402);
  for (std::int64_t round = 0; round < effort(300); ++round) {
    const auto rows = static_cast<Eigen::Index>(1 + random.below(9));
    const auto columns = static_cast<Eigen::Index>(1 + random.below(9));
    const Eigen::MatrixXd center = random_integers(random, rows, columns, 10);
    const double reach = std::ldexp(8.0, -static_cast<int>(random.below(30)));
    const DynamicIntervalMatrix box = box_around(random, center, reach);
    const Interval norm = spectral_norm(box);
    REQUIRE(is_finite(norm));
    for (int sample = 0; sample < 8; ++sample) {
      const Eigen::MatrixXd vertex = random_vertex(random, box, false);
      Eigen::VectorXd x = Eigen::VectorXd::Ones(columns);
      for (int step = 0; step < 30; ++step) {
        x = (vertex.transpose() * (vertex * x) + 1e-9 * x).normalized();
      }
      CHECK(static_cast<long double>(norm.upper()) >= stretch(vertex, x) * (1.0L - 1e-17L));
    }
    CHECK(norm.upper() <= *norm_upper_bound(to_interval(center)) + 1e-12 +
                              reach * std::sqrt(static_cast<double>(rows * columns)) * (1 + 1e-12));
  }
}

TEST_CASE("boxes whose largest norm is known") {
  // Non-negative centre and radius: the largest norm is that of the upper ends.
  const DynamicIntervalMatrix box = DynamicIntervalMatrix::Constant(3, 3, Interval::from_bounds(0.5, 1.5));
  check_enclosure(Interval(*norm_upper_bound(box)), 4.5, 1e-12);
  CHECK(spectral_norm(box).lower() <= 1.5);
  CHECK(spectral_norm(box).lower() >= 1.5 * (1 - 1e-12));
}

TEST_CASE("neither overflow nor underflow") {
  Random random(403);
  const Eigen::MatrixXd a = hadamard(4) * Eigen::Vector4d(1, 5, 2, 3).asDiagonal() * hadamard(4);
  for (const int exponent : {-1000, -900, -300, 300, 900, 1000}) {
    const double scale = std::ldexp(1.0, exponent);
    check_enclosure(spectral_norm(to_interval(Eigen::MatrixXd(a * scale))), 20.0 * scale, 1e-13);
  }
  const Interval denormal = spectral_norm(to_interval(Eigen::MatrixXd(a * 0x1p-1060)));
  CHECK(contains(denormal, 20.0 * 0x1p-1060));
  CHECK(denormal.upper() <= 20.5 * 0x1p-1060);
  const Eigen::MatrixXd largest = Eigen::MatrixXd::Constant(2, 2, std::numeric_limits<double>::max());
  CHECK_FALSE(norm_upper_bound(to_interval(largest)));
}

TEST_CASE("nothing for what is not finite") {
  for (const Interval& poison : kPoison) {
    IntervalMatrix<3> a = IntervalMatrix<3>::Identity();
    CHECK(norm_upper_bound(a));
    a(1, 2) = poison;
    CHECK_FALSE(norm_upper_bound(a));
    CHECK(is_empty(spectral_norm(a)));
  }
  CHECK_FALSE(norm_upper_bound(DynamicIntervalMatrix(0, 0)));
  CHECK_FALSE(rounding_is_upward());
}

TEST_CASE("bounds on matrices of bounded entries") {
  const UpwardRounding upward;
  DynamicMatrix bounds(2, 2);
  bounds << 0, 1, 1, 0;
  CHECK(*detail::norm_of_bounded_symmetric(bounds) == 1.0);
  bounds << 1, 2, 2, 4;
  CHECK(*detail::norm_of_bounded_symmetric(bounds) >= 5.0);
  CHECK(*detail::norm_of_bounded_symmetric(bounds) <= 5.0 * (1 + 1e-6));
  CHECK(*detail::norm_of_bounded(bounds) >= 5.0);
  bounds(0, 0) = -1.0;
  CHECK_FALSE(detail::norm_of_bounded_symmetric(bounds));
  CHECK_FALSE(detail::norm_of_bounded(bounds));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    bounds(0, 0) = bad;
    CHECK_FALSE(detail::norm_of_bounded_symmetric(bounds));
    CHECK_FALSE(detail::norm_of_bounded(bounds));
  }
}

TEST_CASE("the bound through vectors holds for any vectors, not only for orthonormal ones") {
  Random random(404);
  const UpwardRounding upward;
  std::int64_t bounded = 0;
  for (std::int64_t round = 0; round < effort(200); ++round) {
    const Eigen::MatrixXd a = hadamard(4) * random_integers(random, 4, 1, 50).asDiagonal() * hadamard(4);
    const double truth = *norm_upper_bound(to_interval(a)) * (1.0 - 1e-12);
    Eigen::MatrixXd v = hadamard(4) / 2.0;
    v += random_integers(random, 4, 4, 10) * (random.uniform() / 80.0);
    v *= random.uniform(0.5, 1.1);
    if (const std::optional<double> bound = detail::norm_through_vectors(to_interval(a), to_interval(v))) {
      ++bounded;
      CHECK(*bound >= truth);
    }
  }
  CHECK(bounded > effort(40));
  // A projection is blind to what it cuts off, and proves nothing.
  Eigen::MatrixXd blind = Eigen::MatrixXd::Identity(4, 4);
  blind(3, 3) = 0.0;
  CHECK_FALSE(detail::norm_through_vectors(to_interval(hadamard(4)), to_interval(blind)));
}
