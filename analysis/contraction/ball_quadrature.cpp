#include "analysis/contraction/ball_quadrature.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace veritrack::contraction {

namespace {

using rigor::Interval;
using rigor::Verdict;
constexpr int kStates = QuadraturePolarLoop::kStates;
constexpr Eigen::Index kFrequency = 2;
constexpr int kMostHalvings = 2;
using Certificate = BallCertificate<kStates>;
using Proposal = BallProposal<kStates>;
using Cells = std::vector<FixedPointTube<kStates>>;

/// What to make of one part of the branch: a certificate, PROVED or with the reason why not.
using Attempt = std::function<Certificate(const Cells&)>;

/// First, middle and last cell: where a proposal is tried before the whole part is.
Cells sample_cells(const Cells& cells) {
  if (cells.size() <= 3) {
    return cells;
  }
  return {cells.front(), cells[cells.size() / 2], cells.back()};
}

std::optional<MetricProposal> propose(const QuadraturePolarLoop& loop, const Cells& cells, BallAim aim) {
  std::vector<LocalModel> models;
  for (const auto& tube : sample_cells(cells)) {
    models.push_back(local_model(loop, tube));
  }
  MetricSearch search;
  search.aim = aim;
  search.state = static_cast<int>(kFrequency);
  return propose_metric(models, search);
}

Certificate without_metric() {
  Certificate certificate;
  certificate.reason = "no metric was found in which the loop contracts";
  return certificate;
}

/// Looks for a proposal on a few cells, verifies it on all of them, and looks again with the cell that failed
/// among the few. The last failure when none holds.
Certificate verify_with_counterexamples(
    const QuadraturePolarLoop& loop, const Cells& cells,
    const std::function<std::optional<Proposal>(const Cells& samples)>& search_on,
    const Proposal& otherwise) {
  constexpr int kRounds = 6;
  Cells samples = sample_cells(cells);
  Certificate certificate;
  for (int i = 0; i < kRounds; ++i) {
    const std::optional<Proposal> proposal = search_on(samples);
    if (!proposal) {
      certificate = verify_ball(loop, samples, otherwise);
      certificate.verdict = Verdict::undecided;  // of the samples only
      return certificate;
    }
    certificate = verify_ball(loop, cells, *proposal);
    if (certificate.verdict == Verdict::proved || !certificate.failed_cell) {
      return certificate;
    }
    samples.push_back(cells[*certificate.failed_cell]);
  }
  return certificate;
}

/// A large radius that verifies on the sample cells; then all cells.
Certificate attempt_radius(const QuadraturePolarLoop& loop, const Cells& cells, double noise, double slew) {
  const auto metric = propose(loop, cells, BallAim::state);
  if (!metric) {
    return without_metric();
  }
  const Proposal start{rigor::Matrix<kStates>(metric->metric), 0.5 * metric->radius, noise, slew};
  const auto search_on = [&](const Cells& samples) -> std::optional<Proposal> {
    // Too small a ball for the noise fails like too large a one: look from above, and do not stop at the
    // first.
    constexpr double kStep = 0.8;
    constexpr int kSteps = 20;
    constexpr int kBisections = 3;
    Proposal proposal = start;
    const auto holds = [&] { return verify_ball(loop, samples, proposal).verdict == Verdict::proved; };
    double low = 0.0;
    double high = 1.5 * metric->radius;
    for (int i = 0; i < kSteps && low == 0.0; ++i) {
      proposal.radius = kStep * high;
      (holds() ? low : high) = proposal.radius;
    }
    for (int i = 0; i < kBisections && low > 0.0; ++i) {
      proposal.radius = 0.5 * (low + high);
      (holds() ? low : high) = proposal.radius;
    }
    proposal.radius = 0.98 * low;
    return low > 0.0 ? std::optional(proposal) : std::nullopt;
  };
  return verify_with_counterexamples(loop, cells, search_on, start);
}

/// The most of one disturbance, over a few radii and by bisection on the sample cells; then all cells.
Certificate attempt_disturbance(const QuadraturePolarLoop& loop, const Cells& cells, double Proposal::*size,
                                double (*room)(const Certificate&, double)) {
  const auto metric = propose(loop, cells, BallAim::noise);
  if (!metric) {
    return without_metric();
  }
  Proposal start{rigor::Matrix<kStates>(metric->metric), 0.5 * metric->radius, 0.0, 0.0};
  start.*size = 1e-12;  // not zero: the fixed point's own motion counts
  const auto search_on = [&](const Cells& samples) -> std::optional<Proposal> {
    Proposal best = start;
    double most = 0.0;
    for (const double fraction : {0.3, 0.45, 0.6, 0.75, 0.9, 1.1, 1.35}) {
      Proposal trial = start;
      trial.radius = metric->radius * fraction;
      const Certificate certificate = verify_ball(loop, samples, trial);
      const double found = certificate.verdict == Verdict::proved ? room(certificate, 0.0) : 0.0;
      if (found > most) {
        most = found;
        best = trial;
      }
    }
    // The gains grow with the disturbance.
    double low = 0.0;
    double high = most;
    constexpr int kBisections = 5;
    for (int i = 0; i < kBisections && most > 0.0; ++i) {
      best.*size = 0.5 * (low + high);
      (verify_ball(loop, samples, best).verdict == Verdict::proved ? low : high) = best.*size;
    }
    best.*size = 0.98 * low;
    return low > 0.0 ? std::optional(best) : std::nullopt;
  };
  return verify_with_counterexamples(loop, cells, search_on, start);
}

/// One part for all cells if possible; halves, where that is allowed, if not. False when some part failed,
/// with the reason in `ball`.
bool cover(QuadratureBall& ball, const Cells& cells, const Attempt& attempt, int halvings) {
  const Certificate certificate = attempt(cells);
  if (certificate.verdict == Verdict::proved) {
    ball.parts.push_back({cells, {certificate}});
    ball.reason = certificate.reason;
    return true;
  }
  if (halvings == 0 || cells.size() < 2) {
    ball.reason = certificate.reason;
    return false;
  }
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
  return cover(ball, Cells(cells.begin(), middle), attempt, halvings - 1) &&
         cover(ball, Cells(middle, cells.end()), attempt, halvings - 1);
}

QuadratureBall cover_branch(const LockBranch& branch, const Attempt& attempt, bool constant_frequency) {
  QuadratureBall ball;
  if (branch.verdict != Verdict::proved || branch.cells.empty()) {
    ball.reason = branch.reason;
    return ball;
  }
  if (cover(ball, branch.cells, attempt, constant_frequency ? kMostHalvings : 0)) {
    ball.verdict = Verdict::proved;
  } else {
    ball.parts.clear();
  }
  return ball;
}

/// Smaller balls inside the first, down to where the disturbances hold the state.
void descend(BallChain& chain, const QuadraturePolarLoop& loop) {
  constexpr int kBalls = 6;
  for (int i = 1; i < kBalls && chain.balls.back().ultimate_level > 0.0; ++i) {
    Proposal proposal = chain.balls.back().proposal;
    const double radius = (Interval(1.01) * Interval(chain.balls.back().ultimate_level)).upper();
    if (!(radius < 0.99 * proposal.radius)) {
      return;
    }
    proposal.radius = radius;
    Certificate certificate = verify_ball(loop, chain.cells, proposal);
    if (certificate.verdict != Verdict::proved) {
      return;
    }
    chain.balls.push_back(std::move(certificate));
  }
}

/// An upper bound on the least k with rate^k from <= to; nothing when none was found.
std::optional<int> steps_down(double rate, const Interval& from, const Interval& to) {
  constexpr int kLongest = 10000000;
  Interval level = from;
  for (int k = 0; k <= kLongest && certainly_positive(to); ++k) {
    if (certainly_less_equal(level, to)) {
      return k;
    }
    level = Interval((level * Interval(rate)).upper());
  }
  return std::nullopt;
}

/// Samples after which every start of the first ball is within twice the last one's ultimate level.
std::optional<int> settling_samples(const BallChain& chain) {
  int total = 0;
  for (std::size_t i = 0; i < chain.balls.size(); ++i) {
    const Certificate& ball = chain.balls[i];
    const bool last = i + 1 == chain.balls.size();
    const Interval goal =
        last ? Interval(2.0) * Interval(ball.ultimate_level) : Interval(chain.balls[i + 1].proposal.radius);
    // The level is at most U + rate^k (R - U).
    const Interval ultimate(ball.ultimate_level);
    const auto steps = steps_down(ball.rate, Interval(ball.proposal.radius) - ultimate, goal - ultimate);
    if (!steps) {
      return std::nullopt;
    }
    total += *steps;
  }
  return total;
}

theorems::Quantity quantity(const char* name, const char* symbol, const char* formula,
                            const std::optional<Interval>& value, const std::string& missing) {
  theorems::Quantity result{
      name,        symbol, formula, "contraction on a ball around the steady state", Interval::empty(),
      std::nullopt};
  if (value && is_finite(*value)) {
    result.value = *value;
  } else {
    result.not_applicable = missing;
  }
  return result;
}

/// The least, or the largest, over the parts of a PROVED ball; nothing otherwise.
template <typename Function>
std::optional<Interval> over_parts(const QuadratureBall& ball, bool least, const Function& function) {
  std::optional<Interval> result;
  if (ball.verdict != Verdict::proved) {
    return result;
  }
  for (const BallChain& part : ball.parts) {
    const Interval value = function(part);
    result = !result ? value : least ? min(*result, value) : max(*result, value);
  }
  return result;
}

}  // namespace

QuadratureBall certify_quadrature_ball(const BallQuestion& question, const LockBranch& branch) {
  const rigor::UpwardRounding upward;
  const QuadraturePolarLoop loop{question.design};
  QuadratureBall ball = cover_branch(
      branch, [&](const Cells& cells) { return attempt_radius(loop, cells, question.noise, question.slew); },
      question.slew == 0.0);
  for (BallChain& part : ball.parts) {
    descend(part, loop);
  }
  return ball;
}

QuadratureBall certify_largest_noise(const BallQuestion& question, const LockBranch& branch) {
  const rigor::UpwardRounding upward;
  const QuadraturePolarLoop loop{question.design};
  return cover_branch(
      branch,
      [&](const Cells& cells) {
        return attempt_disturbance(loop, cells, &Proposal::noise, propose_largest_noise<kStates>);
      },
      true);
}

QuadratureBall certify_largest_slew(const BallQuestion& question, const LockBranch& branch) {
  const rigor::UpwardRounding upward;
  const QuadraturePolarLoop loop{question.design};
  return cover_branch(
      branch,
      [&](const Cells& cells) {
        return attempt_disturbance(loop, cells, &Proposal::slew, propose_largest_slew<kStates>);
      },
      false);
}

theorems::Derivation derive_quadrature_ball(const BallQuestion& question) {
  const rigor::UpwardRounding upward;
  // Near the end of the branch X* moves fast, and only narrow cells are enclosed well enough.
  LockBranch branch;
  QuadratureBall ball;
  for (const double cell_width : {0.05, 0.01}) {
    branch = verify_lock_branch(question.design, question.band, {.largest = cell_width});
    ball = certify_quadrature_ball(question, branch);
    if (ball.verdict == Verdict::proved || branch.verdict != Verdict::proved) {
      break;
    }
  }
  const QuadratureBall noisy = certify_largest_noise(question, branch);
  const QuadratureBall slewing = certify_largest_slew(question, branch);

  const auto error_radius = [](Eigen::Index state) {
    return [state](const BallChain& part) {
      const Certificate& first = part.balls.front();
      return state_bounds<kStates>(first, Interval(first.proposal.radius))[state];
    };
  };
  const auto rate =
      over_parts(ball, false, [](const BallChain& part) { return Interval(part.balls.front().rate); });
  const auto radius = over_parts(
      ball, true, [](const BallChain& part) { return Interval(part.balls.front().proposal.radius); });
  const auto ultimate = over_parts(ball, false, [](const BallChain& part) {
    double bias = 0.0;
    for (const auto& cell : part.cells) {
      bias = std::max(bias, magnitude(steady_state_error(cell).frequency_error));
    }
    const Certificate& last = part.balls.back();
    const auto bounds = state_bounds<kStates>(last, Interval(last.ultimate_level));
    return Interval((Interval(bias) + bounds[kFrequency]).upper());
  });
  const auto settling = over_parts(ball, false, [](const BallChain& part) {
    const auto steps = settling_samples(part);
    return steps ? Interval(*steps) : Interval::empty();
  });
  auto noise = over_parts(noisy, true,
                          [](const BallChain& part) { return Interval(part.balls.front().proposal.noise); });
  auto slew = over_parts(slewing, true,
                         [](const BallChain& part) { return Interval(part.balls.front().proposal.slew); });
  if (ball.verdict == Verdict::proved) {
    // What holds with both holds with one of them.
    noise = max(noise.value_or(Interval(0.0)), Interval(question.noise));
    slew = max(slew.value_or(Interval(0.0)), Interval(question.slew));
  }
  const auto level = over_parts(
      ball, false, [](const BallChain& part) { return Interval(part.balls.front().ultimate_level); });

  theorems::Derivation derivation;
  derivation.id = "contraction";
  derivation.title = "Contraction on a ball around the steady state, in the polar frame";
  derivation.quantities = {
      quantity("contraction_rate", "\\kappa", "\\sup \\|G(X) - X^*\\|_T / \\|X - X^*\\|_T", rate,
               ball.reason),
      quantity("radius", "R", "\\|X - X^*\\|_T \\le R", radius, ball.reason),
      quantity("frequency_error_radius", "R_\\nu", "R \\, \\|e_\\nu' T^{-1}\\|_2",
               over_parts(ball, true, error_radius(2)), ball.reason),
      quantity("phase_error_radius", "R_\\psi", "R \\, \\|e_\\psi' T^{-1}\\|_2",
               over_parts(ball, true, error_radius(1)), ball.reason),
      quantity("amplitude_error_radius", "R_a", "R \\, \\|e_a' T^{-1}\\|_2",
               over_parts(ball, true, error_radius(0)), ball.reason),
      quantity("ultimate_frequency_error", "\\limsup |\\nu|", "|\\nu^*| + U \\, \\|e_\\nu' T^{-1}\\|_2",
               ultimate, ball.reason),
      quantity("largest_noise", "V_{\\max}", "\\kappa R + L_v V \\le R", noise, noisy.reason),
      quantity("largest_slew", "W_{\\max}", "\\kappa R + (L_w + L^*) W \\le R", slew, slewing.reason),
      quantity("settling_samples", "k_s", "\\|X(k) - X^*\\|_T \\le 2 U \\text{ for } k \\ge k_s", settling,
               ball.verdict == Verdict::proved
                   ? "without noise and slew there is no ultimate bound to settle to"
                   : ball.reason),
      frequency_bias(branch)};
  derivation.conditions = {
      {"steady-state", "X^*(\\omega) = G(X^*(\\omega)) \\text{ on the band}", branch.verdict,
       Interval::empty(), Interval::empty(), branch.reason},
      {"contraction", "\\kappa < 1", ball.verdict, rate.value_or(Interval::empty()), Interval(1.0),
       ball.reason},
      {"invariance", "U = (L_v V + (L_w + L^*) W) / (1 - \\kappa) \\le R", ball.verdict,
       level.value_or(Interval::empty()), radius.value_or(Interval::empty()), ball.reason}};
  if (ball.parts.size() > 1) {
    derivation.notes.emplace_back(
        "The band is covered by " + std::to_string(ball.parts.size()) +
        " balls, each in a metric of its own, for a frequency that does not change; "
        "the quantities are the worst of them.");
  }
  derivation.verdict = ball.verdict;
  return derivation;
}

}  // namespace veritrack::contraction
