#include "analysis/theorems/theorem_2_9_quantities.hpp"

#include <array>
#include <string_view>

namespace veritrack::theorems {

namespace {

using Constants = Theorem29Constants;

/// Whether a quantity divides by q1: directly, or through another quantity.
constexpr std::string_view kNever = "";
constexpr std::string_view kDirectly = "q_1";

struct QuantityRow {
  std::string_view name;
  std::string_view symbol;
  std::string_view formula;  // empty: it depends on the variant
  std::string_view source;
  rigor::Interval Constants::*value;
  std::string_view divides_by_q1_through;
};

constexpr std::string_view kList = "thesis, list at the end of section 3.5";
constexpr std::string_view kSectionOnBounds = "thesis, section 2.4.3";

constexpr auto kQuantityRows = std::to_array<QuantityRow>({
    {"R_x", "R_x", R"(R_x)", "thesis, (2.26) and section 3.5", &Constants::state_bound, kNever},
    {"epsilon_r", R"(\epsilon_r)", "", "", &Constants::epsilon_r, kNever},
    {"rho_1", R"(\rho_1)", R"(2(R_x + \epsilon_r))", kList, &Constants::rho_1, kNever},
    {"rho_2", R"(\rho_2)", R"(\sqrt{2}(R_x + \epsilon_r))", kList, &Constants::rho_2, kNever},
    {"rho_3", R"(\rho_3)", R"(\sqrt{2}(R_x + \epsilon_r))", kList, &Constants::rho_3, kNever},
    {"rho_4", R"(\rho_4)", R"(\sqrt{2}(R_x + \epsilon_r))", kList, &Constants::rho_4, kNever},
    {"rho_5", R"(\rho_5)", "1", kList, &Constants::rho_5, kNever},
    {"delta_1", R"(\delta_1)", "q_1", kList, &Constants::delta_1, kNever},
    {"delta_2", R"(\delta_2)", "r", kList, &Constants::delta_2, kNever},
    {"a_1", "a_1", "q_2", kList, &Constants::a_1, kNever},
    {"a_2", "a_2", "q_1", kList, &Constants::a_2, kNever},
    {"b_1", "b_1", "", "", &Constants::b_1, kNever},
    {"b_2", "b_2", "", "", &Constants::b_2, kNever},
    {"p", "p", R"(a_1 + \frac{1}{b_1})", kSectionOnBounds, &Constants::p, kNever},
    {"q", "q", R"(\frac{1}{a_2} + b_2)", kSectionOnBounds, &Constants::q, kDirectly},
    {"s", "s", R"(\frac{1}{a_2} + b_2 + \rho_1^2 \delta_1^{-1})", kSectionOnBounds, &Constants::s, kDirectly},
    {"gamma", R"(\gamma)", R"(\frac{\gamma_{\mathrm{fraction}}}{s p^2})",
     "thesis, Theorem 2.8 (the fraction is free)", &Constants::gamma, "s"},
    {"beta", R"(\beta)", R"((pq)^{1/2})", "thesis, (2.36)", &Constants::beta, "q"},
    {"one_minus_alpha", R"(1 - \alpha)", R"(1 - \left(1 - \frac{\gamma}{q}\right)^{1/2})", "thesis, (2.36)",
     &Constants::one_minus_alpha, "q"},
    {"epsilon_z", R"(\epsilon_z)",
     R"(\min\left(\epsilon_r, \frac{\sqrt{2}}{\sqrt{\rho_4}} )"
     R"(\left(-\rho_1 + \sqrt{\rho_1^2 + \frac{1}{q}\left(\frac{1}{s p^2} - \gamma\right)}\right)^{1/2}\right))",
     "thesis, (2.35)", &Constants::epsilon_z, "q"},
    {"delta_p", R"(\delta_p)", R"(2 \rho_1 \rho_2 p)", "thesis, proof of Lemma 2.3", &Constants::delta_p,
     kNever},
    {"delta_k", R"(\delta_k)", R"(\delta_p \rho_5 \delta_2^{-1} (1 + s \rho_5^2 \delta_2^{-1}))",
     "thesis, proof of Lemma 2.3", &Constants::delta_k, "s"},
    {"delta_k2", R"(\delta_{k2})",
     R"(\frac{2p(\rho_3\rho_1 + \rho_2^2)\rho_5}{\delta_2} + )"
     R"(\frac{2\delta_p^2\rho_5^3}{\delta_2^2} + )"
     R"(s\rho_5\left(\frac{2\rho_5^4\delta_p^2}{\delta_2^3} + \frac{2p(\rho_3\rho_1 + \rho_2^2)\rho_5^2}{\delta_2^2}\right))",
     "thesis, proof of Lemma 2.5 (named there, written out here)", &Constants::delta_k2, "s"},
    {"zeta_z", R"(\zeta_z)", R"(\delta_k \rho_5 \rho_1 \epsilon_z)", "thesis, (2.39)", &Constants::zeta_z,
     "delta_k"},
    {"eta", R"(\eta)",
     R"(\max\left(pq\left(\lVert w \rVert + \frac{1}{2}\rho_4\epsilon_r^2\right) + )"
     R"(p\rho_5\delta_2^{-1}\lVert v \rVert, )"
     R"(\delta_k\left(\rho_5\lVert w \rVert + \lVert v \rVert + \frac{1}{2}\rho_4\rho_5\epsilon_r^2\right) + 2pq\rho_1\right))",
     R"(thesis, (2.40), with the noise bounds c_1 sqrt(q_2) and c_2 sqrt(r) of section 3.5)", &Constants::eta,
     "q"},
    {"zeta", R"(\zeta)", R"(2\rho_1\rho_5\delta_k + \rho_1\rho_5\delta_{k2}\epsilon_r)",
     "thesis, (2.41) and (2.42)", &Constants::zeta, "delta_k"},
    {"lhs_2_43", R"(\beta(\zeta + \eta) + \alpha)", R"(\beta(\zeta + \eta) + \alpha)", "thesis, (2.43)",
     &Constants::lhs_2_43, "beta"},
    {"lhs_2_44", R"(\beta\zeta_z + \alpha)", R"(\beta\zeta_z + \alpha)", "thesis, (2.44)",
     &Constants::lhs_2_44, "beta"},
    {"initial_error_bound", R"(\epsilon_z (pq)^{-1/2})", R"(\epsilon_z (pq)^{-1/2})", "thesis, (2.45)",
     &Constants::initial_error_bound, "epsilon_z"},
});

/// The three rows that the errata sheet changes.
struct VariantText {
  std::string_view name, printed_formula, printed_source, errata_formula, errata_source;
};
constexpr auto kVariantTexts = std::to_array<VariantText>({
    {"epsilon_r", R"(\frac{1}{\sqrt{2}} - \sigma)", kList, R"(1 - \sigma)",
     "errata to page 68 leave it free in (0, 1); our choice"},
    {"b_1",
     R"(\frac{1}{2r}(1 - \sqrt{2}\epsilon_r)^2 \left(1 - \frac{1}{4}(1 - \sqrt{2}\epsilon_r)^2\right))",
     kList, R"(\frac{\sigma}{2r})", "errata to page 68"},
    {"b_2", R"(\frac{3}{r}(1 + \sqrt{2}\epsilon_r)^2)", kList, R"(\frac{5}{r})", "errata to page 68"},
});

bool may_be_zero(const rigor::Interval& x) {
  return contains(x, 0.0);
}

}  // namespace

std::optional<std::string> why_not_applicable(const std::string& name, const Theorem29Input& input) {
  if (!may_be_zero(input.q1)) {
    return std::nullopt;
  }
  for (const QuantityRow& row : kQuantityRows) {
    if (row.name != name || row.divides_by_q1_through == kNever) {
      continue;
    }
    std::string sentence = name;
    if (row.divides_by_q1_through == kDirectly) {
      sentence += " divides by a_2 = q_1, which ";
    } else {
      sentence += " depends on ";
      sentence += row.divides_by_q1_through;
      sentence += ", and so divides by a_2 = q_1, which ";
    }
    sentence += input.q1.upper() > 0.0 ? "may be 0 in this design." : "is 0 in this design.";
    return sentence;
  }
  return std::nullopt;
}

std::vector<Quantity> theorem_2_9_quantities(Theorem29Variant variant, const Theorem29Input& input,
                                             const Theorem29Constants& constants) {
  std::vector<Quantity> quantities;
  quantities.reserve(kQuantityRows.size());
  for (const QuantityRow& row : kQuantityRows) {
    Quantity quantity{std::string(row.name),   std::string(row.symbol), std::string(row.formula),
                      std::string(row.source), constants.*row.value,    std::nullopt};
    for (const VariantText& text : kVariantTexts) {
      if (text.name == row.name) {
        const bool printed = variant == Theorem29Variant::printed;
        quantity.formula = printed ? text.printed_formula : text.errata_formula;
        quantity.source = printed ? text.printed_source : text.errata_source;
      }
    }
    quantity.not_applicable = why_not_applicable(quantity.name, input);
    if (!quantity.not_applicable && !is_finite(quantity.value)) {
      quantity.not_applicable = quantity.name + " is undefined, or overflows, for the values of this design.";
    }
    if (quantity.not_applicable) {
      quantity.value = rigor::Interval::empty();
    }
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

}  // namespace veritrack::theorems
