#include "certificates/quadrature/comparison_table.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "certificates/quadrature/simulated_limits.hpp"
#include "certificates/quadrature/theorem_claims.hpp"
#include "tests/certificates/test_design.hpp"

namespace {

using namespace veritrack;
using certificates::ComparedResult;

const ComparedResult& find_row(const certificates::Certificate& certificate, const std::string& result) {
  const auto& rows = certificates::quadrature_particulars(certificate).comparison;
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const ComparedResult& row) { return row.result == result; });
  REQUIRE(found != rows.end());
  return *found;
}

TEST_CASE("every result stands in the table, and what is certified is within what simulation tolerates") {
  const certificates::Certificate certificate = test::certificate();
  const ComparedResult& simulated = find_row(certificate, "simulation");
  CHECK(simulated.simulated);
  CHECK_FALSE(simulated.verdict.has_value());
  for (const char* result : {"theorem-2.9/printed", "theorem-2.9/errata"}) {
    CHECK_FALSE(find_row(certificate, result).frequency_error.has_value());
    CHECK(find_row(certificate, result).verdict == rigor::Verdict::refuted);
  }
  for (const char* result : {"theorem-2.9/repaired", "contraction"}) {
    const ComparedResult& row = find_row(certificate, result);
    REQUIRE(row.frequency_error.has_value());
    REQUIRE(row.noise.has_value());
    REQUIRE(row.rate.has_value());
    CHECK(row.frequency_error->lower() > 0.0);
    CHECK(row.frequency_error->lower() < simulated.frequency_error->lower());
    CHECK(row.noise->lower() < simulated.noise->lower());
    CHECK(row.rate->upper() < 1.0);
    CHECK(row.rate->upper() > simulated.rate->lower());
  }
  const std::string text = certificates::comparison_section(certificate, certificates::ComparedResults::all);
  CHECK(text.find("simulation, no proof") != std::string::npos);
  CHECK(text.find("≈") != std::string::npos);

  // The places of the proof, a row each, whatever the readings.
  const std::string proof = certificates::proof_section(certificate);
  for (const char* place : {"| `b_1` |", "| `past-errors` |", "| `decomposition` |"}) {
    CHECK_MESSAGE(proof.find(place) != std::string::npos, place);
  }
  CHECK(proof.find("*printed*: yes; *errata*: no") != std::string::npos);
}

TEST_CASE("the feasibility of each reading stands in its derivation") {
  const certificates::Certificate certificate = test::certificate({{"q1 = 0.0023", "q1 = 0"}});
  for (const theorems::Derivation& derivation : certificates::derivations_of(certificate, "theorem-2.9/")) {
    REQUIRE(derivation.feasibility.has_value());
    CHECK(derivation.feasibility->verdict == rigor::Verdict::refuted);
  }
}

TEST_CASE("the simulated limits are those of the tracker, at any amplitude") {
  const certificates::SimulatedLimits unit = certificates::find_simulated_limits(test::design());
  CHECK(unit.frequency_error > 0.5);
  CHECK(unit.noise > 0.1);
  CHECK(unit.rate > 0.3);
  CHECK(unit.rate < 1.0);
  const certificates::SimulatedLimits same = certificates::find_simulated_limits(test::design(
      {{"amplitude = 1.0", "amplitude = 2.0"}, {"q1 = 0.0023", "q1 = 0.0092"}, {"r = 0.05", "r = 0.2"}}));
  CHECK(same.noise == doctest::Approx(unit.noise).epsilon(0.02));
  CHECK(same.rate == doctest::Approx(unit.rate).epsilon(1e-6));
}

}  // namespace
