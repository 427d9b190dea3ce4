// The keys of a design file for the tracker "single-channel-ekf".
#include <array>
#include <string>
#include <vector>

#include "certificates/design/key_readers.hpp"
#include "certificates/sets/set_keys.hpp"
#include "certificates/single_channel/single_channel_design.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

void process_noise(const TomlValue& value, SingleChannelDesignTable& design) {
  using ProcessNoise = SingleChannelDesignTable::ProcessNoise;
  if (!value.is_string()) {
    const std::vector<TomlValue> variances = value.entries(std::array<std::string_view, 2>{"q1", "q2"});
    design.process_noise = ProcessNoise::diagonal;
    design.variances = {variances[0].real(not_negative), variances[1].real(not_negative)};
    return;
  }
  constexpr std::array<std::string_view, 2> kReadings{"frequency-only", "identity"};
  std::string reading;
  choose(value, kReadings, reading);
  design.process_noise = reading == kReadings[0] ? ProcessNoise::frequency_only : ProcessNoise::identity;
}

using Single = SingleChannelDesignTable;
constexpr std::array kSingleChannelEkfKeys{
    Key<Single>{"q", kPositive, real<&Single::q, positive>, kOptional, kNoContract},
    Key<Single>{"r", kNotNegative, real<&Single::r, not_negative>, kOptional, kNoContract},
    Key<Single>{"lambda", "a number, 0 or more, in place of q and r", real<&Single::lambda, not_negative>,
                kOptional, kNoContract},
    Key<Single>{"epsilon", kAtLeastZeroBelowOne, real<&Single::epsilon, at_least_zero_below_one>,
                defaults_to("0"), kNoContract},
    Key<Single>{"process_noise",
                "\"frequency-only\" for Q = q diag(0, 0, 1), \"identity\" for Q = q diag(1, 1, 1), or { q1 = "
                "..., q2 = ... } for Q = diag(q1, q1, q2), each 0 or more",
                process_noise, kRequired, kNoContract},
};

std::vector<BoundTable> bind_tables(std::any& tables) {
  auto& target = std::any_cast<SingleChannelEkfTables&>(tables);
  return {bound_table("design", kSingleChannelEkfKeys, target.design),
          bound_table("assume", assume_keys_with_one_frequency(), target.assume),
          bound_table("require", require_keys_of_bounded_noise(), target.require),
          bound_table("simulate", simulate_keys(), target.simulate)};
}

std::optional<TableObjection> objection(const std::any& tables) {
  const auto& [design, assume, require, simulate] = std::any_cast<const SingleChannelEkfTables&>(tables);
  const bool by_variances = design.variances.has_value();
  const bool by_ratio = design.lambda.has_value();
  const bool consistent = by_ratio ? !design.q && !design.r && !by_variances
                                   : design.r.has_value() && design.q.has_value() != by_variances;
  if (consistent) {
    return objection_to(require);
  }
  return TableObjection{"design",
                        "the keys of [design] do not form a valid combination; allowed: q and r; or lambda = "
                        "r/q alone (q = 1); or r with process_noise = { q1 = ..., q2 = ... }"};
}

}  // namespace

const DesignFormat& single_channel_format() {
  static const DesignFormat format{"single-channel-ekf", [] { return std::any(SingleChannelEkfTables{}); },
                                   bind_tables, objection};
  return format;
}

}  // namespace veritrack::certificates
