#include "analysis/quadrature/contraction/promises.hpp"

#include <doctest/doctest.h>

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// A set that errors of up to 0.1 start in.
CertifiedSet outer_set() {
  CertifiedSet set;
  set.metric = rigor::Matrix<3>::Identity();
  set.radius = 1.0;
  set.covariance_lower = 0.1 * rigor::Matrix<3>::Identity();
  set.covariance_upper = 0.5 * rigor::Matrix<3>::Identity();
  set.noise = 0.1;
  set.rate = 0.5;
  set.noise_gain = 2.0;
  return set;
}

/// A set with a smaller gain, which contains no covariance of the starts.
CertifiedSet inner_set() {
  CertifiedSet set = outer_set();
  set.covariance_lower = 0.05 * rigor::Matrix<3>::Identity();
  set.radius = 0.25;
  set.noise_gain = 0.5;
  return set;
}

sets::ContractionQuestion the_question(double noise) {
  sets::ContractionQuestion question;
  question.noise = Interval(noise);
  question.slew = Interval(0.0);
  question.initial_amplitude_error = question.initial_phase_error = question.initial_frequency_error =
      Interval(0.2);
  question.start_covariance = sets::StartCovariance{
      rigor::to_interval(rigor::Matrix<3>(0.3 * rigor::Matrix<3>::Identity())), Interval(1.0)};
  return question;
}

TEST_CASE("the ultimate bound of another set is promised only when the starts are led into it") {
  const rigor::UpwardRounding upward;
  const sets::ContractionQuestion question = the_question(0.05);
  const CertifiedSet outer = outer_set();
  CertifiedSet inner = inner_set();
  inner.covariance_upper = 0.51 * rigor::Matrix<3>::Identity();
  const auto ultimate = [&](const CertifiedSet& other) {
    return Promises(question, {outer, other}).ultimate_frequency_error().upper();
  };
  const double alone = Promises(question, {outer}).ultimate_frequency_error().upper();
  CHECK(Promises(question, {outer}).starts_inside());
  CHECK_FALSE(Promises(question, {inner}).starts_inside());
  CHECK(ultimate(inner) < 0.5 * alone);
  SUBCASE("not into smaller errors") {
    inner.radius = 0.1;
  }
  SUBCASE("not into other covariances") {
    inner.covariance_upper = 0.4 * rigor::Matrix<3>::Identity();
  }
  CHECK(ultimate(inner) == alone);
}

TEST_CASE("without noise nothing settles within twice the ultimate bound") {
  const rigor::UpwardRounding upward;
  const Promises promises(the_question(0.0), {outer_set()});
  CHECK(promises.starts_inside());
  CHECK_FALSE(promises.settling().has_value());
  CHECK(Promises(the_question(0.05), {outer_set()}).settling().has_value());
}

TEST_CASE(
    "what counts as settled is what is asked for, where a set gives it, and else twice the ultimate bound") {
  const rigor::UpwardRounding upward;
  sets::ContractionQuestion question = the_question(0.05);
  const auto settling = [&] { return Promises(question, {outer_set()}).settling().value(); };
  const double ultimate = Promises(question, {outer_set()}).ultimate_frequency_error().upper();
  CHECK(settling().frequency_error.upper() == doctest::Approx(2.0 * ultimate));
  question.settled_frequency_error = 1.5 * ultimate;
  CHECK(settling().frequency_error.upper() == 1.5 * ultimate);
  question.settled_frequency_error = 0.5 * ultimate;
  CHECK(settling().frequency_error.upper() == doctest::Approx(2.0 * ultimate));
}

TEST_CASE("the multiples of the start covariance are those that all sets which give bounds allow") {
  const rigor::UpwardRounding upward;
  CertifiedSet narrow = outer_set();
  narrow.covariance_lower = 0.25 * rigor::Matrix<3>::Identity();
  const auto wide = Promises(the_question(0.05), {outer_set()}).covariance_multiples().value();
  const auto both = Promises(the_question(0.05), {outer_set(), narrow}).covariance_multiples().value();
  CHECK(both.lower() == doctest::Approx(0.25 / 0.3));
  CHECK(wide.lower() < both.lower());
  CHECK(both.upper() == wide.upper());
}

}  // namespace
}  // namespace veritrack::quadrature
