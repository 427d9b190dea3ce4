// The derivations single-channel-bias/...: the frequency error that remains in the steady state on a
// noise-free tone.
//
// Without a leak (epsilon = 0, q1, q2, r > 0) it is zero at every frequency between 0 and pi. The exact
// estimate, delta = nu = 0, stays exact: it predicts the signal, and there is no innovation. Its P follows
// the Riccati equation of a linear system: F has the rows (1, 0, 0), (0, 1, 1), (0, 0, 1), and the
// measurement (cos phi, -sin phi, 0) turns by omega a sample. From any phase four samples determine the
// state: they show a cos phi_k - (b + k c) sin phi_k, which solves a recursion of order four, and is zero for
// all k only when a = b = c = 0, since sin omega is not 0. By compactness of the circle the system is
// uniformly observable; as Q > 0 it is uniformly controllable. So P converges to a periodic curve, and the
// errors e+ = (I - K h')F e decay exponentially (Kalman and Bucy; Jazwinski, Theorems 7.4 and 7.5). The
// derivative of the nonlinear step on that curve is block triangular - P acts on the errors by the innovation
// only, which is zero - with this decay for the errors, and its square for P: the curve attracts a
// neighbourhood.
#pragma once

#include "checker/sets/quadrature_bias.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

/// An established bias: at every frequency of `frequency`, rad/sample.
struct SteadyStateBias {
  Range frequency, mean;
};

/// Objects unless every quantity is true at the quantity "frequency", and those named ..._around at all
/// frequencies within 0.002 rad/sample of it, and contraction_rate bounds the rate at which an invariant
/// curve attracts in some norms.
std::optional<SteadyStateBias> check_bias(const Tree& derivation, const SingleChannelDesign& design,
                                          QuadratureBranch& quadrature, Objections& objections);

/// "Unbiased if and only if epsilon omega = 0", at the frequency that the claim names: objects unless it
/// follows for epsilon = 0 (proposition-1/if), or from an established bias (proposition-1/only-if).
Claim check_proposition_1(const Tree& claim, const SingleChannelDesign& design,
                          const std::vector<SteadyStateBias>& established, Objections& objections);

}  // namespace veritrack::checker
