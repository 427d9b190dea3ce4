// Tubes of the repaired theorem that claim more than they may in one place: each guard of
// verified_error_bounds alone stands between them and VERIFIED.
#include "checker/theorems/error_bounds.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "tests/checker/theorems/error_bounds_support.hpp"

using namespace veritrack::checker;
using namespace veritrack::test::tube;

namespace {

bool is_verified(const WrittenBounds& tube, const Design& design = the_design()) {
  Objections objections;
  const bool verified = verified_error_bounds(read_json(R"({"evidence": [)" + evidence_of(tube, "a") + "]}"),
                                              "a", design, objections)
                            .has_value();
  CHECK(verified == objections.empty());
  return verified;
}

bool is_verified_with(const std::string& name, const std::string& number) {
  WrittenBounds tube;
  tube.numbers.at(name) = number;
  return is_verified(tube);
}

}  // namespace

TEST_CASE("the tube is verified as it stands, and with constants that say less") {
  CHECK(is_verified({}));
  CHECK(is_verified_with("one_minus_alpha", "0x1p-7"));
  CHECK(is_verified_with("curvature", "0x1p-2"));
  CHECK(is_verified_with("process_gain", "0x1p+4"));
  CHECK(is_verified_with("measurement_gain", "0x1p+2"));
  CHECK(is_verified_with("s", "0x1p-3"));
}

TEST_CASE("each constant that says more by a few per cent is refused") {
  CHECK(!is_verified_with("one_minus_alpha", "0x1.6p-6"));
  CHECK(!is_verified_with("curvature", "0x1.6p-3"));
  CHECK(!is_verified_with("process_gain", "0x1.ap+3"));
  CHECK(!is_verified_with("measurement_gain", "0x1.8p+1"));
  CHECK(!is_verified_with("s", "0x1.dp-5"));
  CHECK(!is_verified_with("plane_error", "0x1p-3"));
  CHECK(!is_verified_with("frequency_error", "0x1p-2"));
}

TEST_CASE("numbers of a tube have their sign, though the theorem knows only their squares") {
  CHECK(!is_verified_with("plane_error", "-0x1.46e2d35c182f2p-8"));
  CHECK(!is_verified_with("frequency_error", "-0x1.6a2ca93ff07adp-9"));
  CHECK(!is_verified_with("one_minus_alpha", "0x1.fd8ca918f3a4cp+0"));  // alpha is minus what it was
  CHECK(!is_verified_with("curvature", "-0x1.85104abba9a95p-3"));
  CHECK(!is_verified_with("process_gain", "-0x1.c300f1eb1aafbp+3"));
  CHECK(!is_verified_with("measurement_gain", "-0x1.9e4880005914ep+1"));
  CHECK(!is_verified_with("window", "0x1p-1"));
  CHECK(!is_verified_with("window", "-0x1p+0"));
}

TEST_CASE("matrices of a tube are symmetric, definite, and kept") {
  WrittenBounds tube;
  SUBCASE("an upper bound that is not symmetric") {
    tube.upper[2][0] = "0x1p-60";
  }
  SUBCASE("an information that is not symmetric") {
    tube.information[1][2] = "-0x1.ecd95cbbe6e27p+5";
  }
  SUBCASE("a lower bound below zero") {
    tube.information[0][0] = "-0x1p+40";
    tube.numbers.at("curvature") = "0x1p+3";
    tube.numbers.at("process_gain") = "0x1p+8";
  }
  SUBCASE("an upper bound that is not kept") {
    tube.upper[0][0] = "0x1.2p-7";
  }
  SUBCASE("a lower bound that is not kept") {
    tube.information[0][0] = "0x1.8p+6";
  }
  CHECK(!is_verified(tube));
}

TEST_CASE("amplitudes all over the tube keep the covariance, not those near 1 alone") {
  WrittenBounds tube;
  tube.numbers.at("frequency_error") = "0x1p-20";
  tube.numbers.at("one_minus_alpha") = "0x1p-20";
  tube.numbers.at("curvature") = "0x1p+3";
  tube.numbers.at("process_gain") = tube.numbers.at("s") = "0x1p+8";
  tube.numbers.at("measurement_gain") = "0x1p+2";
  tube.numbers.at("plane_error") = "0x1p-5";
  CHECK(is_verified(tube));
  tube.numbers.at("plane_error") = "0x1.8p-5";
  CHECK(!is_verified(tube));
}

TEST_CASE("an upper bound below zero is kept, and is none") {
  WrittenBounds tube;
  tube.numbers.at("curvature") = "0x1p+3";
  CHECK(is_verified(tube));
  tube.upper[0][0] = "-0x1.6p-5";
  CHECK(!is_verified(tube));
}

namespace {

Rows rows_of(const Eigen::Matrix3d& m) {
  Rows rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), "%a",
                    m(static_cast<Eigen::Index>(std::max(i, j)), static_cast<Eigen::Index>(std::min(i, j))));
      rows[i][j] = text.data();
    }
  }
  return rows;
}

/// A tube for what the filter's covariance is after `window` more updates, with an exact estimate: at most so
/// many times the largest, and at least so many times the least.
WrittenBounds after_window(int window, double most, double least) {
  const Eigen::Vector3d q(0.0023, 0.0023, 0.0023);
  const Eigen::Vector3d seen(1.0 / 0.05, 1.0 / 0.05, 0.0);
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(1, 2) = 1.0;
  const auto updated = [&](const Eigen::Matrix3d& p) {
    return Eigen::Matrix3d((p.inverse() + Eigen::Matrix3d(seen.asDiagonal())).inverse());
  };
  const auto after = [&](const Eigen::Matrix3d& p) {
    return updated(f * p * f.transpose() + Eigen::Matrix3d(q.asDiagonal()));
  };
  Eigen::Matrix3d low = updated(q.asDiagonal());
  // Nothing is known of the frequency before.
  Eigen::Matrix3d high = Eigen::Vector3d(0.05, 0.05, 1e8).asDiagonal();
  for (int k = 0; k < window; ++k) {
    low = after(low);
    high = after(high);
  }
  WrittenBounds tube;
  tube.upper = rows_of(most * high);
  tube.information = rows_of((least * low).inverse());
  tube.numbers = {{"window", window == 1 ? "0x1p+0" : "0x1p+1"},
                  {"plane_error", "0x1p-20"},
                  {"frequency_error", "0x1p-20"},
                  {"one_minus_alpha", "0x1p-20"},
                  {"curvature", "0x1p+8"},
                  {"process_gain", "0x1p+8"},
                  {"measurement_gain", "0x1.19p+2"},
                  {"s", "0x1p+8"},
                  {"radius", "0x1p-24"}};
  return tube;
}

}  // namespace

TEST_CASE("after a window the covariance is between bounds that all its values keep, and no closer ones") {
  for (const int window : {1, 2}) {
    CAPTURE(window);
    CHECK(is_verified(after_window(window, 1.1, 0.9)));
    CHECK(!is_verified(after_window(window, 0.95, 0.9)));
    CHECK(!is_verified(after_window(window, 1.1, 1.05)));
  }
}

TEST_CASE("estimates that are off need more room, above and below") {
  WrittenBounds tube;
  SUBCASE("above, in the first step") {
    tube = after_window(1, 1.0005, 0.5);
    CHECK(is_verified(tube));
    tube.numbers.at("plane_error") = "0x1p-8";
  }
  SUBCASE("above, in the steps after it") {
    tube = after_window(2, 1.003, 0.5);
    CHECK(is_verified(tube));
    tube.numbers.at("frequency_error") = "0x1p-6";
  }
  SUBCASE("below") {
    tube = after_window(1, 1.5, 0.9995);
    CHECK(is_verified(tube));
    tube.numbers.at("plane_error") = "0x1p-8";
  }
  CHECK(!is_verified(tube));
}

TEST_CASE("designs that the repaired theorem is not about") {
  Design design = the_design();
  SUBCASE("a negative leak") {
    design.epsilon = Ball(-0x1p-60);
  }
  SUBCASE("no process noise of the amplitude") {
    design.q1 = zero;
  }
  CHECK(!is_verified({}, design));
}

TEST_CASE("a tube is invariant only while its radius is inside it, and tolerates the disturbance") {
  ErrorBounds tube;
  tube.plane = Ball(0.25);
  tube.frequency = Ball(0.125);
  tube.one_minus_alpha = Ball(0.5);
  tube.curvature = Ball(1.0);
  tube.radius = Ball(0.125);
  tube.upper = diagonal(Ball(1.0), Ball(1.0), Ball(0.25));
  tube.information = diagonal(Ball(2.0), Ball(2.0), Ball(8.0));
  const Ball tolerated(0.046);  // 0.5/8 - 1/64 = 0.046875
  CHECK(tube.invariant(tolerated));
  CHECK(!tube.invariant(Ball(0.047)));
  SUBCASE("a radius that leaves the plane") {
    tube.plane = Ball(0.1);
  }
  SUBCASE("a radius that leaves the frequency") {
    tube.frequency = Ball(0.06);
  }
  SUBCASE("no radius") {
    tube.radius = Ball(-0.001);
    CHECK(!tube.invariant(Ball(-1.0)));
  }
  CHECK(!tube.invariant(tolerated));
}
