#include "analysis/quadrature/falsifier/sampled_limit.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include <cmath>

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/contraction/set_search.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

sets::ContractionQuestion question_of(const trackers::ToneModel<double>& d) {
  sets::ContractionQuestion question;
  question.design = {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)};
  question.noise = Interval(0.001);
  question.search_evaluations = 10;
  return question;
}

TEST_CASE("the limit lies beyond the certified radius, and random starts find no step out before it") {
  test::Random random(92);
  for (const auto& design : {trackers::ToneModel<double>{0.0013, 0.0013, 0.01, 0.0},
                             trackers::ToneModel<double>{0.01, 0.001, 0.1, 0.0}}) {
    const auto found = find_set(question_of(design), Objective::start_error);
    REQUIRE(found.has_value());
    const CertifiedSet& set = found->set;
    const double limit = sampled_radius_limit(set, design);
    CHECK(limit > set.radius);
    CHECK(limit < 10.0 * set.radius);
    CHECK(limit == sampled_radius_limit(set, design));
    const rigor::Matrix<3> root = oracle::cholesky_factor(set.covariance_upper - set.covariance_lower);
    for (std::int64_t k = 0; k < test::effort(20000); ++k) {
      const rigor::Vector<3> e =
          set.metric.inverse() *
          rigor::Vector<3>(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized() *
          (0.98 * limit);
      const rigor::Vector<3> u =
          rigor::Vector<3>(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
      const rigor::Matrix<3> p = set.covariance_lower + root * (u * u.transpose()) * root.transpose();
      const double angle = random.uniform(-3.15, 3.15);
      const auto next = trackers::polar_frame_map<double>(
          {{e[0], e[1], e[2]}, trackers::PolarCovariance<double>::from_matrix(p)},
          {set.noise * std::cos(angle), set.noise * std::sin(angle), 0.0, 0.0}, design);
      const rigor::Vector<3> image(next.error.amplitude, next.error.phase, next.error.frequency);
      CHECK((set.metric * image).norm() <= limit);
    }
  }
}

TEST_CASE("what is sampled is marked so in the certificate") {
  sets::ContractionQuestion question = question_of({0.0023, 0.0023, 0.05, 0.0});
  question.initial_frequency_error = Interval(0.005);
  const ContractionCertificate found = certify_contraction(question);
  for (const char* name : {"frequency_error_radius_sampled_limit", "frequency_error_radius_share_of_limit",
                           "frequency_error_bound_tightness", "ultimate_frequency_error_tightness"}) {
    const theorems::Quantity& quantity = theorems::find_quantity(found.derivation, name);
    CHECK_FALSE(quantity.is_proved());
    CHECK(quantity.value.lower() > 0.0);
  }
  CHECK(theorems::find_quantity(found.derivation, "frequency_error_radius").is_proved());
  CHECK(theorems::find_quantity(found.derivation, "frequency_error_radius_share_of_limit").value.upper() <
        1.0);
  CHECK(theorems::find_quantity(found.derivation, "ultimate_frequency_error_tightness").value.upper() <= 1.0);
}

}  // namespace
}  // namespace veritrack::quadrature
