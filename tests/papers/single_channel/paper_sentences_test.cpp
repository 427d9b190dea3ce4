#include "papers/single_channel/paper_sentences.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "tests/trackers/textbook_single_channel_ekf.hpp"

namespace veritrack::single_channel {
namespace {

/// The mean frequency error of the paper's filter, Example 1 with the leak, once it has settled.
double settled_bias(double omega, double start_frequency) {
  using Vector3 = Eigen::Vector3d;
  const Vector3 q = Vector3::Constant(0.005);
  test::TextbookSingleChannelEkf<double> filter{
      q.asDiagonal(), 0.01, 0.05, Vector3(1.0, 0.0, start_frequency), Vector3::Constant(0.015).asDiagonal()};
  double sum = 0.0;
  for (int k = 1; k <= 6000; ++k) {
    filter.step(std::cos(omega * k));
    sum += k > 2000 ? filter.x(2) - omega : 0.0;
  }
  return sum / 4000.0;
}

}  // namespace

TEST_CASE("of the sentences beside proposition 1, what is about every start, time or frequency falls") {
  const std::set<std::string> refuted{
      "proposition-1/every-start",          "proposition-1/zeros/printed",
      "proposition-1/constant-sinusoid",    "proposition-1/varying-gain",
      "proposition-1/estimate-is-constant", "proposition-1/bias-grows/everywhere",
      "proposition-1/indistinguishable"};
  std::set<std::string> found;
  for (const theorems::Statement& statement : paper_sentences()) {
    CAPTURE(statement.id);
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.insert(statement.id).second);
    CHECK(statement.verdict ==
          (refuted.contains(statement.id) ? rigor::Verdict::refuted : rigor::Verdict::proved));
  }
  CHECK(found.size() == 11);
}

TEST_CASE(
    "the paper's filter: the bias grows in Example 1, falls again near pi, and a mirrored start mirrors it") {
  const double low = settled_bias(std::numbers::pi / 6.0, std::numbers::pi / 6.0);
  CHECK(low == doctest::Approx(-0.08006).epsilon(1e-3));
  CHECK(settled_bias(2.0 * std::numbers::pi / 3.0, 2.0) == doctest::Approx(-0.2483).epsilon(1e-2));
  CHECK(std::fabs(settled_bias(2.8, 2.8)) < std::fabs(settled_bias(2.6, 2.6)));
  CHECK(settled_bias(0.9, -0.9) == doctest::Approx(-1.8 - settled_bias(0.9, 0.9)).epsilon(1e-9));
}

}  // namespace veritrack::single_channel
