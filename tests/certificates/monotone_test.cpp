// What is proved of the harder of two questions is proved of the easier one, whatever the kind of tracker.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "certificates/design/design_reader.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

using rigor::Verdict;

/// More of each is harder, but for the signal-to-noise ratio; factors of what a kind has as its own.
struct Question {
  double noise = 1.0;  ///< in Gaussian noise, dB below the ratio of the kind
  double slew = 1.0;
  double starts = 1.0;
  double band = 1.0;  ///< width, about a middle
  double samples = 1.0;
  double amplitudes = 1.0;  ///< width of their range
};

/// A design with a requirement of `required`.
using TextOf = std::function<std::string(const Question& question, double required)>;
/// What is required to be above, as far as it was proved; nothing where nothing was.
using ValueOf = std::function<std::optional<double>(const Certificate& certificate)>;

struct Kind {
  const char* name;
  TextOf text;
  ValueOf value;
  /// A larger value is a better one.
  bool is_limit = false;
  std::vector<double Question::*> parts;
  /// What is required first, to find the value: so much that nothing is enough, but in Gaussian noise, where
  /// a set is searched for the probability that is required.
  double required_first = 1e-9;
};

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> quantity(const Certificate& certificate, const char* derivation, const char* name) {
  const theorems::Derivation* found = find_derivation(certificate, derivation);
  const theorems::Quantity* value = found == nullptr ? nullptr : theorems::applicable_quantity(*found, name);
  return value == nullptr ? std::nullopt : finite(value->value.upper());
}

std::optional<double> frequency_bound(const Certificate& certificate) {
  const auto bound = certificate.contraction ? certificate.contraction->starts.proved_bound() : std::nullopt;
  return bound ? finite(bound->upper()) : std::nullopt;
}

std::optional<double> largest_noise(const Certificate& certificate) {
  return certificate.contraction && certificate.contraction->largest_noise.applies()
             ? finite(certificate.contraction->largest_noise.value.lower())
             : std::nullopt;
}

std::string ekf_text(const char* design, const Question& q, double middle, double width,
                     const std::string& noise, double slew, double start, const std::string& require) {
  return fmt::format(
      "name = \"a design\"\n{}\n[assume]\nfrequency = [{:.17g}, {:.17g}]\nnoise = {}\nslew = {:.17g}\n"
      "initial_frequency_error = {:.17g}\ninitial_phase_error = {:.17g}\ninitial_amplitude_error = {:.17g}\n"
      "[require]\n{}\n[simulate]\nsamples = 10\n",
      design, middle - 0.5 * width * q.band, middle + 0.5 * width * q.band, noise, slew * q.slew,
      start * q.starts, start * q.starts, start * q.starts, require);
}

std::string number(double value) {
  return fmt::format("{:.17g}", value);
}

constexpr const char* kQuadrature =
    "tracker = \"quadrature-ekf\"\n[design]\nq1 = 0.0023\nq2 = 0.0023\nr = 0.05\nepsilon = 0";
constexpr const char* kLeaking =
    "tracker = \"quadrature-ekf\"\n[design]\nq1 = 0.0013\nq2 = 0.0013\nr = 0.01\nepsilon = 0.01";
constexpr const char* kSingleChannel =
    "tracker = \"single-channel-ekf\"\n[design]\nq = 0.005\nr = 0.01\nepsilon = 0\nprocess_noise = "
    "\"identity\"";
constexpr const char* kStartLimited =
    "tracker = \"quadrature-ekf\"\n[design]\nq1 = 0.002\nq2 = 0.0007\nr = 0.03\nepsilon = 0";

std::string block_text(const Question& q, const std::string& noise, const std::string& require) {
  return fmt::format(
      "name = \"a design\"\ntracker = \"dft-block-ekf\"\n[design]\nq1 = 5e-5\nq2 = 1e-3\nq3 = 2.5e-3\n"
      "r = 0.0030517578125\nblock_length = 2048\ncentre = 100\n[assume]\n"
      "offset = [{:.17g}, {:.17g}]\n{}\nslew = {:.17g}\ninitial_amplitude_error = {:.17g}\n"
      "initial_phase_error = {:.17g}\ninitial_offset_error = {:.17g}\n[require]\n{}\n",
      0.3 - 0.01 * q.band, 0.3 + 0.01 * q.band, noise, 2e-4 * q.slew, 1e-3 * q.starts, 1e-2 * q.starts,
      2e-3 * q.starts, require);
}

std::string model_text(const Question& q, const std::string& require) {
  return fmt::format(
      "name = \"a loop\"\ntracker = \"model\"\n[model]\nsamples = 'y'\nparameters = {{ wn = 0.02, zeta = "
      "0.7071, ki = 'wn^2', kp = '2*zeta*wn' }}\nstates = ['theta', 'w']\nangles = ['theta']\nstep = '''\n"
      "e = -2*y*sin(theta + w)\nw' = w + ki*e\ntheta' = theta + w + kp*e\n'''\nfrequency = 'w'\n"
      "start = {{ theta = 0, w = 'omega' }}\n[assume]\namplitude = [{:.17g}, {:.17g}]\nfrequency = [{:.17g}, "
      "{:.17g}]\nnoise = {:.17g}\nstart_within = {{ w = {:.17g} }}\n[require]\n{}\n",
      1.0 - 0.001 * q.amplitudes, 1.0 + 0.001 * q.amplitudes, 0.35 - 0.01 * q.band, 0.35 + 0.01 * q.band,
      0.003 * q.noise, 2e-4 * q.starts, require);
}

std::vector<Kind> cheap_kinds() {
  return {
      {"quadrature",
       [](const Question& q, double required) {
         return ekf_text(kQuadrature, q, 1.5, 1.0, number(1e-3 * q.noise), 1e-5, 5e-3,
                         "frequency_error_below = " + number(required));
       },
       frequency_bound,
       false,
       {&Question::noise, &Question::slew, &Question::starts, &Question::band}},
      {"single channel",
       [](const Question& q, double required) {
         return ekf_text(kSingleChannel, q, 1.45, 0.02, number(3e-4 * q.noise), 2e-5, 2e-4,
                         "frequency_error_below = " + number(required));
       },
       frequency_bound,
       false,
       {&Question::noise, &Question::slew, &Question::starts, &Question::band}},
      {"block tracker",
       [](const Question& q, double required) {
         return block_text(q, "noise = " + number(3e-4 * q.noise),
                           "offset_error_below = " + number(required));
       },
       [](const Certificate& c) { return quantity(c, "lock-set", "offset_error_bound"); },
       false,
       {&Question::noise, &Question::slew, &Question::starts, &Question::band}},
      {"block tracker in Gaussian noise",
       [](const Question& q, double required) {
         return block_text(
             q,
             fmt::format("noise = {{ snr_db = {:.17g} }}\nblocks = {:.17g}", 27.0 - q.noise, 1e3 * q.samples),
             "probability_of_losing_lock_below = " + number(required));
       },
       [](const Certificate& c) { return quantity(c, "lock-in-noise", "probability_of_losing_lock"); },
       false,
       {&Question::noise, &Question::slew, &Question::starts, &Question::band, &Question::samples}},
      {"model",
       [](const Question& q, double required) {
         return model_text(q, "frequency_error_below = " + number(required));
       },
       [](const Certificate& c) {
         const ModelSets& sets = model_sets(c);
         return sets.assumed && sets.assumed->is_proved() && sets.assumed->start_share <= 1.0
                    ? finite(sets.assumed->frequency_error)
                    : std::nullopt;
       },
       false,
       {&Question::noise, &Question::starts, &Question::band, &Question::amplitudes}},
  };
}

std::vector<Kind> dear_kinds() {
  return {
      {"model, largest noise",
       [](const Question& q, double required) {
         return model_text(q, "largest_noise_at_least = " + number(required));
       },
       [](const Certificate& c) {
         const ModelSets& sets = model_sets(c);
         return sets.noise && sets.noise->is_proved() ? finite(sets.noise->tubes.noise) : std::nullopt;
       },
       true,
       {&Question::noise, &Question::starts, &Question::band, &Question::amplitudes},
       10.0},
      {"quadrature with a leak",
       [](const Question& q, double required) {
         return ekf_text(kLeaking, q, 0.05, 0.04, number(5e-4 * q.noise), 0.0, 3e-4,
                         "frequency_error_below = " + number(required));
       },
       frequency_bound,
       false,
       {&Question::noise, &Question::starts, &Question::band}},
      {"quadrature with a leak, largest noise",
       [](const Question& q, double required) {
         return ekf_text(kLeaking, q, 0.3, 0.2, number(5e-4 * q.noise), 0.0, 3e-4,
                         "largest_noise_at_least = " + number(required));
       },
       largest_noise,
       true,
       {&Question::noise, &Question::starts, &Question::band},
       10.0},
      {"quadrature in Gaussian noise",
       [](const Question& q, double required) {
         return ekf_text(
             kStartLimited, q, 1.5, 1.0,
             fmt::format("{{ snr_db = {:.17g} }}\nsamples = {:.17g}", 15.5 - q.noise, 30 * q.samples), 0.0,
             0.05, "probability_of_losing_lock_below = " + number(required));
       },
       [](const Certificate& c) { return quantity(c, "lock", "probability_of_losing_lock"); },
       false,
       {&Question::noise, &Question::starts, &Question::band, &Question::samples},
       0.05},
  };
}

Certificate certified(const Kind& kind, const Question& question, double required) {
  const std::string text = kind.text(question, required);
  return certify(read_design(text, "design.toml"), "design.toml", text, {}, Extent::verdicts);
}

std::string words(const Kind& kind, const Question& question) {
  std::string text;
  for (const auto part : kind.parts) {
    text += fmt::format(" {:.4g}", question.*part);
  }
  return text;
}

/// Pairs of a harder question and an easier one: a requirement that is just met in the harder one has to be
/// met in the easier one.
void check_pairs(const Kind& kind, std::int64_t pairs, std::uint64_t stream) {
  test::Random random(stream);
  std::int64_t counted = 0;
  for (std::int64_t pair = 0; pair < pairs; ++pair) {
    Question hard;
    Question easy;
    bool is_easier = false;
    for (const auto part : kind.parts) {
      hard.*part = std::exp2(random.uniform(-1.0, 1.0));
      easy.*part = hard.*part;
    }
    while (!is_easier) {
      for (const auto part : kind.parts) {
        if (random.uniform() < 0.5) {
          easy.*part = hard.*part * std::exp2(-random.uniform(0.0, 1.0));
          is_easier = true;
        }
      }
    }
    // What can be proved of the harder one, and a little less than that.
    const double slack = 1.0 + 0.1 * random.uniform();
    const auto value = kind.value(certified(kind, hard, kind.required_first));
    if (!value) {
      continue;
    }
    const double required = kind.is_limit ? *value / slack : *value * slack;
    const Certificate of_hard = certified(kind, hard, required);
    if (of_hard.verdict != Verdict::proved) {
      continue;
    }
    ++counted;
    const Certificate of_easy = certified(kind, easy, required);
    CAPTURE(std::string(kind.name));
    CAPTURE(required);
    CAPTURE(slack);
    CAPTURE(*value);
    CAPTURE(kind.value(of_easy).value_or(NAN));
    CAPTURE(words(kind, hard));
    CAPTURE(words(kind, easy));
    CHECK(of_easy.verdict == Verdict::proved);
  }
  MESSAGE(std::string(kind.name) << ": " << counted << " of " << pairs << " pairs counted, seed "
                                 << test::kSeed << " + " << stream);
  CHECK(2 * counted >= pairs);
}

void check_kinds(const std::vector<Kind>& kinds, std::int64_t pairs) {
  std::uint64_t stream = 35'000;
  for (const Kind& kind : kinds) {
    check_pairs(kind, test::effort(pairs), stream++);
  }
}

}  // namespace

TEST_CASE("what is proved of the harder of two questions is proved of the easier one") {
  check_kinds(cheap_kinds(), 2);
}

TEST_CASE("what is proved of the harder of many pairs of questions is proved of the easier one" *
          doctest::test_suite("nightly")) {
  check_kinds(cheap_kinds(), 30);
  check_kinds(dear_kinds(), 1);  // a minute for each of three certificates of a pair
}

}  // namespace veritrack::certificates
