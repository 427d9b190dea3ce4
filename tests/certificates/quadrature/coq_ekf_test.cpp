#include "certificates/quadrature/coq_ekf.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/formal_proof.hpp"
#include "certificates/document/markdown_formal_proofs.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "tests/certificates/test_design.hpp"

namespace veritrack::certificates {
namespace {

using Replacements = std::vector<std::pair<std::string, std::string>>;

FormalProofs guarantee(const Replacements& replacements) {
  const Design design = test::design(replacements);
  const QuadratureEkfTables& tables = quadrature_tables(design);
  const StartCovarianceText start = [&] {
    const rigor::NearestRounding nearest;
    return start_covariance_text(tables);
  }();
  const rigor::UpwardRounding upward;
  return coq::guarantee_proofs(tables, start).finished();
}

bool states(const FormalProofs& proofs, const std::string& lemma) {
  return std::any_of(proofs.proofs.begin(), proofs.proofs.end(),
                     [&](const FormalProof& proof) { return proof.lemma == lemma; });
}

bool says(const FormalProofs& proofs, const std::string& text) {
  return proofs.text.find(text) != std::string::npos;
}

TEST_CASE("the theorem says in decimals what the design file assumes") {
  const FormalProofs proofs = guarantee({{"slew = 0.0", "slew = 2e-4"}});
  CHECK(proofs.left_out.empty());
  for (const char* lemma : {"frequency_error_for_ever", "frequency_error_in_the_long_run",
                            "steady_state_is_covered", "frequency_error_from_the_steady_state"}) {
    CHECK(states(proofs, lemma));
  }
  CHECK(says(proofs, "q1 := 0.0023; q2 := 0.0023; r := 0.05"));
  CHECK(says(proofs, "v1 k ^ 2 + v2 k ^ 2 <= 0.001 ^ 2"));
  CHECK(says(proofs, "Rabs (omega (S k) - omega k) <= 0.0002)"));
  CHECK(says(proofs, "Rabs a <= 0.005 -> Rabs psi <= 0.005 -> Rabs nu <= 0.005"));
  CHECK(says(proofs, "below (multiple 0.99 lowest_start) m -> below m (multiple 1.01 highest_start)"));
}

TEST_CASE("of P(0|0) it assumes what the design file states") {
  const std::string given = "initial_covariance = [[0.0096, 0, 0], [0, 0.025, 0.0076], [0, 0.0076, 0.0076]]";
  const FormalProofs matrix = guarantee({{"slew = 0.0", "slew = 0.0\n" + given}});
  CHECK(states(matrix, "frequency_error_for_ever"));
  CHECK(says(matrix, "lowest_start : symmetric := Symmetric 0.0096 0.0 0.0 0.025 0.0076 0.0076."));
  CHECK(says(matrix, "below (multiple 1.0 lowest_start) m -> below m (multiple 1.0 highest_start)"));
  CHECK_FALSE(states(matrix, "steady_state_is_covered"));
  const FormalProofs multiples =
      guarantee({{"slew = 0.0", "slew = 0.0\ninitial_covariance = { from = 0.95, to = 1.05 }"}});
  CHECK(says(multiples, "below (multiple 0.95 lowest_start) m -> below m (multiple 1.05 highest_start)"));
  CHECK(states(multiples, "steady_state_is_covered"));
}

TEST_CASE("where there is no theorem, file and document say why") {
  const auto check_reason = [](const Replacements& replacements, const std::string& reason) {
    CAPTURE(reason);
    const FormalProofs proofs = guarantee(replacements);
    CHECK(proofs.proofs.empty());
    REQUIRE(proofs.left_out.size() == 1);
    CHECK(proofs.left_out.front().find(reason) != std::string::npos);
    CHECK(says(proofs, "(* The theorem about the filter's recursion is not in this file: "));
    Certificate certificate;
    certificate.formal_proofs = proofs;
    CHECK(formal_proofs_section(certificate).find("*Not proved there:* The theorem") != std::string::npos);
  };
  check_reason({{"epsilon = 0.0", "epsilon = 0.01"}}, "without a leak");
  check_reason({{"amplitude = 1.0", "amplitude = 2.0"}}, "amplitude 1");
  check_reason({{"noise = 0.001", "noise = 0.05"}},
               "with noise 0.05, slew 0.0 rad/sample per sample and starts off by 0.005 in amplitude, 0.005 "
               "rad and 0.005 rad/sample; one is found when noise, slew and errors of the start are divided "
               "by 4");
  check_reason({{"initial_frequency_error = 0.005", "initial_frequency_error = 0.02"}}, "divided by");
  check_reason({{"noise = 0.001", "noise = 100"}}, "one was not found with a 64th of them either");
}

}  // namespace
}  // namespace veritrack::certificates
