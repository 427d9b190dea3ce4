#include "analysis/quadrature/rounding/set_rounding.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using rigor::Interval;

TEST_CASE("probe") {
  const rigor::UpwardRounding upward;
  CertifiedSet s;
  s.metric << 0x1.16d7b187bb1dp+3, 0, 0, 0, 0x1.94a22f42e4696p+2, -0x1.1ca69fb40a477p+2, 0, 0,
      0x1.ac504ba09a3ccp+3;
  s.radius = 0x1.63a9ecba5513dp+1;
  s.covariance_lower << 0x1.7177084cf6a13p-8, 0, 0, 0, 0x1.3377ae1d8514p-7, 0x1.08fb1e4c52ee8p-9, 0,
      0x1.08fb1e4c52ee8p-9, 0x1.18423af70c76cp-8;
  s.covariance_upper << 0x1.84cbc36b04e22p-6, 0, 0, 0, 0x1.3ef524b3d118ep-5, 0x1.fcd8e4211924bp-7, 0,
      0x1.fcd8e4211924bp-7, 0x1.e2aeb9ff6aa98p-7;
  s.noise = 0x1.0624dd2f1a9fcp-10;
  const trackers::ToneModel<Interval> design{rigor::parse_decimal("0.0023"), rigor::parse_decimal("0.0023"),
                                             rigor::parse_decimal("0.05"), Interval(0.0)};
  const SetRounding r = set_rounding(design, Interval(1.0), 3.15, s);
  MESSAGE(r.error << " of " << s.radius << "  " << r.covariance);
  const HeldStates box{Interval::from_bounds(0.7, 1.3), Interval(0.0), rigor::to_interval(s.covariance_lower),
                     rigor::to_interval(s.covariance_upper)};
  const auto d = step_rounding({design, Interval(1.0), 1.001, 3.5}, box);
  MESSAGE(d.z << " " << d.frequency << " " << d.p_zz << " " << d.p_z3 << " " << d.p_33);
}
