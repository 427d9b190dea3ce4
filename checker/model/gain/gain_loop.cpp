#include "checker/model/gain/gain_loop.hpp"

namespace veritrack::checker {

namespace {

class ErrorsAboutPoint : public FrequencyErrors {
 public:
  ErrorsAboutPoint(GainErrors errors, Ball bias) : errors_(std::move(errors)), bias_(std::move(bias)) {}

  [[nodiscard]] Ball for_ever() const override { return errors_.for_ever(); }
  [[nodiscard]] Ball from(const Ball& sample) const override { return errors_.from(sample); }
  [[nodiscard]] Ball in_long_run() const override { return errors_.in_long_run(); }
  [[nodiscard]] Range mean() const override { return bias_ + Ball::within(errors_.mean_in_long_run()); }
  /// The bias is one number for each frequency.
  [[nodiscard]] Ball variation() const override { return two * errors_.deviation_in_long_run(); }

 private:
  GainErrors errors_;
  Ball bias_;
};

}  // namespace

std::unique_ptr<FrequencyErrors> Gains::errors(const Ball& noise, const Ball& slew,
                                               const std::vector<Ball>& start) const {
  std::optional<GainErrors> found = bounds ? bounds->errors(noise, slew, start) : std::nullopt;
  return found ? std::make_unique<ErrorsAboutPoint>(*std::move(found), network.bias) : nullptr;
}

std::vector<Ball> Gains::starts_within(const Ball& reach) const {
  const GainForm& frequency = network.forms[network.error_form];
  std::vector<Ball> start(network.states());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < network.states(); ++i) {
    if (certainly_equal(frequency.row[i], zero)) {
      continue;
    }
    ++moved;
    start[i] = (reach + abs(network.bias)) / abs(frequency.row[i]);
  }
  return moved == 1 && frequency.direct.empty() ? start : std::vector<Ball>();
}

}  // namespace veritrack::checker
