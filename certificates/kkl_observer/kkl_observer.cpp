#include "certificates/kkl_observer/kkl_observer.hpp"

#include <fmt/format.h>

#include <limits>

#include "analysis/kkl_observer/kkl_claims.hpp"
#include "analysis/kkl_observer/kkl_ell.hpp"
#include "analysis/kkl_observer/kkl_section_v.hpp"
#include "analysis/kkl_observer/number_of_filters.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr const char* kRobustness = "kkl-robustness";
constexpr std::size_t kFilters = 4;

Interval hull_of(const std::array<Number, 2>& range) {
  return rigor::hull(range[0].value, range[1].value);
}

kkl_observer::Disturbance disturbance_of(const KklAssumptions& assume) {
  if (!assume.disturbance) {
    return kkl_observer::NoDisturbance{};
  }
  const KklDisturbance& given = *assume.disturbance;
  if (given.bound) {
    return kkl_observer::BoundedDisturbance{given.bound->value};
  }
  return kkl_observer::SinusoidalDisturbance{given.amplitude->value, given.frequency->value};
}

/// The input of the estimates, and the way they are computed.
std::string arithmetic(const KklDesignTable& design) {
  if (design.sampling_interval) {
    return fmt::format(
        "For the program in double precision, started at rest, with samples every {} s and straight lines "
        "between them, ",
        design.sampling_interval->text);
  }
  return "For filters within 1e-9 A/lambda of the exact solution from rest (A: the tone's amplitude, lambda: "
         "the filter's rate) and estimates computed from them in double precision, ";
}

/// The arithmetic, then "for every tone ..., with ..., ".
std::string hypotheses(const KklObserverTables& tables) {
  const KklAssumptions& assume = tables.assume;
  std::string text = fmt::format(
      "{}for every tone of constant frequency from {} to {} rad/s and constant amplitude from {} to {} "
      "signal "
      "units",
      arithmetic(tables.design), assume.frequency[0].text, assume.frequency[1].text, assume.amplitude[0].text,
      assume.amplitude[1].text);
  if (!assume.disturbance) {
    return text + ", without disturbance, ";
  }
  const KklDisturbance& given = *assume.disturbance;
  return given.bound
             ? fmt::format("{}, with any disturbance of at most {} signal units{}, ", text, given.bound->text,
                           tables.design.sampling_interval ? " in each sample" : "")
             : fmt::format(
                   "{}, with a sinusoidal disturbance of amplitude {} signal units and frequency {} "
                   "rad/s or more, ",
                   text, given.amplitude->text, given.frequency->text);
}

/// The proved bounds on the errors, once settled: the end of every sentence.
std::string proved_bounds(const Certificate& certificate, const std::string& name) {
  constexpr int kDigits = 3;
  const auto bound = [&](const char* which) {
    return rigor::upper_decimal(proved_kkl_bound(certificate, which).value(), kDigits);
  };
  const std::string from = fmt::format(": from {} s after the start on, ", bound("settling_time"));
  return name == "settling_time" ? fmt::format(
                                       "{}the frequency error is at most {} rad/s and the amplitude error at "
                                       "most {} signal units",
                                       from, bound("frequency_error_bound"), bound("amplitude_error_bound"))
                                 : from + "it is at most " + bound(name.c_str());
}

/// A requirement on a proved bound: `requirement` states the requirement on the quantity of that name.
Claim bound_claim(const Certificate& certificate, const std::string& id, const std::string& name,
                  const std::string& requirement, const std::string& unit, const Number& required) {
  Claim claim;
  claim.id = id;
  claim.requirement = requirement;
  claim.hypotheses = hypotheses(kkl_observer_tables(certificate.design));
  claim.statement = claim.hypotheses + requirement;
  claim.required = true;
  claim.position = required.position;
  const std::optional<Interval> bound = proved_kkl_bound(certificate, name);
  if (!bound) {
    claim.statement += ".";
    claim.reason = "No bound is certified for the assumed range and disturbance";
    if (const theorems::Derivation* derivation = find_derivation(certificate, kRobustness)) {
      for (const theorems::Condition& condition : derivation->conditions) {
        if (condition.verdict != Verdict::proved) {
          claim.reason += fmt::format(" ({}: {})", condition.id, condition.reason);
          break;
        }
      }
    }
    claim.reason += ".";
    return claim;
  }
  claim.statement += proved_bounds(certificate, name) + ".";
  const std::string shown = rigor::upper_decimal(*bound);
  if (rigor::certainly_less(Interval(bound->upper()), required.value)) {
    claim.verdict = Verdict::proved;
    claim.reason = fmt::format("The proved bound is {} {}.", shown, unit);
    claim.evidence = {theorems::find_quantity(*find_derivation(certificate, kRobustness), name)};
  } else {
    claim.reason = fmt::format("The proved bound is {} {}, which is not below it.", shown, unit);
  }
  return claim;
}

void add_required_claims(Certificate& certificate, const KklRequirements& require) {
  if (require.frequency_error_below) {
    const Number& required = *require.frequency_error_below;
    certificate.claims.push_back(
        bound_claim(certificate, "kkl/frequency-error-bound", "frequency_error_bound",
                    fmt::format("the frequency error stays below {} rad/s once settled", required.text),
                    "rad/s", required));
  }
  if (require.amplitude_error_below) {
    const Number& required = *require.amplitude_error_below;
    certificate.claims.push_back(bound_claim(
        certificate, "kkl/amplitude-error-bound", "amplitude_error_bound",
        fmt::format("the amplitude error stays below {} signal units once settled", required.text),
        "signal units", required));
  }
  if (require.settles_within) {
    const Number& required = *require.settles_within;
    certificate.claims.push_back(
        bound_claim(certificate, "kkl/settling-time", "settling_time",
                    fmt::format("the proved bounds are valid from {} s after the start on", required.text),
                    "s", required));
  }
  conclude_requirements(certificate);
}

}  // namespace

template <int M>
kkl_observer::KklRobustnessQuestionOf<M> kkl_robustness_question(const KklObserverTables& tables,
                                                                 const Interval& ell) {
  kkl_observer::KklRobustnessQuestionOf<M> question;
  question.range = kkl_range<M>(tables);
  question.amplitude = hull_of(tables.assume.amplitude);
  question.ell = ell;
  question.disturbance = disturbance_of(tables.assume);
  if (tables.design.sampling_interval) {
    question.interval = tables.design.sampling_interval->value;
  }
  return question;
}

template kkl_observer::KklRobustnessQuestionOf<4> kkl_robustness_question(const KklObserverTables&,
                                                                          const Interval&);

std::optional<Interval> proved_kkl_bound(const Certificate& certificate, const std::string& name) {
  const theorems::Derivation* derivation = find_derivation(certificate, kRobustness);
  if (derivation == nullptr || derivation->verdict != Verdict::proved) {
    return std::nullopt;
  }
  const theorems::Quantity& quantity = theorems::find_quantity(*derivation, name);
  return rigor::is_finite(quantity.value) ? std::optional(quantity.value) : std::nullopt;
}

std::optional<Eigen::Vector4d> section_v_rates(const KklObserverTables& tables) {
  const Eigen::Vector4d printed(1.0, 2.0, 3.0, 4.0);
  if (tables.design.lambda.size() != kFilters) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < kFilters; ++i) {
    if (!(tables.design.lambda[i].value == Interval(printed(static_cast<Eigen::Index>(i))))) {
      return std::nullopt;
    }
  }
  return printed;
}

KklEll kkl_ell_in_use(const Certificate& certificate) {
  if (const auto& chosen = kkl_observer_tables(certificate.design).design.ell) {
    return {chosen->value, chosen->nearest, chosen->text};
  }
  const theorems::Derivation* proved = find_derivation(certificate, "kkl-ell");
  if (proved == nullptr) {
    return {Interval::empty(), std::numeric_limits<double>::quiet_NaN(), std::nullopt};
  }
  const double lower = theorems::find_quantity(*proved, "ell").value.lower();
  return {Interval(lower), lower, std::nullopt};
}

void kkl_observer_published_results(Certificate& certificate) {
  const KklObserverTables& tables = kkl_observer_tables(certificate.design);
  kkl_observer::KklClaimsQuestion claims;
  for (const Number& rate : tables.design.lambda) {
    claims.lambda.push_back(rate.value);
  }
  claims.frequency = hull_of(tables.assume.frequency);
  claims.amplitude = hull_of(tables.assume.amplitude);
  kkl_observer::with_number_of_filters(claims.lambda.size(), [&](auto filters) {
    const auto range = kkl_range<decltype(filters)::value>(tables);
    const search::VerifiedMinimum<1> infimum = kkl_observer::enclose_ell(range);
    certificate.derivations.push_back(kkl_observer::derive_kkl_ell(range, infimum));
    claims.infimum = infimum.value();
  });
  claims.ell = kkl_ell_in_use(certificate).value;
  certificate.derivations.push_back(kkl_observer::derive_kkl_claims(claims));
}

void certify_kkl_observer(Certificate& certificate, const CertifyProgress& /*progress*/) {
  const KklObserverTables& tables = kkl_observer_tables(certificate.design);
  kkl_observer_published_results(certificate);
  kkl_observer::with_number_of_filters(tables.design.lambda.size(), [&](auto filters) {
    const auto question =
        kkl_robustness_question<decltype(filters)::value>(tables, kkl_ell_in_use(certificate).value);
    // Its place is between the two.
    certificate.derivations.insert(certificate.derivations.end() - 1,
                                   kkl_observer::derive_kkl_robustness(question));
  });
  if (const auto lambda = section_v_rates(tables)) {
    certificate.derivations.push_back(
        kkl_observer::derive_kkl_section_v(*lambda, kkl_ell_in_use(certificate).nearest));
  }
  add_required_claims(certificate, tables.require);
}

}  // namespace veritrack::certificates
