// Loops of one channel whose errors have a basis over the phase, as whole designs: analysis/model/gain.
#include <doctest/doctest.h>

#include <string>

#include "analysis/model/gain/floquet_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {
namespace {

/// Whether there is a basis from `low` to `high`, rad/sample.
bool has_basis(const std::string& text, double low, double high) {
  const Design design = read_design(text, "d.toml");
  const ModelTables& tables = model_tables(design);
  const model::TrackedTone tone = [&] {
    const rigor::UpwardRounding upward;
    return proposed_tone(make_model(tables.model, tables.assume.signal), tables.assume);
  }();
  return model::propose_floquet_cell(tone, model::FloquetGauge::by_mode, low, high).has_value();
}

TEST_CASE("a loop that keeps its output as a state has a basis: what decays at once is not scaled") {
  // A phase-locked loop of one phase behind a second-order integrator; w is a function of the other states.
  CHECK(has_basis(R"TOML(
name = "single-phase PLL"
tracker = "model"
[model]
samples = "y"
parameters = { ke = 2.0, kp = 0.2, ts = 5e-5, ki = "1.0*ts", wc = "2*pi*50" }
states = ["f", "b", "phase", "w", "sum"]
angles = ["phase"]
units = { w = "rad/s", phase = "rad" }
step = '''
f'     = f + ts*w*(ke*(y - f) - b*w)
b'     = b + f'*ts
e      = f'*cos(phase) + b'*w*sin(phase)
sum'   = sum + e*ki
w'     = wc + sum' + kp*e
phase' = phase + w'*ts
'''
frequency = "w*ts"
start = { f = "A", b = 0, phase = "pi/2 + omega", w = "omega/ts", sum = "omega/ts - wc" }
[assume]
amplitude = 311
sample_rate = 20000
frequency = { hz = [49, 51] }
noise = 3
)TOML",
                  0.01539, 0.01603));
}

TEST_CASE("a variance that stands still at some phases has a basis") {
  // KalmANF with the numbers of its published code; p decays by 0.55 at some phases and not at all at others.
  CHECK(has_basis(R"TOML(
name = "KalmANF"
tracker = "model"
[model]
samples = "y"
parameters = { rho = 0.995, q = 1e-5, r = 1e3 }
states = ["s1", "s2", "a", "p"]
step = '''
s   = y + rho*a*s1 - rho^2*s2
e   = s - a*s1 + s2
pq  = p + q
K   = s1/(s1^2 + r/pq)
a'  = a + K*e
p'  = (1 - K*s1)*pq
s1' = s
s2' = s1
'''
frequency = "acos(a/2)"
start = { s1 = 0, s2 = 0, a = "2*cos(omega)", p = 0.001 }
[assume]
amplitude = 1
frequency = [0.0495, 0.05]
noise = 0.0001
)TOML",
                  0.0495, 0.05));
}

}  // namespace
}  // namespace veritrack::certificates
