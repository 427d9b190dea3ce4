// The keys of a design file for the tracker "dft-block-ekf".
#include <array>
#include <limits>

#include "analysis/dft_block/tone_sums.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/dft_block/dft_block_design.hpp"

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
    Key<Chosen>{"q1", kPositive, real<&Chosen::q1, positive>, kRequired},
    Key<Chosen>{"q2", kPositive, real<&Chosen::q2, positive>, kRequired},
    Key<Chosen>{"q3", kPositive, real<&Chosen::q3, positive>, kRequired},
    Key<Chosen>{"r", kPositive, real<&Chosen::r, positive>, kRequired},
    Key<Chosen>{"half_width", "a whole number from 1 to 8", half_width, defaults_to("2")},
};
using Assumed = BlockAssumptions;
constexpr std::array kBlockAssumeKeys{
    Key<Assumed>{"amplitude", "a number above 0, or [lowest, highest] of two", block_amplitude,
                 defaults_to("1")},
    Key<Assumed>{"offset", "[lowest, highest], two numbers of bins from -8 to 8", block_offset, kRequired},
    Key<Assumed>{"noise", kNotNegative, real<&Assumed::noise, not_negative>, kRequired},
    Key<Assumed>{"slew", kNotNegative, real<&Assumed::slew, not_negative>, defaults_to("0")},
    Key<Assumed>{"initial_amplitude_error", kAtLeastZeroBelowOne,
                 real<&Assumed::initial_amplitude_error, at_least_zero_below_one>, kRequired},
    Key<Assumed>{"initial_phase_error", kNotNegative, real<&Assumed::initial_phase_error, not_negative>,
                 kRequired},
    Key<Assumed>{"initial_offset_error", kNotNegative, real<&Assumed::initial_offset_error, not_negative>,
                 kRequired},
    Key<Assumed>{"initial_covariance",
                 "\"steady-state\", or a symmetric array of three arrays of three numbers", block_covariance,
                 defaults_to("\"steady-state\"")},
};
using Required = BlockRequirements;
constexpr std::array kBlockRequireKeys{
    Key<Required>{"offset_error_below", kPositive, block_requirement<&Required::offset_error_below>,
                  kOptional},
    Key<Required>{"settles_within", "a whole number of blocks, 1 or more; with settled_below",
                  settles_within_blocks, kOptional},
    Key<Required>{"settled_below", "a number above 0; with settles_within",
                  block_requirement<&Required::settled_below>, kOptional},
};
using Simulated = BlockSimulation;
constexpr std::int64_t kMostBlocks = 100'000;
constexpr std::array kBlockSimulateKeys{
    Key<Simulated>{"blocks", "a whole number from 1 to 100000", integer<&Simulated::blocks, 1, kMostBlocks>,
                   defaults_to("60")},
    Key<Simulated>{"seed", "a whole number, 0 or more",
                   integer<&Simulated::seed, 0, std::numeric_limits<std::int64_t>::max()>, defaults_to("1")},
};

std::vector<BoundTable> bind_block_tables(std::any& tables) {
  auto& target = std::any_cast<BlockTables&>(tables);
  return {bound_table("design", kBlockDesignKeys, target.design),
          bound_table("assume", kBlockAssumeKeys, target.assume),
          bound_table("require", kBlockRequireKeys, target.require),
          bound_table("simulate", kBlockSimulateKeys, target.simulate)};
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
  return std::nullopt;
}

}  // namespace

const DesignFormat& dft_block_format() {
  static const DesignFormat format{"dft-block-ekf", [] { return std::any(BlockTables{}); }, bind_block_tables,
                                   block_objection};
  return format;
}

}  // namespace veritrack::certificates
