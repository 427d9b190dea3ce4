#include "analysis/rigor/spectral_radius.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace veritrack::rigor {
namespace {

TEST_CASE("the spectral radius and its mode, of a rotation and of a triangle") {
  Eigen::Matrix3d rotation;
  rotation << 0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 0.5;
  CHECK(spectral_radius(rotation) == doctest::Approx(1.0));
  CHECK(largest_argument(rotation) == doctest::Approx(std::atan2(0.8, 0.6)));
  const DominantMode turned = dominant_mode(rotation);
  CHECK(turned.radius == doctest::Approx(1.0));
  CHECK(turned.vector[0] == doctest::Approx(turned.vector[1]));
  CHECK(turned.vector[2] == doctest::Approx(0.0));
  Eigen::Matrix2d triangle;
  triangle << 0.9, 3.0, 0.0, 0.1;
  const DominantMode mode = dominant_mode(triangle);
  CHECK(mode.radius == doctest::Approx(0.9));
  CHECK(mode.vector[1] == doctest::Approx(0.0));
}

TEST_CASE("a spectral radius of what is not square is refused") {
  CHECK_THROWS_AS(static_cast<void>(spectral_radius(Eigen::MatrixXd::Zero(2, 3))), std::length_error);
}

}  // namespace
}  // namespace veritrack::rigor
