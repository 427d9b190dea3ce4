// Bounds on the errors of a network by the worst case of each input (docs/gain-proof.md, sections 4 and 5).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "checker/model/gain/gain_kernels.hpp"
#include "checker/model/gain/gain_network.hpp"

namespace veritrack::checker {

/// Bounds on the frequency error of a network, for certain noise, slew and starts.
class GainErrors {
 public:
  /// `mean`: a bound of the mean over the phase in the long run, without the bias.
  GainErrors(std::vector<double> by_block, double in_long_run, Ball mean, double bias,
             std::size_t block_length)
      : by_block_(std::move(by_block)),
        in_long_run_(in_long_run),
        mean_(std::move(mean)),
        bias_(bias),
        block_length_(block_length) {}

  /// At every sample.
  [[nodiscard]] Ball for_ever() const { return from_block(0); }
  /// From this sample on.
  [[nodiscard]] Ball from(const Ball& sample) const;
  /// A bound on the upper limit.
  [[nodiscard]] Ball in_long_run() const { return Ball(in_long_run_) + Ball(bias_); }
  /// The same without the bias.
  [[nodiscard]] Ball deviation_in_long_run() const { return Ball(in_long_run_); }
  [[nodiscard]] const Ball& mean_in_long_run() const { return mean_; }

 private:
  [[nodiscard]] Ball from_block(std::size_t block) const;

  std::vector<double> by_block_;  ///< without the bias
  double in_long_run_;
  Ball mean_;
  double bias_;
  std::size_t block_length_;
};

class GainBounds {
 public:
  /// `blocks` divides `horizon`. The network must outlive this.
  GainBounds(const GainNetwork& network, std::size_t horizon, std::size_t blocks)
      : network_(&network), kernels_(network, horizon, blocks) {}

  /// Whether the sums over all samples are bounded.
  [[nodiscard]] bool is_certain() const { return kernels_.is_certain(); }
  /// Whether what sentences call the steady state is one up to rounding.
  [[nodiscard]] bool is_about_steady_state() const;
  /// The bounds for |v| <= noise, |change of omega| <= slew and |xi_0| <= start by state; nothing where they
  /// are not certain, as with ripples and a slew that is not 0.
  [[nodiscard]] std::optional<GainErrors> errors(const Ball& noise, const Ball& slew,
                                                 const std::vector<Ball>& start) const;

 private:
  /// The data that do not change from round to round.
  struct Given {
    Table start;                  ///< T, by form and block
    std::vector<double> outside;  ///< by form: of the inputs that are no remainders, and ripples
    bool is_known = true;
  };
  [[nodiscard]] Given given(const Ball& noise, const Ball& slew, const std::vector<Ball>& start) const;
  /// The sizes of remainders, by input, where forms are at most `bounds`.
  [[nodiscard]] std::vector<double> sizes(const std::vector<double>& bounds) const;
  /// The bounds of the theorem, by block and form, from such bounds.
  [[nodiscard]] Table next(const Table& bounds, const Given& given) const;
  /// By form.
  [[nodiscard]] std::vector<double> in_long_run(std::vector<double> bounds, const Given& given) const;
  /// The mean of the form of the error, where these are the bounds of the long run.
  [[nodiscard]] Ball mean(const std::vector<double>& bounds) const;
  [[nodiscard]] bool keeps_limits(const std::vector<double>& bounds) const;

  const GainNetwork* network_;
  GainKernels kernels_;
};

}  // namespace veritrack::checker
