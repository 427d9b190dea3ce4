#include "checker/model/gain/gain_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace veritrack::checker {

namespace {

// Sums of at most 2^13 products of numbers that are not negative are computed in doubles: they are at most
// 2^-38 of their size larger than computed, and by what is lost to underflow. Sums of products of any sign
// have errors of at most kError of the sum of absolute values, of up to 64 terms.
constexpr double kMargin = 1.0 + 0x1p-36;
constexpr double kUnderflow = 0x1p-1000;
constexpr double kError = 0x1p-45;
constexpr double kGrowth = 1.0 + 0x1p-20;
constexpr int kMostRounds = 3000;
constexpr std::size_t kMostStates = 32;
const double kInfinity = HUGE_VAL;

/// Of a sum of numbers that are not negative.
double up(double sum) {
  return sum * kMargin;
}

/// Of numbers that are not negative, with what may be lost to underflow; exactly 0 where one of them is.
double product(double x, double y) {
  return x == 0.0 || y == 0.0 ? 0.0 : x * y + kUnderflow;
}

/// Infinite where it is not known.
double upper(const Ball& x) {
  const double bound = x.finite() ? x.upper_double() : kInfinity;
  return bound >= 0.0 ? bound : bound < 0.0 ? 0.0 : kInfinity;
}

WideNumber wide(const Ball& x) {
  const double middle = x.near();
  return {middle, upper(abs(x - Ball(middle)))};
}

double largest_size(const WideNumber& x) {
  return up(std::abs(x.middle) + x.radius);
}

/// The sum of products. `middle` is the sum of products of the middles, as computed.
WideNumber dot(const WideRow& x, const WideRow& y) {
  WideNumber result;
  double spread = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    result.middle += x[i].middle * y[i].middle;
    const double size = std::abs(y[i].middle);
    spread += product(x[i].radius, size + y[i].radius) +
              product(std::abs(x[i].middle), y[i].radius + product(kError, size));
  }
  result.radius = up(spread);
  return result;
}

double length(const WideNumber& x, const WideNumber& y) {
  const double first = largest_size(x);
  const double second = largest_size(y);
  return second == 0.0 ? first : up(std::sqrt(up(product(first, first) + product(second, second))));
}

/// The powers of the middle of a matrix in doubles, one after the other: G_0 = I, ..., G_(K-1).
class Powers {
 public:
  explicit Powers(const std::vector<WideRow>& columns) : columns_(&columns), rows_(columns.size()) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      rows_[i].assign(columns.size(), {0.0, 0.0});
      rows_[i][i].middle = 1.0;
    }
  }
  /// The next one, and the size of its difference to G A, which is added to `defect`. The last one is 0.
  void advance(std::vector<std::vector<double>>& defect, bool is_last) {
    spend(static_cast<std::int64_t>(rows_.size() * rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      WideRow next(rows_.size());
      for (std::size_t j = 0; j < rows_.size(); ++j) {
        const WideNumber entry = dot(rows_[i], (*columns_)[j]);
        defect[i][j] = up(defect[i][j] + (is_last ? largest_size(entry) : entry.radius));
        next[j] = {is_last ? 0.0 : entry.middle, 0.0};
      }
      rows_[i] = std::move(next);
    }
  }
  /// row G.
  [[nodiscard]] WideRow product(const WideRow& row) const {
    WideRow result(rows_.size());
    WideRow column(rows_.size());
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        column[i] = rows_[i][j];
      }
      result[j] = dot(row, column);
    }
    return result;
  }

 private:
  const std::vector<WideRow>* columns_;
  std::vector<WideRow> rows_;
};

/// A T >= given + M T, or nothing.
std::optional<std::vector<double>> closed(const std::vector<std::vector<double>>& defect,
                                          const std::vector<double>& given) {
  constexpr int kRounds = 100;
  std::vector<double> bound = given;
  for (int round = 0; round < kRounds; ++round) {
    bool is_closed = true;
    std::vector<double> next(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      double sum = given[i];
      for (std::size_t j = 0; j < given.size(); ++j) {
        sum += product(defect[i][j], bound[j]);
      }
      next[i] = up(sum);
      is_closed = is_closed && std::isfinite(next[i]) && next[i] <= bound[i];
    }
    if (is_closed) {
      return bound;
    }
    for (std::size_t i = 0; i < given.size(); ++i) {
      bound[i] = next[i] * kGrowth;
    }
  }
  return std::nullopt;
}

}  // namespace

Ball GainErrors::from_block(std::size_t block) const {
  const auto first = by_block_.begin() + static_cast<std::ptrdiff_t>(block);
  return Ball(*std::max_element(first, by_block_.end())) + Ball(bias_);  // all are finite
}

Ball GainErrors::from(const Ball& sample) const {
  const double whole = std::floor(sample.lower_double() / static_cast<double>(block_length_));
  const double last = static_cast<double>(by_block_.size() - 1);
  return from_block(whole >= last  ? by_block_.size() - 1
                    : whole >= 1.0 ? static_cast<std::size_t>(whole)
                                   : 0);
}

GainBounds::GainBounds(const GainNetwork& network, std::size_t horizon, std::size_t blocks)
    : network_(&network), horizon_(horizon), blocks_(blocks) {
  const std::size_t n = network.states();
  if (n == 0 || n > kMostStates || blocks == 0 || horizon % blocks != 0) {
    return;
  }
  bool is_finite = true;
  const auto read = [&](const Ball& x) {
    is_finite = is_finite && x.finite() && std::isfinite(x.upper_double()) && std::isfinite(x.lower_double());
    return wide(x);
  };
  columns_.assign(n, WideRow(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      columns_[j][i] = read(network.matrix[i][j]);
    }
  }
  for (const GainInput& input : network.inputs) {
    std::vector<WideRow> both(2);
    for (const InputFactor& factor : input.column) {
      both[0].push_back(read(factor.first));
      both[1].push_back(read(factor.second));
    }
    inputs_.push_back(std::move(both));
  }
  for (const GainForm& form : network.forms) {
    WideRow row;
    for (const Ball& factor : form.row) {
      row.push_back(read(factor));
    }
    rows_.push_back(std::move(row));
    direct_.emplace_back(network.inputs.size(), 0.0);
    for (const auto& [input, factor] : form.direct) {
      direct_.back()[input] = length(read(factor.first), read(factor.second));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    rows_.emplace_back(n);
    rows_.back()[i].middle = 1.0;
  }
  if (is_finite) {
    sum_kernels();
    is_certain_ = close_tails();
  }
}

double GainBounds::length_of_product(const WideRow& row, std::size_t input) const {
  return length(dot(row, inputs_[input][0]), dot(row, inputs_[input][1]));
}

void GainBounds::sum_kernels() {
  kernels_.assign(rows_.size(),
                  std::vector<std::vector<double>>(inputs_.size(), std::vector<double>(blocks_, 0.0)));
  defect_.assign(columns_.size(), std::vector<double>(columns_.size(), 0.0));
  Powers powers(columns_);
  const std::size_t block_length = horizon_ / blocks_;
  for (std::size_t k = 0; k < horizon_; ++k) {
    spend(static_cast<std::int64_t>(rows_.size() * (inputs_.size() + columns_.size())));
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const WideRow of_row = powers.product(rows_[row]);
      for (std::size_t input = 0; input < inputs_.size(); ++input) {
        double& sum = kernels_[row][input][k / block_length];
        sum = sum + length_of_product(of_row, input);
      }
    }
    powers.advance(defect_, k + 1 == horizon_);
  }
  // A sum of block_length numbers: an error of at most that many times 2^-52.
  const double margin = 1.0 + static_cast<double>(block_length) * 0x1p-50;
  for (auto& of_row : kernels_) {
    for (auto& of_input : of_row) {
      for (double& sum : of_input) {
        sum = up(sum * margin);
      }
    }
  }
}

bool GainBounds::close_tails() {
  const std::size_t n = columns_.size();
  const std::size_t forms = network_->forms.size();
  tails_.assign(forms, std::vector<double>(inputs_.size(), 0.0));
  for (std::size_t input = 0; input < inputs_.size(); ++input) {
    std::vector<double> total(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double>& parts = kernels_[forms + i][input];
      double sum = 0.0;
      for (const double part : parts) {
        sum += part;
      }
      total[i] = up(sum);
    }
    const std::optional<std::vector<double>> bound = closed(defect_, total);
    if (!bound) {
      return false;
    }
    for (std::size_t form = 0; form < forms; ++form) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          sum += product(largest_size(rows_[form][i]), product(defect_[i][j], (*bound)[j]));
        }
      }
      tails_[form][input] = up(sum);
    }
  }
  return true;
}

std::optional<GainBounds::Table> GainBounds::starts(const std::vector<Ball>& start) const {
  const std::size_t n = columns_.size();
  const std::size_t forms = network_->forms.size();
  Table result(forms, std::vector<double>(blocks_ + 1, 0.0));
  std::vector<double> size;
  for (const Ball& each : start) {
    size.push_back(upper(each));
  }
  if (std::all_of(size.begin(), size.end(), [](double each) { return each == 0.0; })) {
    return result;
  }
  std::vector<double> most(n, 0.0);
  Table ignored = defect_;
  Powers powers(columns_);
  for (std::size_t k = 0; k < horizon_; ++k) {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const WideRow of_row = powers.product(rows_[row]);
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        sum += product(largest_size(of_row[j]), size[j]);
      }
      double& entry = row < forms ? result[row][k / (horizon_ / blocks_)] : most[row - forms];
      entry = std::max(entry, std::isfinite(sum) ? up(sum) : kInfinity);
    }
    powers.advance(ignored, k + 1 == horizon_);
  }
  const std::optional<std::vector<double>> bound = closed(defect_, most);
  if (!bound) {
    return std::nullopt;
  }
  for (std::size_t form = 0; form < forms; ++form) {
    double tail = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        tail += product(largest_size(rows_[form][i]), product(defect_[i][j], (*bound)[j]));
      }
    }
    for (double& entry : result[form]) {
      entry = up(entry + up(tail));
    }
  }
  return result;
}

GainBounds::Given GainBounds::given(const Ball& noise, const Ball& slew,
                                    const std::vector<Ball>& start) const {
  Given result;
  const std::optional<Table> of_start = starts(start);
  if (!of_start) {
    result.is_known = false;
    return result;
  }
  result.start = *of_start;
  for (std::size_t form = 0; form < network_->forms.size(); ++form) {
    double sum = 0.0;
    for (std::size_t input = 0; input < inputs_.size(); ++input) {
      if (network_->inputs[input].is_remainder()) {
        continue;
      }
      double kernel = tails_[form][input] + direct_[form][input];
      for (const double part : kernels_[form][input]) {
        kernel += part;
      }
      sum += product(up(kernel), upper(network_->inputs[input].size(noise, slew)));
    }
    result.outside.push_back(up(sum));
  }
  return result;
}

std::vector<double> GainBounds::sizes(const std::vector<double>& bounds) const {
  std::vector<double> result(inputs_.size(), 0.0);
  for (std::size_t input = 0; input < inputs_.size(); ++input) {
    const GainInput& entry = network_->inputs[input];
    if (entry.is_remainder()) {
      std::vector<Ball> about;
      for (const std::size_t form : entry.about) {
        about.emplace_back(bounds[form]);
      }
      result[input] = upper(entry.at_bounds(about));
    }
  }
  return result;
}

GainBounds::Table GainBounds::next(const Table& bounds, const Given& given) const {
  const std::size_t forms = network_->forms.size();
  Table z;  // by block and input
  for (const std::vector<double>& of_block : bounds) {
    z.push_back(sizes(of_block));
  }
  Table result(blocks_ + 1, std::vector<double>(forms));
  for (std::size_t form = 0; form < forms; ++form) {
    for (std::size_t m = 0; m <= blocks_; ++m) {
      result[m][form] = given.start[form][m] + given.outside[form];
    }
  }
  for (std::size_t input = 0; input < inputs_.size(); ++input) {
    if (!network_->inputs[input].is_remainder()) {
      continue;
    }
    // The largest from each block on.
    std::vector<double> later(blocks_ + 1);
    for (std::size_t m = blocks_ + 1; m-- > 0;) {
      later[m] = m == blocks_ ? z[m][input] : std::max(z[m][input], later[m + 1]);
    }
    std::vector<double> pair(blocks_);  // of a block and the one before
    for (std::size_t m = 0; m < blocks_; ++m) {
      pair[m] = m == 0 ? z[0][input] : std::max(z[m - 1][input], z[m][input]);
    }
    spend(static_cast<std::int64_t>(forms * blocks_ * blocks_ / 8));
    for (std::size_t form = 0; form < forms; ++form) {
      const std::vector<double>& kernel = kernels_[form][input];
      const double tail = product(tails_[form][input], later[0]);
      for (std::size_t m = 0; m < blocks_; ++m) {
        double sum = product(direct_[form][input], z[m][input]) + tail;
        for (std::size_t p = 0; p <= m; ++p) {
          sum += product(kernel[p], pair[m - p]);
        }
        result[m][form] += sum;
      }
      double sum = product(direct_[form][input], z[blocks_][input]) + tail;
      for (std::size_t p = 0; p < blocks_; ++p) {
        sum += product(kernel[p], later[blocks_ - p - 1]);
      }
      result[blocks_][form] += sum;
    }
  }
  for (std::vector<double>& of_block : result) {
    for (double& bound : of_block) {
      bound = up(bound);
    }
  }
  return result;
}

bool GainBounds::keeps_limits(const std::vector<double>& bounds) const {
  return std::all_of(network_->limits.begin(), network_->limits.end(), [&](const GainLimit& limit) {
    const Ball value = limit.base + Ball::within(Ball(bounds[limit.form]));
    return certainly_less(limit.low, value) && certainly_less(value, limit.high);
  });
}

double GainBounds::in_long_run(std::vector<double> bounds, const Given& given) const {
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<double> z = sizes(bounds);
    bool changes = false;
    std::vector<double> next = bounds;
    for (std::size_t form = 0; form < bounds.size(); ++form) {
      double sum = given.outside[form];
      for (std::size_t input = 0; input < inputs_.size(); ++input) {
        if (network_->inputs[input].is_remainder()) {
          double kernel = direct_[form][input] + tails_[form][input];
          for (const double part : kernels_[form][input]) {
            kernel += part;
          }
          sum += product(up(kernel), z[input]);
        }
      }
      changes = changes || up(sum) * kGrowth < bounds[form];
      next[form] = up(sum) < bounds[form] ? up(sum) : bounds[form];
    }
    bounds = std::move(next);
    if (!changes) {
      break;
    }
  }
  return bounds[network_->error_form];
}

std::optional<GainErrors> GainBounds::errors(const Ball& noise, const Ball& slew,
                                             const std::vector<Ball>& start) const {
  if (!is_certain_ || start.size() != columns_.size() || !certainly_not_negative(noise) ||
      !certainly_not_negative(slew) || !certainly_less(noise, network_->least_amplitude)) {
    return std::nullopt;
  }
  const Given known = given(noise, slew, start);
  if (!known.is_known) {
    return std::nullopt;
  }
  Table bounds(blocks_ + 1, std::vector<double>(network_->forms.size(), 0.0));
  for (int round = 0; round < kMostRounds; ++round) {
    const Table above = next(bounds, known);
    if (!std::all_of(bounds.begin(), bounds.end(), [&](const auto& each) { return keeps_limits(each); })) {
      return std::nullopt;
    }
    bool is_kept = true;
    Table raised = bounds;
    for (std::size_t m = 0; m <= blocks_; ++m) {
      for (std::size_t form = 0; form < above[m].size(); ++form) {
        if (!std::isfinite(above[m][form])) {
          return std::nullopt;
        }
        is_kept = is_kept && above[m][form] <= bounds[m][form];
        raised[m][form] = std::max(bounds[m][form], above[m][form] * kGrowth);
      }
    }
    if (is_kept) {
      std::vector<double> error;
      for (const std::vector<double>& of_block : bounds) {
        error.push_back(of_block[network_->error_form]);
      }
      return GainErrors(error, in_long_run(bounds.back(), known), upper(abs(network_->bias)),
                        horizon_ / blocks_);
    }
    bounds = std::move(raised);
  }
  return std::nullopt;
}

}  // namespace veritrack::checker
