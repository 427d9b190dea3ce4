#include "checker/model/gain/phase_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "checker/model/gain/phase_lags.hpp"
#include "checker/model/gain/size_vectors.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostPhaseStates = 32;
constexpr std::size_t kMostPhases = 512;
constexpr std::size_t kLongestPhaseHorizon = 1U << 16U;

bool is_size_table(const Table& table, std::size_t n) {
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0.0; };
  return table.size() == n && std::all_of(table.begin(), table.end(), [&](const auto& row) {
           return row.size() == n && std::all_of(row.begin(), row.end(), is_size);
         });
}

bool is_stage(const PhaseStage& stage, const PhaseLoop& loop, std::size_t n) {
  bool is_one = is_size_table(stage.matrix_error, n) && stage.column_errors.size() == loop.inputs.size();
  for (std::size_t input = 0; is_one && input < loop.inputs.size(); ++input) {
    for (const std::size_t part : {0U, 1U}) {
      const std::vector<double>& errors = stage.column_errors[input][part];
      const bool is_there = part == 0 || !loop.inputs[input].second.is_empty();
      is_one =
          is_one && errors.size() == (is_there ? n : 0) &&
          std::all_of(errors.begin(), errors.end(), [](double x) { return std::isfinite(x) && x >= 0.0; });
    }
  }
  return is_one;
}

/// The lags of a block.
std::size_t late_lags_of(const PhaseLoop& loop) {
  return static_cast<std::size_t>(
      std::ceil(static_cast<double>(loop.horizon.late_turns * loop.phases) / loop.low));
}

/// Late lags need a constant frequency that is certainly above 0 and below a turn in a sample.
bool has_late_band(const PhaseLoop& loop) {
  constexpr std::size_t kMostBlocks = 4096;
  constexpr double kMostLags = 0x1p16;  // of a block
  return loop.slew == 0.0 && loop.low > 0.0 && loop.high < static_cast<double>(loop.phases) &&
         loop.horizon.late_blocks <= kMostBlocks && loop.horizon.late_turns >= 1 &&
         static_cast<double>(loop.horizon.late_turns * loop.phases) <= kMostLags * loop.low;
}

/// The frequencies are known, and do not go further than twice around in a sample at any lag.
bool has_band(const PhaseLoop& loop) {
  const double turn = 2.0 * static_cast<double>(loop.phases);
  const double more = up(0.5 * static_cast<double>(loop.horizon.single + 1) * loop.slew);
  return std::isfinite(loop.low) && std::isfinite(loop.high) && loop.low <= loop.high && loop.slew >= 0.0 &&
         (loop.horizon.late_blocks == 0 || has_late_band(loop)) && std::isfinite(more) &&
         loop.low - more >= -turn && loop.high + more <= turn;
}

bool is_loop(const PhaseLoop& loop) {
  const std::size_t n = loop.matrix[0].size();
  const std::size_t phases = loop.phases;
  if (n < 1 || n > kMostPhaseStates || phases < 8 || phases > kMostPhases || (phases & (phases - 1)) != 0 ||
      loop.horizon.single < 1 || loop.horizon.single > kLongestPhaseHorizon || loop.forms.empty() ||
      loop.inputs.empty() || loop.stages.empty() || loop.stages.front().first_lag != 0 ||
      loop.has_one_size.size() != loop.inputs.size() || !has_band(loop)) {
    return false;
  }
  const auto is_grid = [&](const GridFunction& f) { return is_grid_function(f, phases, n); };
  const auto is_matrix = [&](const Table& matrix) {
    return matrix.size() == n && std::all_of(matrix.begin(), matrix.end(), [&](const auto& row) {
             return row.size() == n &&
                    std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
           });
  };
  return is_matrix(loop.matrix[0]) && is_matrix(loop.matrix[1]) &&
         std::all_of(loop.forms.begin(), loop.forms.end(), is_grid) &&
         std::all_of(loop.inputs.begin(), loop.inputs.end(),
                     [&](const PhaseInput& input) {
                       return is_grid(input.first) && (input.second.is_empty() || is_grid(input.second));
                     }) &&
         std::all_of(loop.stages.begin(), loop.stages.end(),
                     [&](const PhaseStage& stage) { return is_stage(stage, loop, n); });
}

}  // namespace

PhaseSizes::PhaseSizes(const std::vector<double>& sizes) : most{sizes} {
  const std::size_t phases = sizes.size();
  for (const double size : sizes) {
    largest = size >= 0.0 && size <= HUGE_VAL ? std::max(largest, size) : HUGE_VAL;
  }
  for (std::size_t width = 1; width < phases; width *= 2) {
    std::vector<double> wider(phases);
    for (std::size_t g = 0; g < phases; ++g) {
      wider[g] = std::max(most.back()[g], most.back()[(g + width) % phases]);
    }
    most.push_back(std::move(wider));
  }
  for (std::vector<double>& of_level : most) {
    of_level.resize(2 * phases);
    std::copy_n(of_level.begin(), phases, of_level.begin() + static_cast<std::ptrdiff_t>(phases));
  }
}

PhaseKernels::PhaseKernels(const PhaseLoop& loop)
    : phases_(loop.phases),
      states_(loop.matrix[0].size()),
      horizon_(loop.horizon.single),
      forms_(loop.forms.size()),
      inputs_(loop.inputs.size()) {
  if (!is_loop(loop)) {
    return;
  }
  matrix_ = loop.matrix;
  late_lags_ = loop.horizon.late_blocks > 0 ? late_lags_of(loop) : 0;
  step_ = loop.high;
  while ((std::size_t{1} << levels_) < phases_) {
    ++levels_;
  }
  allocate(loop);
  sum_up(loop);
  is_valid_ = true;
}

void PhaseKernels::allocate(const PhaseLoop& loop) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> numbers;
  for (std::size_t lag = 0; lag < horizon_; ++lag) {
    const LagPlace place(loop, lag);
    std::size_t level = 0;  // more cells than it is from only make the weight larger
    while (level < levels_ && std::ldexp(1.0, static_cast<int>(level)) < place.cells) {
      ++level;
    }
    const std::size_t first = level == levels_ ? 0 : place.first;
    const auto [found, is_new] = numbers.try_emplace({level, first}, sources_.size());
    if (is_new) {
      sources_.push_back({level, first});
    }
    source_of_lag_.push_back(found->second);
  }
  spend(static_cast<std::int64_t>(forms_ * inputs_ * sources_.size() * phases_));
  power_sum_.assign(states_, std::vector<double>(states_, 0.0));
  rest_.assign(forms_, std::vector<double>(inputs_, 0.0));
  defect_.assign(states_, std::vector<double>(states_, 0.0));
  totals_.assign(inputs_, std::vector<double>(states_, 0.0));
}

std::vector<double> PhaseKernels::total_of(const std::vector<double>& s) const {
  return product_above(power_sum_, s);
}

std::vector<double> PhaseKernels::largest_from(std::size_t first, const std::vector<double>& s) const {
  NearPowers powers(matrix_);
  std::vector<double> most(states_, 0.0);
  for (std::size_t lag = 0; lag < horizon_; ++lag) {
    const std::vector<double> size = powers.times(s);
    for (std::size_t i = 0; i < states_ && lag >= first; ++i) {
      most[i] = std::isfinite(size[i]) ? std::max(most[i], up(size[i]) + kManyUnderflows) : HUGE_VAL;
    }
    powers.advance();
  }
  for (std::size_t block = 0; block < largest_late_.size(); ++block) {
    if (horizon_ + (block + 1) * late_lags_ > first) {
      raise_all(most, product_above(largest_late_[block], s));
    }
  }
  return most;
}

void PhaseKernels::add(std::size_t form, std::size_t input, const PhaseSizes& sizes, EndSums& sums) const {
  const std::vector<float>& of = sums_[place_of(form, input)];
  if (of.size() == phases_) {  // of one size
    for (std::size_t g = 0; g < phases_; ++g) {
      const double size = sizes.largest;
      sums.left[g] += size * static_cast<double>(of[g]);
      sums.right[g] += size * static_cast<double>(of[g + 1 == phases_ ? 0 : g + 1]);
    }
    return;
  }
  if (!largest_late_.empty()) {
    add_late(form, input, sizes, sums);
  }
  for (std::size_t source = 0; source < sources_.size(); ++source) {
    const float* const sum = of.data() + source * phases_;
    const double* const weight = sizes.most[sources_[source].level].data() + sources_[source].first;
    for (std::size_t g = 0; g < phases_; ++g) {
      sums.left[g] += weight[g] * static_cast<double>(sum[g]);
    }
    for (std::size_t g = 0; g + 1 < phases_; ++g) {
      sums.right[g] += weight[g] * static_cast<double>(sum[g + 1]);
    }
    sums.right[phases_ - 1] += weight[phases_ - 1] * static_cast<double>(sum[0]);
  }
}

double PhaseKernels::of_form(std::size_t form, const std::vector<double>& bound) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < states_; ++i) {
    sum += upward_product(form_sizes_[form][i], bound[i]);
  }
  return up(sum);
}

double PhaseKernels::rest(std::size_t form, std::size_t input, const std::vector<double>& bound) const {
  std::vector<double> late(states_);
  for (std::size_t i = 0; i < states_; ++i) {
    for (std::size_t j = 0; j < states_; ++j) {
      late[i] += upward_product(defect_[i][j], bound[j]);
    }
    late[i] = up(late[i]);
  }
  return up(rest_[form][input] + of_form(form, late));
}

}  // namespace veritrack::checker
