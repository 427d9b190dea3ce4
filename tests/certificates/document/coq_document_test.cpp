#include "certificates/document/coq_document.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/kkl_observer/kkl_claims.hpp"
#include "analysis/kkl_observer/kkl_ell.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/frozen_observer.hpp"
#include "analysis/theorems/theorem_2_9.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/coq_parts.hpp"
#include "certificates/document/markdown_formal_proofs.hpp"
#include "certificates/document/report_json.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "tests/certificates/test_design.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::certificates {
namespace {

constexpr const char* kObserver = R"(name = "an observer"
tracker = "kkl-observer"

[design]
lambda = [1, 2.0, 3, 4]

[assume]
frequency = [0.5, 4]
amplitude = [1, 1]
)";

constexpr const char* kSingleChannel = R"(name = "a tracker"
tracker = "single-channel-ekf"

[design]
q = 0.005
r = 0.01
epsilon = 0.05
process_noise = "identity"

[assume]
frequency = [1.5, 1.5]
noise = 0
slew = 0
initial_frequency_error = 0
initial_phase_error = 0
initial_amplitude_error = 0
)";

/// As much of a certificate as the proofs need; `ell` is put into the design when it is not empty.
Certificate observer(const std::string& ell = "") {
  std::string text = kObserver;
  if (!ell.empty()) {
    text.replace(text.find("[assume]"), 0, "ell = " + ell + "\n\n");
  }
  Certificate certificate;
  certificate.design = read_design(text, "design.toml");
  const rigor::UpwardRounding upward;
  const kkl_observer::KklRange range = kkl_range(kkl_observer_tables(certificate.design));
  const auto infimum = kkl_observer::enclose_ell(range);
  certificate.derivations.push_back(kkl_observer::derive_kkl_ell(range, infimum));
  const rigor::Interval proved = find_quantity(certificate.derivations.front(), "ell").value;
  certificate.derivations.push_back(kkl_observer::derive_kkl_claims(
      {{range.lambda.begin(), range.lambda.end()},
       range.frequency,
       rigor::Interval(1.0),
       ell.empty() ? rigor::Interval(proved.lower()) : rigor::parse_decimal(ell),
       infimum.value()}));
  return certificate;
}

Certificate quadrature() {
  Certificate certificate;
  certificate.design = test::design();
  const rigor::UpwardRounding upward;
  theorems::Theorem29Input input;
  input.q1 = input.q2 = rigor::parse_decimal("0.0023");
  input.r = rigor::parse_decimal("0.05");
  input.epsilon = rigor::Interval(0.0);
  const Theorem29Parameters& free = quadrature_tables(certificate.design).theorem_2_9;
  input.state_bound = free.state_bound.value;
  input.sigma = free.sigma.value;
  input.gamma_fraction = free.gamma_fraction.value;
  input.c1 = free.c1.value;
  input.c2 = free.c2.value;
  const rigor::Interval error = rigor::parse_decimal("0.005");
  input.initial_error = theorems::largest_initial_error(rigor::Interval(1.0), error, error, error);
  for (const auto variant : {theorems::Theorem29Variant::printed, theorems::Theorem29Variant::errata}) {
    certificate.derivations.push_back(evaluate_theorem_2_9(variant, input).derivation);
  }
  return certificate;
}

Certificate single_channel() {
  Certificate certificate;
  certificate.design = read_design(kSingleChannel, "design.toml");
  const rigor::UpwardRounding upward;
  certificate.derivations.push_back(
      veritrack::single_channel::transfer_function({0.7740801898646854, -0.078722685321154922, 1.5}));
  return certificate;
}

/// What the text says of the design, after what it says of all designs.
std::string about_the_design(const FormalProofs& proofs, std::string_view for_all_designs) {
  REQUIRE(proofs.text.starts_with(for_all_designs));
  return proofs.text.substr(for_all_designs.size());
}

void check_golden_proofs(const FormalProofs& proofs, std::string_view for_all_designs,
                         const std::string& name) {
  test::check_golden(about_the_design(proofs, for_all_designs),
                     std::string(VERITRACK_SOURCE_DIR) + "/tests/certificates/golden/" + name);
}

TEST_CASE("the proofs of a design of each kind") {
  check_golden_proofs(coq_proofs(observer()), coq::text_for_all_designs("kkl_observer"), "kkl-observer.v");
  check_golden_proofs(coq_proofs(quadrature()), coq::text_for_all_designs("theorem_2_9"), "theorem-2.9.v");
  check_golden_proofs(coq_proofs(single_channel()), coq::text_for_all_designs("proposition_1"),
                      "proposition-1.v");
}

TEST_CASE("an ell that is too large: a signal that gamma does not give back") {
  const FormalProofs proofs = coq_proofs(observer("5"));
  CHECK(proofs.text.find("Lemma gamma_does_not_invert_T") != std::string::npos);
  CHECK(proofs.text.find("Lemma gamma_inverts_T") == std::string::npos);
}

TEST_CASE("what is listed stands in the text, and what is proved of the design is listed") {
  for (const Certificate& certificate : {observer(), quadrature(), single_channel()}) {
    const FormalProofs proofs = coq_proofs(certificate);
    for (const FormalProof& proof : proofs.proofs) {
      CAPTURE(proof.lemma);
      const bool stated = proofs.text.find("Lemma " + proof.lemma + " :") != std::string::npos ||
                          proofs.text.find("Theorem " + proof.lemma + " :") != std::string::npos;
      CHECK(stated);
    }
    CHECK(proofs.text.find("Admitted") == std::string::npos);
    CHECK(proofs.text.find("Axiom") == std::string::npos);
    CHECK(proofs.text.ends_with("Print Assumptions proved_here.\n"));
  }
}

TEST_CASE("a certificate says what a proof assistant can check only when it was asked") {
  Certificate certificate = single_channel();
  CHECK(formal_proofs_section(certificate).empty());
  CHECK_FALSE(nlohmann::json::parse(to_report_json(certificate)).contains("formal_proofs"));
  certificate.formal_proofs = coq_proofs(certificate);
  const std::string section = formal_proofs_section(certificate);
  CHECK(section.find("`certificate.v`") != std::string::npos);
  CHECK(section.find("| `poles` |") != std::string::npos);
  const auto json = nlohmann::json::parse(to_report_json(certificate)).at("formal_proofs");
  CHECK(json.at("file") == "certificate.v");
  CHECK(json.at("proofs").size() == certificate.formal_proofs->proofs.size());
}

}  // namespace
}  // namespace veritrack::certificates
