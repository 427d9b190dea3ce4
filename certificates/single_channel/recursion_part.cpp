#include "certificates/single_channel/recursion_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "analysis/single_channel/first_order_error.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/sets/required_claims.hpp"
#include "certificates/single_channel/single_channel.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Verdict;

constexpr std::string_view kOfModels = "model/";
constexpr std::string_view kOfRecursion = "recursion/";

/// A claim of this tracker that the recursion's claim of the same meaning can decide.
struct SameClaim {
  std::string_view here, there;
};
constexpr SameClaim kLargestNoise{"ekf/largest-noise", "model/largest-noise"};
constexpr SameClaim kRadius{"ekf/frequency-error-radius", "model/frequency-error-radius"};

/// Null when there is none.
const Claim* find_claim(const Certificate& certificate, std::string_view id) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [&](const Claim& claim) { return claim.id == id; });
  return found != certificate.claims.end() ? &*found : nullptr;
}

bool is_open(const Certificate& certificate, const SameClaim& same) {
  const Claim* claim = find_claim(certificate, same.here);
  return claim != nullptr && claim->required && claim->verdict == Verdict::undecided;
}

/// q1, q2 and r, as the design file writes them.
std::array<std::string, 3> variances(const SingleChannelDesignTable& design) {
  const std::string q = design.q ? design.q->text : "1";
  const std::string r = design.lambda ? design.lambda->text : design.r.value().text;
  switch (design.process_noise) {
    case SingleChannelDesignTable::ProcessNoise::frequency_only:
      return {"0", q, r};
    case SingleChannelDesignTable::ProcessNoise::identity:
      return {q, q, r};
    case SingleChannelDesignTable::ProcessNoise::diagonal:
      break;
  }
  return {design.variances.value()[0].text, design.variances.value()[1].text, r};
}

/// The reason why there is no search; empty when there is one.
std::string objection_to(const SingleChannelEkfTables& tables) {
  const Assumptions& assume = tables.assume;
  const trackers::ToneModel<rigor::Interval> design = enclosed_values(tables.design);
  const auto& [low, high] = assume.frequency;
  if (!rigor::certainly_less(low.value, high.value)) {
    return "Not looked for: it takes a band of frequencies, not a single one.";
  }
  if (!rigor::certainly_positive(design.r) ||
      (!rigor::certainly_positive(design.q1) && !rigor::certainly_positive(design.epsilon))) {
    return "Not looked for: with r = 0, or with process noise of the frequency alone and no leak, there is "
           "no exponentially stable steady state.";
  }
  return "";
}

/// In the unit of the design file, with the sample rate where that is Hz.
std::string band_text(const Assumptions& assume) {
  const auto& [low, high] = assume.frequency;
  const auto written = [](const Number& number) { return number.text.substr(0, number.text.find(' ')); };
  const std::string ends = fmt::format("[{}, {}]", written(low), written(high));
  return low.in_hertz ? fmt::format("{{ hz = {} }}\nsample_rate = {}", ends, assume.sample_rate.value().text)
                      : ends;
}

/// The derivative of the prediction. Written out, it prevents a certificate by structure: the covariance is
/// then among the states of the tubes. With a leak the innovation in the steady state is not 0, and a range
/// of gains costs too much.
constexpr std::string_view kJacobian = R"TOML(jacobian = [
  ["cos(w)", "-sin(w)", "-(sin(w)*x1 + cos(w)*x2)"],
  ["sin(w)", "cos(w)", "cos(w)*x1 - sin(w)*x2"],
  ["0", "0", "1 - epsilon"],
]
)TOML";

/// The claim of the recursion's certificate in place of an open one, if it is PROVED.
void decide(Certificate& certificate, const Certificate& recursion, const SameClaim& same) {
  const Claim* there = find_claim(recursion, same.there);
  if (!is_open(certificate, same) || there == nullptr || there->verdict != Verdict::proved) {
    return;
  }
  const auto here = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                 [&](const Claim& claim) { return claim.id == same.here; });
  here->statement = there->statement;
  here->verdict = Verdict::proved;
  here->reason = "The same filter as a recursion: " + there->reason;
  here->evidence.clear();
  here->values = {{"by", "recursion"}};
}

/// At the worst of some frequencies of the band.
double first_order_over_band(const SingleChannelEkfTables& tables) {
  const Assumptions& assume = tables.assume;
  const double amplitude = assume.amplitude.nearest;
  const trackers::ToneModel<double> design =
      trackers::at_unit_amplitude(nearest_values(tables.design), amplitude);
  constexpr int kFrequencies = 5;
  double worst = 0.0;
  for (int i = 0; i < kFrequencies; ++i) {
    const double share = (i + 0.5) / kFrequencies;
    const double frequency =
        assume.frequency[0].nearest + share * (assume.frequency[1].nearest - assume.frequency[0].nearest);
    worst = std::max(worst, single_channel::first_order_error(
                                design, frequency, assume.noise.nearest / amplitude, assume.slew.nearest));
  }
  return worst;
}

}  // namespace

std::string recursion_design_text(const SingleChannelEkfTables& tables, const RecursionQuestion& question) {
  const Assumptions& assume = tables.assume;
  const auto [q1, q2, r] = variances(tables.design);
  const bool leaks = !enclosed_values(tables.design).without_leak();
  std::string text = fmt::format(
      R"(name = "recursion"
tracker = "model"

[model]
samples = "y"
parameters = {{ q1 = {}, q2 = {}, r = {}, epsilon = {} }}
frequency = "w"
start = {{ x1 = "A", x2 = "0", w = "omega", "P.x1.x1" = "r", "P.x2.x2" = "r", "P.w.w" = "q2" }}

[model.ekf]
states = ["x1", "x2", "w"]
predict = '''
x1' = cos(w)*x1 - sin(w)*x2
x2' = sin(w)*x1 + cos(w)*x2
w' = (1 - epsilon)*w
'''
measure = "x1"
Q = [["q1", 0, 0], [0, "q1", 0], [0, 0, "q2"]]
R = "r"
{}
[assume]
amplitude = {}
frequency = {}
noise = {}

[require]
)",
      q1, q2, r, tables.design.epsilon.text, leaks ? kJacobian : "", assume.amplitude.text, band_text(assume),
      assume.noise.text);
  if (question.largest_noise) {
    text += fmt::format("largest_noise_at_least = {}\n", tables.require.largest_noise_at_least.value().text);
  }
  if (question.radius) {
    text += fmt::format("frequency_error_radius_at_least = {}\n",
                        tables.require.frequency_error_radius_at_least.value().text);
  }
  return text;
}

void add_recursion(Certificate& certificate, const CertifyProgress& progress) {
  const SingleChannelEkfTables& tables = single_channel_tables(certificate.design);
  RecursionPart part;
  if (certificate.extent == Extent::everything && proved_long_run(certificate)) {
    part.first_order_error = first_order_over_band(tables);
  }
  const auto& radius = tables.require.frequency_error_radius_at_least;
  RecursionQuestion question;
  question.largest_noise = is_open(certificate, kLargestNoise);
  // Under the assumed slew, which the recursion's sets do not have.
  question.radius =
      is_open(certificate, kRadius) && tables.assume.slew.value == rigor::Interval(0.0) && !radius->in_hertz;
  const bool is_asked = question.asks() && certificate.extent != Extent::quick;
  part.objection = is_asked ? objection_to(tables) : "";
  if (is_asked && part.objection.empty()) {
    const std::string text = recursion_design_text(tables, question);
    try {
      Design recursion = read_design(text, "recursion");
      recursion.name = certificate.design.name;
      part.certificate = certify(recursion, certificate.design_file, text, progress, certificate.extent,
                                 certificate.deadline);
    } catch (const InputError& error) {  // a number that formulas write differently
      part.objection = fmt::format("Not looked for: as a recursion the design is refused: {}.", error.what());
    }
  }
  if (part.certificate) {
    for (const Claim& inner : part.certificate->claims) {
      if (!inner.required && inner.verdict == Verdict::proved) {
        Claim claim;
        claim.id = std::string(kOfRecursion) + inner.id.substr(kOfModels.size());
        claim.hypotheses = inner.hypotheses;
        claim.statement = inner.statement;
        claim.verdict = Verdict::proved;
        claim.reason = "The certificate of the same filter as a recursion shows it.";
        certificate.claims.push_back(std::move(claim));
      }
    }
    decide(certificate, *part.certificate, kLargestNoise);
    decide(certificate, *part.certificate, kRadius);
    conclude_requirements(certificate);
  }
  part.can_be_asked =
      !part.certificate && tables.assume.slew.value == rigor::Interval(0.0) && objection_to(tables).empty();
  certificate.particulars = std::move(part);
}

std::optional<rigor::Interval> proved_long_run(const Certificate& certificate) {
  const theorems::Derivation* contraction = find_derivation(certificate, "contraction");
  if (contraction == nullptr || contraction->verdict != Verdict::proved) {
    return std::nullopt;
  }
  const theorems::Quantity* bound = theorems::applicable_quantity(*contraction, "ultimate_frequency_error");
  return bound != nullptr ? std::optional(bound->value) : std::nullopt;
}

const RecursionPart& recursion_part(const Certificate& certificate) {
  return std::any_cast<const RecursionPart&>(certificate.particulars);
}

bool has_recursion(const Certificate& certificate) {
  const RecursionPart& part = recursion_part(certificate);
  return part.certificate && std::any_of(part.certificate->claims.begin(), part.certificate->claims.end(),
                                         [](const Claim& claim) { return claim.verdict == Verdict::proved; });
}

}  // namespace veritrack::certificates
