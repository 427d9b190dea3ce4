#include "analysis/quadrature/contraction/step_inequality.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/quadrature/contraction/error_contraction.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

const trackers::ToneModel<double> kSettingDesign{0.0013, 0.002, 0.01, 0.0};
const BlockCovariance<double> kSettingLow{0.003, 0.004, 0.001, 0.002};
const BlockCovariance<double> kSettingHigh{0.0031, 0.0041, 0.00105, 0.0021};

BlockCovariance<Interval> enclosed(const BlockCovariance<double>& p) {
  return {Interval(p.p11), Interval(p.p22), Interval(p.p23), Interval(p.p33)};
}

StepSetting<double> the_setting(double noise, const BlockCovariance<double>& high = kSettingHigh) {
  return {kSettingDesign, {2.0, 3.0, -1.0, 4.0}, kSettingLow, high, 0.3, 0.6, noise};
}
StepSetting<Interval> enclosed(const StepSetting<double>& s) {
  return {
      {Interval(kSettingDesign.q1), Interval(kSettingDesign.q2), Interval(kSettingDesign.r), Interval(0.0)},
      {Interval(s.metric.amplitude), Interval(s.metric.phase), Interval(s.metric.coupling),
       Interval(s.metric.frequency)},
      enclosed(kSettingLow),
      enclosed(s.covariance_upper),
      Interval(s.largest_amplitude),
      Interval(s.largest_chi),
      Interval(s.noise)};
}

/// A cell of this size around s = 0.5, beta = 1, and the constants of an inequality, over both scalars.
struct Cell {
  StepSetting<double> setting;
  CellForms forms;
  StepConstants<double> constants;

  Cell(double rate_squared, double noise_gain_squared, double size,
       const BlockCovariance<double>& high = kSettingHigh)
      : setting(the_setting(noise_gain_squared > 0.0 ? 0.01 : 0.0, high)),
        constants{rate_squared, noise_gain_squared, 1.0, noise_gain_squared > 0.0, false} {
    const std::array<double, 4> middle{0.5, 1.0, 0.0, 0.0};
    const double c0 = std::cos(1.0);
    const double s0 = std::sin(1.0);
    const double reach = 0.01;
    forms.proposal = polar_step_form<double, double>(setting, {0.5, 1.0, c0, s0, 0.0, 0.0, {reach, reach}});
    const std::array<Interval, 2> exact_reach{Interval(reach), Interval(reach)};
    forms.middle = polar_step_form<Interval, Interval>(
        enclosed(setting), {Interval(0.5), Interval(1.0), Interval(c0), Interval(s0), Interval(0.0),
                            Interval(0.0), exact_reach});
    const auto side = [&](std::size_t i) {
      std::array<Interval, kCellVariables> unit;
      unit.fill(Interval(0.0));
      unit[i] = Interval(1.0);
      return Derivatives(Interval(middle[i]) + rigor::symmetric(size), unit);
    };
    forms.over = polar_step_form<Interval, Derivatives>(
        enclosed(setting), {side(0), side(1), Interval(c0), Interval(s0), side(2), side(3), exact_reach});
    forms.half_widths.fill(size);
    forms.tangent_squared = tangent_squared_from(Interval(c0), Interval(s0), 1.0 - size, 1.0 + size);
  }

  [[nodiscard]] bool holds(double multiplier) const {
    const StepConstants<Interval> exact{Interval(constants.rate_squared),
                                        Interval(constants.noise_gain_squared), Interval(1.0),
                                        constants.noisy, false};
    return check_cell(forms, enclosed(setting).metric, exact, setting.metric, constants, multiplier).holds;
  }
  [[nodiscard]] double proposed_multiplier() const {
    return propose_rate(forms.proposal, setting.metric, constants).multiplier;
  }
};

TEST_CASE("a multiplier that is not positive proves nothing, whatever it makes of the matrix") {
  const rigor::UpwardRounding upward;
  const Cell cell(4.0, 0.0, 0.01);
  CHECK(cell.holds(cell.proposed_multiplier()));
  CHECK_FALSE(cell.holds(-cell.proposed_multiplier()));
  CHECK_FALSE(cell.holds(-1e6));
  CHECK_FALSE(cell.holds(0.0));
}

TEST_CASE("noise must keep something of its gain, whatever the multiplier") {
  const rigor::UpwardRounding upward;
  const Cell generous(4.0, 1e6, 0.01);
  const double multiplier = generous.proposed_multiplier();
  CHECK(generous.holds(multiplier));
  // A gain that the spread of the covariance uses up, and more: what is left is negative.
  const Interval spread = generous.forms.middle.spread[0];
  CHECK_FALSE(Cell(1e9, 0.5 * multiplier * spread.lower(), 0.01).holds(multiplier));
  CHECK_FALSE(Cell(1e9, 1e-12 * multiplier * spread.lower(), 0.01).holds(multiplier));
}

TEST_CASE("noise must keep something of its gain along the prediction and across it") {
  const rigor::UpwardRounding upward;
  // A covariance that is known better along the prediction, or across it.
  for (const auto& high : {BlockCovariance<double>{0.00301, 0.0045, 0.00101, 0.00201},
                           BlockCovariance<double>{0.0035, 0.00401, 0.00101, 0.00201}}) {
    const Cell generous(4.0, 1e6, 0.001, high);
    const double multiplier = generous.proposed_multiplier();
    CHECK(generous.holds(multiplier));
    const double along = generous.forms.middle.spread[0].upper();
    const double across = generous.forms.middle.spread[1].upper();
    CHECK(std::max(along, across) > 4.0 * std::min(along, across));
    // A multiplier that leaves something of the gain for the one and nothing for the other.
    const Cell lenient(1e12, 1e6, 0.001, high);
    CHECK(lenient.holds(0.5e6 / std::max(along, across)));
    CHECK_FALSE(lenient.holds(1e6 / std::sqrt(along * across)));
  }
}

TEST_CASE("a cell that is too wide is not proved, though its middle contracts") {
  const rigor::UpwardRounding upward;
  const Cell narrow(4.0, 0.0, 0.01);
  const double multiplier = narrow.proposed_multiplier();
  const double rate_squared =
      1.02 * propose_rate(narrow.forms.proposal, narrow.setting.metric, narrow.constants).rate_squared;
  CHECK(Cell(rate_squared, 0.0, 1e-4).holds(multiplier));
  CHECK_FALSE(Cell(rate_squared, 0.0, 0.2).holds(multiplier));
}

TEST_CASE("a rate that the rim of the set does not keep is not proved, though the middles of cells do") {
  double needed = 0.0;
  const StepSetting<double> setting = the_setting(0.0);
  for (int k = 0; k <= 200; ++k) {
    const double beta = 3.14159 * k / 200.0;
    const auto form = polar_step_form<double, double>(
        setting, {1.0, beta, std::cos(beta), std::sin(beta), 0.0, 0.0, {0.0, 0.0}});
    needed = std::max(needed, propose_rate(form, setting.metric, {0.0, 0.0, 0.0, false, false}).rate_squared);
  }
  const rigor::UpwardRounding upward;
  const auto proves = [&](double rate_squared) {
    return prove_contraction(enclosed(setting),
                             {Interval(rate_squared), Interval(0.0), Interval(0.0), false, false})
        .proved;
  };
  CHECK(proves(1.1 * needed));
  CHECK_FALSE(proves(0.995 * needed));
}

}  // namespace
}  // namespace veritrack::quadrature
