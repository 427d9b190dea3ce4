#include "analysis/linear/worst_case_gains.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::linear {

using rigor::Interval;

namespace {

using Numbers = std::vector<double>;

/// In the upward rounding mode sums and products of numbers that are not negative are upper bounds.
double sum_up(const Numbers& terms) {
  double sum = 0.0;
  for (const double term : terms) {
    sum = rigor::add_up(sum, term);
  }
  return sum;
}

/// |row B| at most, in Euclidean length.
double length_up(const Row& row, const GainInput& input) {
  Interval squares(0.0);
  double single = 0.0;
  for (const Row& column : input.columns) {
    Interval sum(0.0);
    for (std::size_t i = 0; i < row.size(); ++i) {
      sum += row[i] * column[i];
    }
    single = rigor::magnitude(sum);
    squares += square(sum);
  }
  return input.columns.size() == 1 ? single : sqrt(squares).upper();
}

/// The powers of the middle of A in doubles, one after the other, with the sum of their defects.
class Powers {
 public:
  Powers(const std::vector<Row>& a, std::size_t samples) : a_(&a), n_(a.size()), left_(samples) {
    power_.assign(n_, Numbers(n_, 0.0));
    defect_.assign(n_, Numbers(n_, 0.0));
    for (std::size_t i = 0; i < n_; ++i) {
      power_[i][i] = 1.0;
      middle_.emplace_back();
      for (const Interval& entry : a[i]) {
        middle_.back().push_back(rigor::midpoint(entry));
      }
    }
  }

  [[nodiscard]] const std::vector<Numbers>& power() const { return power_; }
  /// The sum over all samples of |G(k+1) - G(k) A|, once all are done; the last power is followed by 0.
  [[nodiscard]] const std::vector<Numbers>& defect() const { return defect_; }

  void advance() {
    --left_;
    std::vector<Numbers> next(n_, Numbers(n_, 0.0));
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        Interval exact(0.0);
        double near = 0.0;
        for (std::size_t l = 0; l < n_; ++l) {
          exact += Interval(power_[i][l]) * (*a_)[l][j];
          near += power_[i][l] * middle_[l][j];
        }
        next[i][j] = left_ == 0 ? 0.0 : near;
        defect_[i][j] = rigor::add_up(defect_[i][j], rigor::magnitude(Interval(next[i][j]) - exact));
      }
    }
    power_ = std::move(next);
  }

 private:
  const std::vector<Row>* a_;
  std::size_t n_;
  std::size_t left_;
  std::vector<Numbers> power_, defect_, middle_;
};

/// x >= s + M x, from below; empty where none was found.
std::optional<Numbers> solved(const std::vector<Numbers>& m, const Numbers& s) {
  constexpr int kRounds = 200;
  const auto image = [&](const Numbers& x) {
    Numbers y = s;
    for (std::size_t i = 0; i < s.size(); ++i) {
      for (std::size_t j = 0; j < s.size(); ++j) {
        y[i] = rigor::add_up(y[i], rigor::mul_up(m[i][j], x[j]));
      }
    }
    return y;
  };
  Numbers x = s;
  for (int round = 0; round < kRounds; ++round) {
    const Numbers y = image(x);
    bool is_enough = true;
    for (std::size_t i = 0; i < x.size(); ++i) {
      is_enough = is_enough && y[i] <= x[i] && std::isfinite(x[i]);
    }
    if (is_enough) {
      return x;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = y[i] <= x[i] ? x[i] : rigor::mul_up(y[i], 1.0 + 0x1p-30);
    }
  }
  return std::nullopt;
}

Numbers magnitudes(const Row& row) {
  Numbers numbers;
  for (const Interval& entry : row) {
    numbers.push_back(rigor::magnitude(entry));
  }
  return numbers;
}

/// |c| M x.
double missed_by(const Numbers& form, const std::vector<Numbers>& m, const Numbers& x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < form.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      sum = rigor::add_up(sum, rigor::mul_up(form[i], rigor::mul_up(m[i][j], x[j])));
    }
  }
  return sum;
}

/// Sums and largest entries along the horizon.
class Responses {
 public:
  Responses(const std::vector<GainInput>& inputs, const std::vector<Row>& forms, std::size_t states,
            std::size_t blocks)
      : inputs_(&inputs), forms_(&forms), states_(states) {
    gains_.inputs.assign(forms.size(), std::vector<InputGain>(inputs.size(), {Numbers(blocks, 0.0), 0.0}));
    gains_.starts.assign(forms.size(), std::vector<StartGain>(states, {Numbers(blocks, 0.0), 0.0}));
    sums_.assign(inputs.size(), Numbers(states, 0.0));
    largest_.assign(states, Numbers(states, 0.0));
  }

  void add(const std::vector<Numbers>& power, std::size_t block) {
    for (std::size_t f = 0; f < forms_->size(); ++f) {
      Row row;
      for (std::size_t j = 0; j < states_; ++j) {
        Interval sum(0.0);
        for (std::size_t i = 0; i < states_; ++i) {
          sum += (*forms_)[f][i] * Interval(power[i][j]);
        }
        row.push_back(sum);
        double& start = gains_.starts[f][j].blocks[block];
        start = std::max(start, rigor::magnitude(sum));
      }
      for (std::size_t l = 0; l < inputs_->size(); ++l) {
        double& sum = gains_.inputs[f][l].blocks[block];
        sum = rigor::add_up(sum, length_up(row, (*inputs_)[l]));
      }
    }
    for (std::size_t i = 0; i < states_; ++i) {
      Row row;
      for (std::size_t j = 0; j < states_; ++j) {
        row.emplace_back(power[i][j]);
        largest_[j][i] = std::max(largest_[j][i], std::fabs(power[i][j]));
      }
      for (std::size_t l = 0; l < inputs_->size(); ++l) {
        sums_[l][i] = rigor::add_up(sums_[l][i], length_up(row, (*inputs_)[l]));
      }
    }
  }

  [[nodiscard]] std::optional<WorstCaseGains> finish(const std::vector<Numbers>& defect) {
    std::vector<Numbers> of_inputs;
    std::vector<Numbers> of_starts;
    for (const auto& [list, results] : {std::pair(&sums_, &of_inputs), std::pair(&largest_, &of_starts)}) {
      for (const Numbers& each : *list) {
        const std::optional<Numbers> bound = solved(defect, each);
        if (!bound) {
          return std::nullopt;
        }
        results->push_back(*bound);
      }
    }
    for (std::size_t f = 0; f < forms_->size(); ++f) {
      const Numbers form = magnitudes((*forms_)[f]);
      for (std::size_t l = 0; l < inputs_->size(); ++l) {
        gains_.inputs[f][l].missed = missed_by(form, defect, of_inputs[l]);
      }
      for (std::size_t j = 0; j < states_; ++j) {
        StartGain& start = gains_.starts[f][j];
        start.later = missed_by(form, defect, of_starts[j]);
        for (double& each : start.blocks) {
          each = rigor::add_up(each, start.later);
        }
      }
    }
    return std::move(gains_);
  }

 private:
  const std::vector<GainInput>* inputs_;
  const std::vector<Row>* forms_;
  std::size_t states_;
  WorstCaseGains gains_;
  std::vector<Numbers> sums_;     // of |G(k) B|, by input
  std::vector<Numbers> largest_;  // of |G(k) e|, by state of the start
};

}  // namespace

double InputGain::total() const {
  return rigor::add_up(sum_up(blocks), missed);
}

std::optional<WorstCaseGains> worst_case_gains(const std::vector<Row>& a,
                                               const std::vector<GainInput>& inputs,
                                               const std::vector<Row>& forms, std::size_t samples,
                                               std::size_t blocks) {
  if (a.empty() || blocks == 0 || samples == 0 || samples % blocks != 0) {
    throw std::invalid_argument("a horizon that is not a multiple of the blocks");
  }
  Powers powers(a, samples);
  Responses responses(inputs, forms, a.size(), blocks);
  for (std::size_t k = 0; k < samples; ++k) {
    responses.add(powers.power(), k / (samples / blocks));
    powers.advance();
  }
  return responses.finish(powers.defect());
}

std::optional<std::size_t> proposed_horizon(const std::vector<Row>& a, std::size_t blocks, double tail,
                                            std::size_t most) {
  const auto n = static_cast<Eigen::Index>(a.size());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      middle(i, j) = rigor::midpoint(a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  const double radius = rigor::spectral_radius(middle);
  if (!(radius < 1.0)) {
    return std::nullopt;
  }
  const double samples = radius > 0.0 ? std::log(tail) / std::log(radius) : 1.0;
  const double whole = std::max(1.0, std::ceil(samples / static_cast<double>(blocks)));
  if (!(whole * static_cast<double>(blocks) <= static_cast<double>(most))) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(whole) * blocks;
}

}  // namespace veritrack::linear
