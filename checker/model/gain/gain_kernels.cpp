#include "checker/model/gain/gain_kernels.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostStates = 32;

}  // namespace

GainKernels::GainKernels(const GainNetwork& network, std::size_t horizon, std::size_t blocks)
    : forms_(network.forms.size()), horizon_(horizon), blocks_(blocks) {
  const std::size_t n = network.states();
  if (n > 0 && n <= kMostStates && blocks > 0 && horizon > 0 && horizon % blocks == 0 && read(network)) {
    sum_kernels();
    is_certain_ = close_tails();
  }
}

bool GainKernels::read(const GainNetwork& network) {
  const std::size_t n = network.states();
  bool is_finite = true;
  const auto known = [&](const Ball& x) {
    is_finite = is_finite && x.finite() && std::isfinite(x.upper_double()) && std::isfinite(x.lower_double());
    return wide(x);
  };
  columns_.assign(n, WideRow(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      columns_[j][i] = known(network.matrix[i][j]);
    }
  }
  for (const GainInput& input : network.inputs) {
    std::vector<WideRow> both(2);
    for (const InputFactor& factor : input.column) {
      both[0].push_back(known(factor.first));
      both[1].push_back(known(factor.second));
    }
    inputs_.push_back(std::move(both));
  }
  for (const GainRipple& ripple : network.ripples) {
    inputs_[ripple.input].assign(2, WideRow(n));  // its response is known (gain_ripples.hpp)
  }
  for (const GainForm& form : network.forms) {
    rows_.emplace_back();
    for (const Ball& factor : form.row) {
      rows_.back().push_back(known(factor));
    }
    direct_.emplace_back(network.inputs.size(), 0.0);
    for (const auto& [input, factor] : form.direct) {
      direct_.back()[input] = length(known(factor.first), known(factor.second));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    rows_.emplace_back(n);
    rows_.back()[i].middle = 1.0;
  }
  return is_finite;
}

void GainKernels::sum_kernels() {
  kernels_.assign(rows_.size(), Table(inputs_.size(), std::vector<double>(blocks_, 0.0)));
  defect_.assign(columns_.size(), std::vector<double>(columns_.size(), 0.0));
  MatrixPowers powers(columns_);
  for (std::size_t k = 0; k < horizon_; ++k) {
    spend(static_cast<std::int64_t>(rows_.size() * (inputs_.size() + columns_.size())));
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const WideRow of_row = powers.product(rows_[row]);
      for (std::size_t input = 0; input < inputs_.size(); ++input) {
        kernels_[row][input][k / block_length()] +=
            length(dot(of_row, inputs_[input][0]), dot(of_row, inputs_[input][1]));
      }
    }
    powers.advance(defect_, k + 1 == horizon_);
  }
  // Each is a sum of many numbers: an error of at most so many roundings.
  const double margin = 1.0 + static_cast<double>(block_length()) * 0x1p-50;
  for (Table& of_row : kernels_) {
    for (std::vector<double>& of_input : of_row) {
      for (double& sum : of_input) {
        sum = up(sum * margin);
      }
    }
  }
}

double GainKernels::through_defect(const WideRow& row, const std::vector<double>& bound) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      sum += upward_product(largest_size(row[i]), upward_product(defect_[i][j], bound[j]));
    }
  }
  return up(sum);
}

bool GainKernels::close_tails() {
  const std::size_t n = columns_.size();
  tails_.assign(forms_, std::vector<double>(inputs_.size(), 0.0));
  for (std::size_t input = 0; input < inputs_.size(); ++input) {
    std::vector<double> sums(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (const double part : by_block(forms_ + i, input)) {
        sums[i] += part;
      }
      sums[i] = up(sums[i]);
    }
    const std::optional<std::vector<double>> bound = closed(defect_, sums);
    if (!bound) {
      return false;
    }
    for (std::size_t form = 0; form < forms_; ++form) {
      tails_[form][input] = through_defect(rows_[form], *bound);
    }
  }
  return true;
}

double GainKernels::total(std::size_t form, std::size_t input) const {
  double sum = direct(form, input) + tail(form, input);
  for (const double part : by_block(form, input)) {
    sum += part;
  }
  return up(sum);
}

std::optional<Table> GainKernels::starts(const std::vector<Ball>& start) const {
  const std::size_t n = columns_.size();
  Table result(forms_, std::vector<double>(blocks_ + 1, 0.0));
  std::vector<double> size;
  size.reserve(start.size());
  for (const Ball& each : start) {
    size.push_back(upper(each));
  }
  if (std::all_of(size.begin(), size.end(), [](double each) { return each == 0.0; })) {
    return result;
  }
  std::vector<double> most(n, 0.0);
  Table known = defect_;
  MatrixPowers powers(columns_);
  for (std::size_t k = 0; k < horizon_; ++k) {
    spend(static_cast<std::int64_t>(rows_.size() * n));
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const WideRow of_row = powers.product(rows_[row]);
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        sum += upward_product(largest_size(of_row[j]), size[j]);
      }
      double& entry = row < forms_ ? result[row][k / block_length()] : most[row - forms_];
      entry = std::max(entry, std::isfinite(sum) ? up(sum) : HUGE_VAL);
    }
    powers.advance(known, k + 1 == horizon_);
  }
  const std::optional<std::vector<double>> bound = closed(defect_, most);
  if (!bound) {
    return std::nullopt;
  }
  for (std::size_t form = 0; form < forms_; ++form) {
    const double tail = through_defect(rows_[form], *bound);
    for (double& entry : result[form]) {
      entry = up(entry + tail);
    }
  }
  return result;
}

}  // namespace veritrack::checker
