#include "certificates/model/loop_claims.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

using rigor::Verdict;

/// The loop of two channels with kp = 0.06, ki = 0.001, or another one, and these requirements.
Certificate required_of_loop(const std::string& require, const std::string& gains = "kp = 0.06, ki = 0.001",
                             const std::string& amplitude = "1",
                             const std::string& frequency = "w' = w + ki*e",
                             const std::string& more_states = "", const std::string& more_starts = "") {
  const std::string text = R"(name = "a loop"
tracker = "model"
[model]
samples = ['i', 'q']
parameters = { )" + gains + R"( }
states = ['theta', 'w')" + more_states +
                           R"(]
angles = ['theta']
step = '''
e      = q*cos(theta) - i*sin(theta)
theta' = theta + w + kp*e
)" + frequency + R"(
'''
frequency = 'w'
start = { theta = 'omega', w = 'omega')" +
                           more_starts + R"( }
[assume]
amplitude = )" + amplitude +
                           R"(
sample_rate = 1000
frequency = [-0.5, 0.5]
noise = 0.01
[require]
)" + require;
  return certify(test::loop_design(text), "loop.toml", text, {}, Extent::requirements);
}

const Claim& only_required(const Certificate& certificate) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [](const Claim& claim) { return claim.required; });
  REQUIRE(found != certificate.claims.end());
  return *found;
}

Verdict verdict_on(const std::string& key, double value) {
  return only_required(required_of_loop(key + " = " + std::to_string(value))).verdict;
}

/// z^2 - (2 - kp) z + 1 - kp + ki of that loop has a pair: |z|^2 = 0.941, Re z = 0.97.
struct PairOfLoop {
  double size = std::sqrt(0.941);
  double angle = std::acos(0.97 / std::sqrt(0.941));
  [[nodiscard]] double damping() const { return -std::log(size) / std::hypot(std::log(size), angle); }
  [[nodiscard]] double time_constant() const { return -1.0 / std::log(size); }
};

}  // namespace

TEST_CASE("what is asked of a linear loop is decided next to the closed form") {
  const PairOfLoop pair;
  CHECK(verdict_on("damping_at_least", 0.999 * pair.damping()) == Verdict::proved);
  CHECK(verdict_on("damping_at_least", 1.001 * pair.damping()) == Verdict::refuted);
  CHECK(verdict_on("settles_like", 1.001 * pair.time_constant()) == Verdict::proved);
  CHECK(verdict_on("settles_like", 0.999 * pair.time_constant()) == Verdict::refuted);
  // Jury: f (2 kp - ki) < 4.
  const double margin = 20.0 * std::log10(4.0 / (2.0 * 0.06 - 0.001));
  CHECK(verdict_on("gain_margin_at_least", margin - 0.01) == Verdict::proved);
  CHECK(verdict_on("gain_margin_at_least", margin + 0.01) == Verdict::refuted);
  double theta = 0.06, w = 0.001, sum = 0.0;
  for (int k = 0; k < 20'000; ++k) {
    sum += theta * theta;
    const double next = (1.0 - 0.06) * theta + w;
    w -= 0.001 * theta;
    theta = next;
  }
  const double bandwidth = std::acos(-1.0) * sum;
  CHECK(verdict_on("noise_bandwidth_below", 1.001 * bandwidth) == Verdict::proved);
  CHECK(verdict_on("noise_bandwidth_below", 0.999 * bandwidth) == Verdict::refuted);
}

TEST_CASE("sentences and reasons have the numbers, with their units") {
  const Claim damping = only_required(required_of_loop("damping_at_least = 0.5"));
  CHECK(
      damping.statement ==
      "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [-0.5, 0.5] rad/sample "
      "at 1000 samples per second, without noise, to first order about the steady state of the certificate, "
      "every mode of the linear loop has a damping ratio of at least 0.5.");
  CHECK(damping.requirement == "every mode of the linear loop has a damping ratio of at least 0.5");
  CHECK(damping.reason ==
        "The damping ratio of every mode is proved to be at least 0.947; at least 0.5 is required.");
  const Claim time = only_required(required_of_loop("settles_like = { seconds = 0.05 }"));
  CHECK(time.verdict == Verdict::proved);
  CHECK(time.requirement ==
        "the slowest mode of the linear loop shrinks by a factor of e in at most 0.05 seconds");
  CHECK(time.reason ==
        "The time constant is proved to be at most 32.89 samples (0.03289 s); at most 0.05 seconds is "
        "required.");
  const Claim bandwidth = only_required(required_of_loop("noise_bandwidth_below = { hz = 20 }"));
  CHECK(bandwidth.verdict == Verdict::proved);
  CHECK(bandwidth.reason.find("The noise bandwidth is proved to be at most 0.1") == 0);
  CHECK(bandwidth.reason.ends_with(" Hz); below 20 Hz is required."));
  const Claim margin = only_required(required_of_loop("gain_margin_at_least = 6"));
  CHECK(margin.reason == "The gain margin is proved to be at least 30.53 dB; at least 6 dB is required.");
}

TEST_CASE("an unstable loop has no damping, no time constant and no margin") {
  const std::string all =
      "damping_at_least = 0.1\nsettles_like = 1000\nnoise_bandwidth_below = 1\ngain_margin_at_least = 1\n";
  const Certificate certificate = required_of_loop(all, "kp = 2.1, ki = 0.03");
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      CAPTURE(claim.id);
      CHECK(claim.verdict == (claim.id == "model/noise-bandwidth" ? Verdict::undecided : Verdict::refuted));
      CHECK(claim.reason.find("unstable") != std::string::npos);
    }
  }
}

TEST_CASE("where there is no one linear loop, or no one detector, the reason says so") {
  const auto reason = [](const Certificate& certificate) {
    CHECK(only_required(certificate).verdict == Verdict::undecided);
    return only_required(certificate).reason;
  };
  const std::string gains = "kp = 0.06, ki = 0.001";
  const std::string damping = "damping_at_least = 0.1";
  const std::string bandwidth = "noise_bandwidth_below = 1";
  CHECK(reason(required_of_loop(damping, gains, "[0.9, 1.1]")).find("no one linear recursion") !=
        std::string::npos);
  CHECK(reason(required_of_loop(bandwidth, gains, "{ constant = [0.9999, 1.0001] }")).find("one number") !=
        std::string::npos);
  // A clamp behind the loop filter is no other detector; a second phase that is compared is one.
  CHECK(only_required(required_of_loop(bandwidth, gains, "1", "w' = clamp(w + ki*e, -1, 1)")).verdict ==
        Verdict::proved);
  CHECK(reason(required_of_loop(bandwidth, gains, "1",
                                "w' = w + ki*(q*cos(theta + last/2) - i*sin(theta + last/2))\nlast' = e",
                                ", 'last'", ", last = 0"))
            .find("more than one detector") != std::string::npos);
  std::string one_channel = test::kLoopText;
  one_channel += damping + "\n";
  const Certificate by_tubes =
      certify(test::loop_design(one_channel), "loop.toml", one_channel, {}, Extent::verdicts);
  const auto found = std::find_if(by_tubes.claims.begin(), by_tubes.claims.end(),
                                  [](const Claim& claim) { return claim.id == "model/damping"; });
  REQUIRE(found != by_tubes.claims.end());
  CHECK(found->verdict == Verdict::undecided);
  CHECK(found->reason.starts_with("This is known of loops that are certified by gains only"));
}

TEST_CASE("the claimed decay is above the largest eigenvalue by what a cruder checker needs") {
  // The eigenvalue of the filter behind the loop is the largest one: the checker did not reach 0.98055656.
  const std::string text = R"(name = "resolver to digital"
tracker = "model"
[model]
samples = ['c', 's']
parameters = { T = '1/16000', wn = '2*pi*250', kp = '1.6*wn', ki = 'wn^2', al = '1 - exp(-2*pi*50*T)' }
states = ['th', 'w', 'out']
angles = ['th']
step = '''
e    = s*cos(th) - c*sin(th)
w'   = w + T*ki*e
th'  = th + T*(w' + kp*e)
out' = out + al*(w' - out)
'''
frequency = 'out*T'
start = { th = 'omega', w = 'omega/T', out = 'omega/T' }
[assume]
amplitude = 1
frequency = [-0.15, 0.15]
noise = 0.02
)";
  const Certificate certificate =
      certify(test::loop_design(text), "loop.toml", text, {}, Extent::requirements);
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [](const Claim& claim) { return claim.id == "model/stability"; });
  REQUIRE(found != certificate.claims.end());
  REQUIRE(found->values.size() == 1);
  const std::string decay = found->values.front().second;
  CHECK(decay.size() <= 10);
  const double largest = std::exp(-std::acos(-1.0) / 160.0);
  CHECK(std::stod(decay) > largest + 9e-7);
  CHECK(std::stod(decay) < largest + 2e-6);
}

}  // namespace veritrack::certificates
