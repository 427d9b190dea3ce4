// The claim of how fast a frequency may move, with noise beside it.
#include <doctest/doctest.h>

#include <string>

#include "checker/verification.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {

/// Whether it is proved by a set for a slew of 1e-5 and noise of 2^-10.
bool is_slew_proved(const test::Json& claim) {
  test::Json certificate = test::loop_certificate();
  test::Json cell = certificate["tubes"][1]["cells"][0];
  cell["levels"] = test::hexadecimals({0.0045});
  cell["shrinking"] = test::hexadecimals({0.9999});
  test::Json set = test::ProposedModel::set("slew", 0x1p-10, test::Json::array({cell}));
  set["slew"] = test::hexadecimal(1e-5);
  set["crossing"] = test::hexadecimals({1.0});
  certificate["tubes"] = test::Json::array({set});
  certificate["claims"] = test::Json::array({test::told_claim("model/slew-limit", claim)});
  try {
    return verify(read_json(certificate.dump())).verified();
  } catch (const Malformed&) {
    return false;
  }
}

}  // namespace

TEST_CASE("a slew is tolerated together with the noise of its set, and with no more") {
  const auto with_noise = [](const char* noise) {
    return is_slew_proved({{"slew", "1e-5"}, {"noise", noise}, {"frequency_error", "0.01"}});
  };
  CHECK(is_slew_proved({{"slew", "1e-5"}, {"frequency_error", "0.01"}}));
  CHECK(with_noise("0.0009765625"));
  CHECK_FALSE(with_noise("0.00097656251"));
  CHECK_FALSE(with_noise("0"));
  CHECK_FALSE(with_noise("-0.0001"));
  CHECK_FALSE(with_noise("nan"));
  CHECK_FALSE(is_slew_proved({{"slew", "1.1e-5"}, {"noise", "0.0009765625"}, {"frequency_error", "0.01"}}));
}

}  // namespace veritrack::checker
