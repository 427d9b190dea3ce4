#include "certificates/model/proof_words.hpp"

#include <doctest/doctest.h>

namespace veritrack::certificates {
namespace {

using Kind = model::NoGains::Kind;

TEST_CASE("why gains prove nothing, by constant coefficients and over the phase") {
  CHECK(gains_words({Kind::question}) ==
        "it needs a tone alone, bounded noise, no start_exactly and no filter");
  CHECK(phase_gains_words({Kind::question}) ==
        "it needs one amplitude, bounded noise, no start_exactly and no filter");
  CHECK(gains_words({Kind::band}) == "the band goes beyond half the sample rate, or, with one channel, to 0");
  CHECK(phase_gains_words({Kind::band}) == "the band goes to 0 or to half the sample rate");
  CHECK(gains_words({Kind::steady_state}) == "no steady state was found from [model] start");
  CHECK(gains_words({Kind::bounds}) == "the bounds of its errors do not close, even without noise");
  CHECK(phase_gains_words({Kind::bounds}) == "the bounds of its errors do not close");
  CHECK(gains_words({Kind::residual}) ==
        "its steady state is not a linear function of the frequency over the whole band");
  CHECK(gains_words({Kind::structure, "a frequency that is an angle"}) == "a frequency that is an angle");
  CHECK(phase_gains_words({Kind::structure, "no basis"}) == "no basis");
  CHECK(phase_gains_words({Kind::time, "a basis was found"}) ==
        "the time was over before a basis was found; allowed: more --timeout");
}

TEST_CASE("why nothing is searched for") {
  using Objection = model::ProofObjection::Kind;
  CHECK(objection_words({Objection::too_many_states, 21, 20}, {}) == "21 states are too many: at most 20");
  CHECK(objection_words({Objection::no_band}, {}) ==
        "the assumed frequencies are no band of some width from 0 to pi rad/sample");
  CHECK(objection_words({Objection::negative_frequencies}, model::NoGains{Kind::bounds}) ==
        "frequencies below 0 are certified by gains only (docs/model.md), and this loop is not: the bounds "
        "of its errors do not close, even without noise");
  CHECK(objection_words({Objection::negative_frequencies, 0, 0, "a, b and c may turn together"},
                        model::NoGains{Kind::steady_state}) ==
        "frequencies below 0 are certified by gains only (docs/model.md), and this loop is not: no steady "
        "state was found from [model] start. But a, b and c may turn together");
}

}  // namespace
}  // namespace veritrack::certificates
