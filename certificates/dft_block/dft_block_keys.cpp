// The keys of a design file for the tracker "dft-block-ekf".
#include <fmt/format.h>

#include <array>
#include <limits>

#include "analysis/dft_block/tone_sums.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/sets/set_keys.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

bool is_half_width(const Interval& x) {
  return rigor::certainly_less_equal(Interval(1.0), x) &&
         rigor::certainly_less_equal(x, Interval(dft_block::kMostHalfWidth));
}
void half_width(const TomlValue& value, BlockDesignTable& design) {
  design.half_width = value.whole_number(is_half_width);
}

template <auto member, int lowest>
void whole_samples(const TomlValue& value, BlockDesignTable& design) {
  constexpr double kMost = 1e9;
  design.*member = value.whole_number([](const Interval& x) {
    return rigor::certainly_less_equal(Interval(lowest), x) &&
           rigor::certainly_less_equal(x, Interval(kMost));
  });
}

void block_noise(const TomlValue& value, BlockAssumptions& assume) {
  read_noise(value, assume.noise, assume.gaussian);
}
void probability_blocks(const TomlValue& value, BlockAssumptions& assume) {
  assume.blocks = value.real(is_number_of_samples);
}
bool is_probability(const Interval& x) {
  return rigor::certainly_positive(x) && rigor::certainly_less(x, Interval(1.0));
}
void block_probability(const TomlValue& value, BlockRequirements& require) {
  require.probability_of_losing_lock_below = value.real(is_probability);
}

/// Two numbers of which the second is not the smaller one.
std::array<Number, 2> ordered_pair(const TomlValue& value, RealPredicate is_allowed) {
  const std::vector<TomlValue> bounds = value.elements(2);
  std::array<Number, 2> pair{bounds[0].real(is_allowed), bounds[1].real(is_allowed)};
  const bool is_ordered = pair[0].nearest <= pair[1].nearest;
  if (!is_ordered) {
    value.refuse("[" + printable(pair[0].text, 40) + ", " + printable(pair[1].text, 40) + "]");
  }
  return pair;
}

void block_amplitude(const TomlValue& value, BlockAssumptions& assume) {
  assume.one_amplitude = !value.is_array();
  if (assume.one_amplitude) {
    const Number number = value.real(positive);
    assume.amplitude = {number, number};
  } else {
    assume.amplitude = ordered_pair(value, positive);
  }
}

bool within_bins(const Interval& x) {
  const Interval most(dft_block::kMostHalfWidth);
  return rigor::certainly_less_equal(-most, x) && rigor::certainly_less_equal(x, most);
}
void block_offset(const TomlValue& value, BlockAssumptions& assume) {
  assume.offset = ordered_pair(value, within_bins);
}

void block_covariance(const TomlValue& value, BlockAssumptions& assume) {
  assume.initial_covariance.clear();
  if (value.is_string()) {
    constexpr std::array<std::string_view, 1> kChoices{"steady-state"};
    std::string choice;
    choose(value, kChoices, choice);
    return;
  }
  for (const TomlValue& row : value.elements(3)) {
    for (const TomlValue& entry : row.elements(3)) {
      assume.initial_covariance.push_back(entry.real(any_number));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!same_number(assume.initial_covariance[3 * i + j], assume.initial_covariance[3 * j + i])) {
        value.refuse("a matrix that is not symmetric");
      }
    }
  }
}

template <auto member>
void block_requirement(const TomlValue& value, BlockRequirements& require) {
  require.*member = value.real(positive);
}
void settles_within_blocks(const TomlValue& value, BlockRequirements& require) {
  require.settles_within = value.whole_number(positive);
}

using Chosen = BlockDesignTable;
constexpr std::array kBlockDesignKeys{
    Key<Chosen>{"q1", kPositive, real<&Chosen::q1, positive>, kRequired, kNoContract},
    Key<Chosen>{"q2", kPositive, real<&Chosen::q2, positive>, kRequired, kNoContract},
    Key<Chosen>{"q3", kPositive, real<&Chosen::q3, positive>, kRequired, kNoContract},
    Key<Chosen>{"r", kPositive, real<&Chosen::r, positive>, kRequired, kNoContract},
    Key<Chosen>{"half_width", "a whole number from 1 to 8", half_width, defaults_to("2"), kNoContract},
    Key<Chosen>{"block_length", "a whole number of samples from 7 to 1e9",
                whole_samples<&Chosen::block_length, 7>, kOptional, kOnlyEqual},
    Key<Chosen>{"centre", "a whole number from 2 to 1e9", whole_samples<&Chosen::centre, 2>, kOptional,
                kOnlyEqual},
};
using Assumed = BlockAssumptions;
constexpr std::array kBlockAssumeKeys{
    Key<Assumed>{"amplitude", "a number above 0, or [lowest, highest] of two", block_amplitude,
                 defaults_to("1"), kWider},
    Key<Assumed>{"offset", "[lowest, highest], two numbers of bins from -8 to 8", block_offset, kRequired,
                 kWider},
    Key<Assumed>{"noise", kNoiseThatMayBeGaussian, block_noise, kRequired, kContractOfNoise},
    Key<Assumed>{"blocks", kSamplesOfProbability, probability_blocks, kOptional, kMore},
    Key<Assumed>{"slew", kNotNegative, real<&Assumed::slew, not_negative>, defaults_to("0"), kMore},
    Key<Assumed>{"initial_amplitude_error", kAtLeastZeroBelowOne,
                 real<&Assumed::initial_amplitude_error, at_least_zero_below_one>, kRequired, kMore},
    Key<Assumed>{"initial_phase_error", kNotNegative, real<&Assumed::initial_phase_error, not_negative>,
                 kRequired, kMore},
    Key<Assumed>{"initial_offset_error", kNotNegative, real<&Assumed::initial_offset_error, not_negative>,
                 kRequired, kMore},
    Key<Assumed>{"initial_covariance",
                 "\"steady-state\", or a symmetric array of three arrays of three numbers", block_covariance,
                 defaults_to("\"steady-state\""), kWider},
};
using Required = BlockRequirements;
constexpr std::array kBlockRequireKeys{
    Key<Required>{"offset_error_below", kPositive, block_requirement<&Required::offset_error_below>,
                  kOptional, kLess},
    Key<Required>{"settles_within", "a whole number of blocks, 1 or more; with settled_below",
                  settles_within_blocks, kOptional, kLess},
    Key<Required>{"settled_below", "a number above 0; with settles_within",
                  block_requirement<&Required::settled_below>, kOptional, kLess},
    Key<Required>{"probability_of_losing_lock_below", "a number above 0 and below 1; with Gaussian noise",
                  block_probability, kOptional, kLess},
};
using Simulated = BlockSimulation;
constexpr std::int64_t kMostBlocks = 100'000;
constexpr std::array kBlockSimulateKeys{
    Key<Simulated>{"blocks", "a whole number from 1 to 100000", integer<&Simulated::blocks, 1, kMostBlocks>,
                   defaults_to("60"), kNoContract},
    Key<Simulated>{"seed", "a whole number, 0 or more",
                   integer<&Simulated::seed, 0, std::numeric_limits<std::int64_t>::max()>, defaults_to("1"),
                   kNoContract},
};

std::vector<BoundTable> bind_block_tables(std::any& tables) {
  auto& target = std::any_cast<BlockTables&>(tables);
  return {bound_table("design", kBlockDesignKeys, target.design),
          bound_table("assume", kBlockAssumeKeys, target.assume),
          bound_table("require", kBlockRequireKeys, target.require),
          bound_table("simulate", kBlockSimulateKeys, target.simulate)};
}

/// The keys that go with Gaussian noise, and those that go with a bound.
std::optional<TableObjection> objection_to_noise(const BlockTables& read) {
  const bool is_gaussian = read.assume.gaussian.has_value();
  if (is_gaussian != read.assume.blocks.has_value()) {
    return TableObjection{"assume", is_gaussian
                                        ? "Gaussian noise without blocks, within which lock is not to "
                                          "be lost; allowed: a number of blocks"
                                        : "blocks with a bound on the noise; allowed: with Gaussian "
                                          "noise, noise = { snr_db = ... } or { deviation = ... }"};
  }
  if (is_gaussian && !read.design.block_length) {
    return TableObjection{"design",
                          "no block_length with Gaussian noise, which is that of the samples; allowed: the "
                          "number of samples in a block"};
  }
  if (is_gaussian && read.assume.gaussian->snr_db && !read.assume.one_amplitude) {
    return TableObjection{"assume",
                          "noise = { snr_db = ... } with a range of amplitudes; allowed: one amplitude, or "
                          "noise = { deviation = ... }"};
  }
  const BlockRequirements& require = read.require;
  if (is_gaussian ? require.offset_error_below || require.settles_within
                  : require.probability_of_losing_lock_below.has_value()) {
    return TableObjection{
        "require", is_gaussian ? "offset_error_below, settles_within or settled_below with Gaussian noise, "
                                 "which has no bound; allowed: probability_of_losing_lock_below"
                               : "probability_of_losing_lock_below with a bound on the noise; allowed: "
                                 "with Gaussian noise"};
  }
  return std::nullopt;
}

/// White noise is independent from bin to bin strictly between bin 0 and bin T/2: those two are real, and bin
/// T - m is the conjugate of bin m. Without a centre, M = L + 1 is the lowest for which all bins are there.
std::optional<TableObjection> objection_to_bins(const BlockDesignTable& design) {
  if (!design.block_length) {
    return design.centre ? std::optional(TableObjection{
                               "design", "centre without block_length; allowed: both, or block_length alone"})
                         : std::nullopt;
  }
  const Interval width = design.half_width.value;
  const Interval centre = design.centre ? design.centre->value : width + Interval(1.0);
  if (rigor::certainly_less(width, centre) &&
      rigor::certainly_less(Interval(2.0) * (centre + width), design.block_length->value)) {
    return std::nullopt;
  }
  return TableObjection{
      "design",
      fmt::format("the bins M - L ... M + L, {}, are not all between 1 and half of block_length = {}, where "
                  "white noise is independent from bin to bin; allowed: {}",
                  design.centre
                      ? fmt::format("{} - {} ... {} + {}", design.centre->text, design.half_width.text,
                                    design.centre->text, design.half_width.text)
                      : fmt::format("2*{} + 1 of them", design.half_width.text),
                  design.block_length->text,
                  design.centre ? "half_width < centre < block_length/2 - half_width"
                                : "block_length > 4 half_width + 2")};
}

std::optional<TableObjection> block_objection(const std::any& tables) {
  const auto& read = std::any_cast<const BlockTables&>(tables);
  if (read.require.settles_within.has_value() != read.require.settled_below.has_value()) {
    return TableObjection{"require", "settles_within or settled_below alone; allowed: both, or neither"};
  }
  if (!read.assume.one_amplitude && read.assume.initial_covariance.empty()) {
    return TableObjection{"assume",
                          "initial_covariance \"steady-state\" with a range of amplitudes, each of which has "
                          "another; allowed: a matrix"};
  }
  if (auto objection = objection_to_bins(read.design)) {
    return objection;
  }
  return objection_to_noise(read);
}

}  // namespace

const DesignFormat& dft_block_format() {
  static const DesignFormat format{"dft-block-ekf", [] { return std::any(BlockTables{}); }, bind_block_tables,
                                   block_objection};
  return format;
}

}  // namespace veritrack::certificates
