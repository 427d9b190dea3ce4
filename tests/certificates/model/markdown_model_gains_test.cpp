#include "certificates/model/markdown_model_gains.hpp"

#include <doctest/doctest.h>

#include <any>
#include <regex>
#include <string>

#include "certificates/document/markdown.hpp"
#include "certificates/model/markdown_model.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

TEST_CASE("a loop that is certified by gains: what each cause contributes, and an attack that comes near") {
  const Certificate certificate = test::two_channel_certificate();
  REQUIRE(model_sets(certificate).gains.has_value());
  const std::string text = model_sections(certificate, {});
  std::smatch found;
  REQUIRE(
      std::regex_search(text, found, std::regex("[|] noise of at most 0[.]1 [|] ([0-9.e-]+) rad/sample")));
  const double noise = std::stod(found[1]);
  REQUIRE(std::regex_search(
      text, found, std::regex("[|] slew of at most 0[.]1 Hz per second [|] ([0-9.e-]+) rad/sample")));
  const double slew = std::stod(found[1]);
  REQUIRE(std::regex_search(text, found, std::regex("[|] together [|] ([0-9.e-]+) rad/sample")));
  CHECK(noise + slew <= 1.001 * std::stod(found[1]));
  CHECK(noise + slew >= 0.9 * std::stod(found[1]));
  REQUIRE(std::regex_search(text, found, std::regex(": ([0-9.]+) of the certified bound in the long run")));
  CHECK(std::stod(found[1]) <= 1.0);
  CHECK(std::stod(found[1]) > 0.8);
  CHECK(text.find("| `theta` | `phi + omega` |") != std::string::npos);
  CHECK(text.find("| `w` | `omega` |") != std::string::npos);
  CHECK(text.find("damping 0.947") != std::string::npos);  // of ln z, z = 0.97 +- 0.01i
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("tube") == std::string::npos);
}

TEST_CASE("a proved set that may reach a false lock is no tolerated noise: the document says why") {
  Certificate certificate = test::two_channel_certificate();
  CHECK(model_sections(certificate, {}).find("false lock") == std::string::npos);
  auto& sets = std::any_cast<ModelSets&>(certificate.particulars);
  REQUIRE(sets.assumed.has_value());
  sets.assumed->half_distance = 0.001;
  const std::string text = model_sections(certificate, {});
  CHECK(text.find("but no sentence says that the tracker tolerates them. Its frequency error may reach") !=
        std::string::npos);
  CHECK(text.find("from 0.001 rad/sample on it may be nearer to a false lock: no lock can be named "
                  "(`docs/model-proof.md`, section 18).") != std::string::npos);
}

TEST_CASE("a clamp on the whole phase error is named where it limits the noise that is tolerated") {
  const auto sections = [](const std::string& limit) {
    const std::string text = R"(name = "PLL with a clamp"
tracker = "model"
[model]
samples = ['y1', 'y2']
parameters = { most = )" + limit +
                             R"( }
states = ['theta', 'w']
angles = ['theta']
step = '''
ahead  = theta + w
e      = clamp(atan2(y2*cos(ahead) - y1*sin(ahead), y1*cos(ahead) + y2*sin(ahead)), -most, most)
w'     = w + 0.004*e
theta' = ahead + 0.1*e
'''
frequency = 'w'
start = { theta = 0, w = 'omega' }
[assume]
amplitude = 1
frequency = [0.2, 0.5]
noise = 0.1
)";
    return model_sections(certify(test::loop_design(text), "pll.toml", text, {}, Extent::everything), {});
  };
  const std::string text = sections("0.3");
  CHECK_MESSAGE(text.find("More noise makes a clamp act: clamp(atan2(") != std::string::npos, text);
  CHECK_MESSAGE(text.find(", most = 0.3) (line 10).") != std::string::npos, text);
  CHECK(sections("3.5").find("makes a clamp act") == std::string::npos);
}

TEST_CASE("over a band through 0, too, what describes a phase twice is named") {
  const std::string text = R"(name = "FLL behind an oscillator"
tracker = "model"
[model]
samples = ['y1', 'y2']
parameters = { T = 1e-3, g = 40 }
states = ['th', 'vel', 'pi_', 'pq']
angles = ['th']
step = '''
i    = y1*cos(th) + y2*sin(th)
q    = y2*cos(th) - y1*sin(th)
vel' = vel + g*atan2(pi_*q - i*pq, pi_*i + pq*q)
th'  = th + T*vel'
pi_' = i
pq'  = q
'''
frequency = 'vel*T'
start = { th = 'omega', vel = 'omega/T', pi_ = 'A', pq = 0 }
[assume]
amplitude = 2000
frequency = [-0.5, 0.5]
noise = 200
)";
  const Certificate certificate = certify(test::loop_design(text), "fll.toml", text, {}, Extent::everything);
  const std::string& objection = model_sets(certificate).objection;
  CHECK_MESSAGE(objection.find("frequencies below 0 are certified by gains only") == 0, objection);
  CHECK_MESSAGE(
      objection.find("and pi_ may turn together, and the tracker does not notice") != std::string::npos,
      objection);
}

TEST_CASE("an unstable loop is refuted, with what would make it stable") {
  const Certificate certificate = test::two_channel_certificate("kp = 2.1, ki = 0.03");
  const std::string text = model_sections(certificate, {});
  CHECK(text.find("The steady state below is unstable") != std::string::npos);
  // 2 kp - ki < 4
  CHECK(text.find("| `kp` | 2.1 | below 2.015 |") != std::string::npos);
  CHECK(headline(certificate)
            .starts_with("NOT PROVED. REFUTED: the steady state of the certificate is stable; UNDECIDED: "));
  const auto answers = model_answers(certificate);
  REQUIRE(answers.size() == 1);
  CHECK(answers.front()->id == "model/stability");
  CHECK(answers.front()->verdict == rigor::Verdict::refuted);
  for (const Claim& claim : certificate.claims) {
    CHECK(claim.verdict != rigor::Verdict::proved);
  }
}

TEST_CASE(
    "two states of which the direction alone matters: the document says so, and an attack reaches the "
    "bound") {
  const Certificate certificate = test::turn_certificate("0.2");
  const std::string text = model_sections(certificate, {});
  CHECK(text.find("| `p` | `R cos(phi)` |") != std::string::npos);
  CHECK(text.find("| `r` | `R sin(phi)` |") != std::string::npos);
  CHECK(text.find("of `p` and `r` the step takes the direction alone") != std::string::npos);
  CHECK(text.find(": 1.00 of the certified bound in the long run") != std::string::npos);
  const std::string unstable = model_sections(test::turn_certificate("2.5"), {});
  CHECK(unstable.find("| `g` | 2.5 | below 2 |") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::certificates
