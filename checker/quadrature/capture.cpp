#include "checker/quadrature/capture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "checker/document/evidence.hpp"
#include "checker/numbers/decimal_text.hpp"
#include "checker/quadrature/followed_starts.hpp"
#include "checker/quadrature/start_covariance.hpp"
#include "checker/quadrature/start_cover.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostBoxes = 200;
constexpr int kImageHalvings = 2;

/// A box that contains all assumed starts, and one that they contain.
StartBox outward(const Design& d) {
  return {{-d.amplitude_error.upper(), -d.phase_error.upper(), -d.frequency_error.upper()},
          {d.amplitude_error.upper(), d.phase_error.upper(), d.frequency_error.upper()}};
}
StartBox inward(const Design& d) {
  return {{-d.amplitude_error.lower(), -d.phase_error.lower(), -d.frequency_error.lower()},
          {d.amplitude_error.lower(), d.phase_error.lower(), d.frequency_error.lower()}};
}

/// Follows boxes of starts into a set, the one shifted by whole turns in the frequency error.
class Followed {
 public:
  Followed(const Loop& loop, const Matrix3& covariance, const Setting& set, const Ball& turns)
      : loop_(loop), covariance_(covariance), set_(set), shift_(two * turns * pi()) {}

  /// A bound on |frequency error| up to sample `samples`, when then certainly |T e| <= level and the
  /// covariance is in its bounds; empty otherwise. A statement that cannot be shown for the box as a whole is
  /// shown for its halves.
  [[nodiscard]] std::optional<Ball> reach(const StartBox& box, int samples, const Ball& level,
                                          int halvings) const {
    const auto side = [&](std::size_t i) { return Ball::hull(box.low[i], box.high[i]); };
    FollowedStarts states(loop_, {side(0), side(1), side(2)}, covariance_);
    Ball largest = abs(states.frequency_error());
    for (int k = 0; k < samples && largest.finite(); ++k) {
      states.step();
      largest = max(largest, abs(states.frequency_error()));
    }
    const Metric& t = set_.metric;
    const PolarEnclosure found =
        states.polar({{{t.amplitude, zero, zero}, {zero, t.phase, t.coupling}, {zero, zero, t.frequency}}},
                     {zero, zero, shift_});
    const Ball size = square(found.error[0]) + square(found.error[1]) + square(found.error[2]);
    if (largest.finite() && certainly_at_most(size, square(level)) &&
        between(found.covariance, set_.lower, set_.upper)) {
      return largest.upper();
    }
    if (halvings == 0) {
      return std::nullopt;
    }
    const auto [low, high] = halves(box);
    const std::optional<Ball> first = reach(low, samples, level, halvings - 1);
    const std::optional<Ball> second = first ? reach(high, samples, level, halvings - 1) : std::nullopt;
    return second ? std::optional(max(*first, *second)) : std::nullopt;
  }

 private:
  Loop loop_;
  Matrix3 covariance_;
  Setting set_;
  Ball shift_;
};

/// The statements of the verified set, with the findings on the way to it, on starts that enter it.
void conclude(const Cover& cover, const Ball& largest, const Setting& set, const Design& disturbed,
              const Tree& quantities, Captured& found) {
  const Ball ultimate = ultimate_level(set, disturbed) / set.metric.frequency;
  Ball bound = max(largest, ultimate);
  for (const Ball& level : cover.levels) {
    bound = max(bound, level / set.metric.frequency);
  }
  const Ball samples(*std::max_element(cover.samples.begin(), cover.samples.end()));
  found.verdict = Verdict::proved;
  found.set_error = frequency_errors(set);
  found.bound = bound;
  found.ultimate = ultimate;
  if (const auto claim = settling_claim(quantities)) {
    bool settles = !cover.boxes.empty();
    for (std::size_t i = 0; i < cover.boxes.size(); ++i) {
      const Ball rest = claim->samples - Ball(cover.samples[i]);
      settles = settles && certainly_not_negative(rest) &&
                settled(set, disturbed, cover.levels[i], claim->frequency_error, rest);
    }
    found.settled = settles ? claim : std::nullopt;
  }
  const Settled settling = found.settled.value_or(Settled{Ball::everything(), Ball::everything()});
  const Ball total(static_cast<double>(cover.boxes.size()));
  found.quantities = {{"capture_samples", samples, Sense::bounds_above},
                      {"frequency_error_bound", bound, Sense::bounds_above},
                      {"ultimate_frequency_error", ultimate, Sense::bounds_above},
                      {"settling_samples", settling.samples, Sense::bounds_above},
                      {"settled_frequency_error", settling.frequency_error, Sense::bounds_above},
                      {"cells", total},
                      {"cells_captured", total}};
}

/// Follows every box of the cover, or an evenly spaced sample of them; objects unless each does what it
/// should, and objects to a sample. Returns the largest |frequency error|.
Ball follow_all(const Cover& cover, const Followed& followed, bool symmetric, bool all_boxes,
                Objections& objections) {
  const std::size_t total = cover.boxes.size();
  const std::size_t count = all_boxes ? total : std::min(total, kMostBoxes);
  Ball largest(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = i * total / count;
    const std::size_t image = symmetric && count == total ? mirror_image(cover, index) : index;
    if (image < index) {
      continue;  // followed before, to the smaller level
    }
    const std::optional<Ball> reached =
        followed.reach(cover.boxes[index], cover.samples[index],
                       min(cover.levels[index], cover.levels[image]), kImageHalvings);
    if (!reached) {
      objections.push_back("box " + std::to_string(index) + " of " + std::to_string(total) +
                           " is not proved to enter its set");
      break;
    }
    largest = max(largest, *reached);
  }
  if (count < total && objections.empty()) {
    objections.push_back("only a sample of " + std::to_string(count) + " of " + std::to_string(total) +
                         " boxes was followed, which proves nothing; --full follows all");
  }
  return largest;
}

/// Follows the starts in the evidence, which are boxes that cover all assumed ones, or a witness, into the
/// set.
void follow_evidence(const Tree& evidence, const Tree& quantities, const Setting& set,
                     const Design& disturbed, const StartCovariance& start, bool all_boxes, Captured& found,
                     Objections& objections) {
  const Cover cover = read_cover(evidence);
  const Loop loop{disturbed.q1,
                  disturbed.q2,
                  disturbed.r,
                  disturbed.epsilon,
                  zero,
                  disturbed.noise,
                  disturbed.slew,
                  disturbed.amplitude,
                  max(disturbed.largest_frequency, pi())};
  const Matrix3 covariance = start.enclosure();
  const bool is_symmetric =
      certainly_equal(start.lowest[0][1], zero) && certainly_equal(start.lowest[0][2], zero) &&
      certainly_equal(start.highest[0][1], zero) && certainly_equal(start.highest[0][2], zero);
  const bool captured = certainly_equal(cover.turns, zero);
  // The least frequency error in the shifted set, which is also invariant, because the frequency error acts
  // through its sine and cosine alone.
  const Ball reach = frequency_errors(set);
  const Ball off = two * abs(cover.turns) * pi() - reach;
  for (const Ball& level : cover.levels) {
    if (!certainly_not_negative(level) || !certainly_at_most(level, set.radius)) {
      objections.emplace_back("a level is not within the radius of the set");
    }
  }
  if (captured && !covers(outward(disturbed), cover.boxes)) {
    objections.emplace_back("the boxes do not cover all assumed starts");
  }
  if (!captured && (cover.boxes.size() != 1 || !covers(cover.boxes[0], {inward(disturbed)}) ||
                    !certainly_less(reach, off) || !certainly_at_most(abs(cover.turns), kMostTurns))) {
    objections.emplace_back(
        "the witness is not a single box of assumed starts, or its final frequency error is not proved");
  }
  if (!objections.empty()) {
    return;
  }
  const Followed followed(loop, covariance, set, cover.turns);
  const Ball largest = follow_all(cover, followed, is_symmetric, all_boxes, objections);
  if (objections.empty() && captured) {
    conclude(cover, largest, set, disturbed, quantities, found);
  } else if (objections.empty()) {
    found.verdict = Verdict::refuted;
    found.wrong_lock = off;
    found.quantities = {{"wrong_lock_frequency_error", off, Sense::bounds_below}};
  }
}

}  // namespace

Captured check_capture(const Tree& claimed, const Design& design, const std::vector<CertifiedSet>& sets,
                       bool all_boxes, Objections& objections) {
  const bool assumed_noise = claimed.at("id").text() == "capture";
  Captured found;
  found.noise = assumed_noise ? design.noise : zero;
  found.slew = assumed_noise ? design.slew : zero;
  const Tree* evidence = find_evidence(claimed, "cover");
  evidence = evidence != nullptr ? evidence : find_evidence(claimed, "witness");
  const std::optional<StartCovariance> start = read_start_covariance(claimed, design, objections);
  if (evidence != nullptr) {
    const Ball noise = exact_number(evidence->at("numbers").at("noise"));
    const Ball slew = exact_number(evidence->at("numbers").at("slew"));
    if (!certainly_at_most(found.noise, noise) || !certainly_at_most(found.slew, slew)) {
      objections.emplace_back("the starts were followed under less noise or slew than assumed");
    }
    found.noise = noise;
    found.slew = slew;
  }
  Design disturbed = design;
  disturbed.noise = found.noise;
  disturbed.slew = found.slew;
  const Setting* set = first_of(sets, "start-error");
  const bool tolerated = set != nullptr && tolerates(*set, disturbed);
  found.covariance = start ? start->words : "";
  if (evidence != nullptr && start && tolerated && objections.empty()) {
    follow_evidence(*evidence, claimed.at("quantities"), *set, disturbed, *start, all_boxes, found,
                    objections);
  }
  check_derivation(
      claimed,
      {"Capture of every assumed start by the certified set",
       found.quantities,
       {{"certified-set", R"(V \le V_\Omega,\ W \le W_\Omega)", proved_if(tolerated)},
        {"starts-captured", R"(X(k_c) \in \Omega \text{ from every assumed start})", found.verdict}}},
      objections);
  return found;
}

bool is_capture_claim(const std::string& id) {
  return id == "ekf/capture" || id == "ekf/capture-noise-free" || id == "ekf/capture-at-reduced-noise";
}

Claim check_capture_claim(const Tree& claimed, const std::map<std::string, Captured>& captured,
                          const Guarantee& guarantee, Objections& objections) {
  const std::string& id = claimed.at("id").text();
  const auto found_of = [&](const char* derivation) {
    const auto found = captured.find(derivation);
    return found != captured.end() ? found->second : Captured();
  };
  std::string disturbance = guarantee.assumed_disturbance();
  Captured found = found_of("capture");
  Verdict verdict = found.verdict;
  if (id == "ekf/capture") {
    // No noise is allowed noise.
    if (const Captured without = found_of("capture/noise-free"); without.verdict == Verdict::refuted) {
      verdict = Verdict::refuted;
      found = without;
    }
  } else if (id == "ekf/capture-noise-free") {
    disturbance = Guarantee::disturbance_of(zero, zero);
    found = found_of("capture/noise-free");
    verdict = found.verdict;
  } else {
    found = found_of("capture/reduced-noise");
    disturbance = Guarantee::disturbance_of(found.noise, found.slew);
    verdict = found.verdict;
  }
  if (verdict == Verdict::proved && !guarantee.is_lock(found.set_error)) {
    verdict = Verdict::undecided;
  }
  Claim claim{guarantee.hypotheses(disturbance, found.covariance) +
                  "the tracker enters the certified set, in which the frequency error stays below " +
                  guarantee.lock_words() + ", and never leaves it.",
              verdict, found.quantities};
  check_claim(claimed, claim, objections);
  return claim;
}

}  // namespace veritrack::checker
