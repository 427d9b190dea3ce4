#include "checker/dft_block/dft_block_certificate.hpp"

#include <map>
#include <set>

#include "checker/dft_block/false_lock_check.hpp"
#include "checker/dft_block/lock_loss_check.hpp"
#include "checker/document/design_number.hpp"
#include "checker/document/evidence.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

const std::string kGuarantee = "dft-block/guarantee";
const std::string kOffsetError = "dft-block/offset-error";
const std::string kSettles = "dft-block/settles";
const std::string kLosingLock = "dft-block/losing-lock";
const std::string kProbability = "dft-block/probability-of-losing-lock";
const std::string kEveryStart = "dft-block/every-start-locks";
const std::string kClaimOf = "dft-block/";  // and the id of a false lock
constexpr int kMostHalfWidth = 8;

/// What the evidence "lock" proposes.
struct Proposal {
  BlockSet set;
  BlockRate rate;
  std::optional<BlockRate> late;
};

BlockRate read_rate(const Tree& numbers, const std::string& prefix) {
  return {exact_number(numbers.at(prefix + "radius")), exact_number(numbers.at(prefix + "rate")),
          exact_number(numbers.at(prefix + "weight"))};
}

bool is_rate(const BlockRate& rate) {
  return certainly_positive(rate.radius) && certainly_positive(rate.rate) && certainly_less(rate.rate, one) &&
         certainly_positive(rate.weight);
}

/// Where noise and slew push against a rate.
Ball rest(const Ball& disturbance, const BlockRate& rate) {
  return disturbance / (one - rate.rate);
}

/// Walks through a certificate of a block tracker.
class BlockVerifier {
 public:
  BlockVerifier(const Tree& certificate, Verification& result)
      : certificate_(certificate),
        design_(certificate.at("design")),
        assume_(design_.at("assume")),
        result_(result) {}

  void run() {
    Objections objections;
    read_design(objections);
    read_assumptions(objections);
    const std::vector<Requirement> asked = read_requirements(objections);
    result_.parts.push_back({"design", objections});
    if (!objections.empty()) {
      return;  // nothing is said of what is no design
    }
    hypotheses_ = hypotheses();
    for (const Tree& derivation : certificate_.at("derivations").elements()) {
      check_one(derivation);
    }
    check_claims(
        certificate_, asked,
        [this](const Tree& claim, Objections& found) { return check_one_claim(claim, found); }, result_);
  }

 private:
  void read_design(Objections& objections) {
    const Tree& chosen = design_.at("design");
    problem_.q1 = read_positive(chosen.at("q1"), "q1", objections);
    problem_.q2 = read_positive(chosen.at("q2"), "q2", objections);
    problem_.q3 = read_positive(chosen.at("q3"), "q3", objections);
    problem_.r = read_positive(chosen.at("r"), "r", objections);
    const Ball half_width = read_number(chosen.at("half_width"), objections);
    for (int i = 1; i <= kMostHalfWidth; ++i) {
      if (certainly_equal(half_width, Ball(static_cast<double>(i)))) {
        problem_.half_width = i;
      }
    }
    for (const char* key : {"block_length", "centre"}) {
      if (chosen.find(key) != nullptr) {
        const Ball number = read_positive(chosen.at(key), key, objections);
        if (arb_is_int(number.raw()) == 0) {
          objections.push_back(std::string(key) + " must be a whole number");
        }
      }
    }
    if (problem_.half_width == 0) {
      objections.emplace_back("half_width must be a whole number from 1 to 8");
    }
  }

  void read_assumptions(Objections& objections) {
    const Tree& amplitude = assume_.at("amplitude");
    one_amplitude_ = amplitude.kind() == Tree::Kind::object;
    if (one_amplitude_) {
      problem_.amplitude_low = read_positive(amplitude, "amplitude", objections);
      problem_.amplitude_high = problem_.amplitude_low;
    } else {
      read_pair(amplitude, "amplitude", problem_.amplitude_low, problem_.amplitude_high, objections);
      if (!certainly_positive(problem_.amplitude_low)) {
        objections.emplace_back("amplitude must be positive");
      }
    }
    read_pair(assume_.at("offset"), "offset", problem_.offset_low, problem_.offset_high, objections);
    const Ball most(static_cast<double>(kMostHalfWidth));
    if (!certainly_at_most(-most, problem_.offset_low) || !certainly_at_most(problem_.offset_high, most)) {
      objections.emplace_back("offset must be from -8 to 8");
    }
    read_noise(objections);
    problem_.slew = read_not_negative(assume_.at("slew"), "slew", objections);
    start_ = {read_not_negative(assume_.at("initial_amplitude_error"), "initial_amplitude_error", objections),
              read_not_negative(assume_.at("initial_phase_error"), "initial_phase_error", objections),
              read_not_negative(assume_.at("initial_offset_error"), "initial_offset_error", objections)};
    if (!certainly_less(start_[0], one)) {
      objections.emplace_back("initial_amplitude_error must be below 1");
    }
    read_covariance(objections);
  }

  /// A bound, or Gaussian noise of the samples, from which that of the bins follows.
  void read_noise(Objections& objections) {
    const Tree& noise = assume_.at("noise");
    is_gaussian_ = noise.find("text") == nullptr;
    if (is_gaussian_ != (assume_.find("blocks") != nullptr)) {
      objections.emplace_back("Gaussian noise and blocks belong together");
    }
    if (!is_gaussian_) {
      problem_.noise = read_not_negative(noise, "noise", objections);
      return;
    }
    problem_.noise = Ball::everything();  // there is no bound
    if (noise.members().size() != 1) {
      objections.emplace_back("noise is given by one number: snr_db or deviation");
    }
    Ball deviation;
    if (const Tree* decibels = noise.find("snr_db")) {
      if (!one_amplitude_) {
        objections.emplace_back("snr_db goes with one amplitude");
      }
      deviation = problem_.amplitude_low *
                  exp(-(read_number(*decibels, objections) / Ball(20.0)) * log(Ball(10.0))) / sqrt(two);
    } else {
      deviation = read_positive(noise.at("deviation"), "deviation", objections);
    }
    // Real and imaginary part of (4.4) have the variance deviation^2/(2 T).
    const Ball length = read_number(design_.at("design").at("block_length"), objections);
    noise_.deviation = deviation / sqrt(two * length);
    if (!certainly_positive(noise_.deviation)) {
      objections.emplace_back("the deviation of the noise is not a positive number");
    }
    noise_.blocks = read_positive(assume_.at("blocks"), "blocks", objections);
    if (!certainly_at_most(one, noise_.blocks)) {
      objections.emplace_back("blocks must be at least 1");
    }
  }

  static void read_pair(const Tree& pair, const std::string& name, Ball& low, Ball& high,
                        Objections& objections) {
    if (pair.elements().size() != 2) {
      objections.push_back(name + " must be [lowest, highest]");
      low = high = Ball::everything();
      return;
    }
    low = read_number(pair.at(0), objections);
    high = read_number(pair.at(1), objections);
    if (!certainly_at_most(low, high) && text_of(pair.at(0)) != text_of(pair.at(1))) {
      objections.push_back(name + " must be [lowest, highest] in this order");
    }
  }

  void read_covariance(Objections& objections) {
    const Tree& covariance = assume_.at("initial_covariance");
    if (covariance.kind() == Tree::Kind::text) {
      if (!covariance.is("steady-state")) {
        objections.emplace_back("initial_covariance must be steady-state or a matrix");
      } else if (!one_amplitude_) {
        objections.emplace_back("a range of amplitudes has no steady state");
      }
      return;
    }
    Matrix3 matrix;
    constexpr std::size_t kSize = 3;
    if (covariance.elements().size() != kSize) {
      objections.emplace_back("initial_covariance must have three rows");
      return;
    }
    covariance_text_ = "[";
    for (std::size_t i = 0; i < kSize; ++i) {
      const Tree& row = covariance.at(i);
      if (row.elements().size() != kSize) {
        objections.emplace_back("initial_covariance must have three columns");
        return;
      }
      covariance_text_ += i == 0 ? "[" : ", [";
      for (std::size_t j = 0; j < kSize; ++j) {
        matrix[i][j] = read_number(row.at(j), objections);
        covariance_text_ += (j == 0 ? "" : ", ") + text_of(row.at(j));
        if (j < i && text_of(row.at(j)) != text_of(covariance.at(j).at(i)) &&
            !certainly_equal(matrix[i][j], matrix[j][i])) {
          objections.emplace_back("initial_covariance must be symmetric");
        }
      }
      covariance_text_ += "]";
    }
    covariance_text_ += "]";
    covariance_ = matrix;
  }

  std::vector<Requirement> read_requirements(Objections& objections) {
    const Tree& require = design_.at("require");
    for (const auto& [key, value] : require.members()) {
      read_positive(value, key, objections);
      const bool is_key =
          is_gaussian_ ? key == "probability_of_losing_lock_below"
                       : key == "offset_error_below" || key == "settles_within" || key == "settled_below";
      if (!is_key) {
        objections.push_back("[require] has no key " + key);
      }
    }
    std::vector<Requirement> asked;
    if (require.find("offset_error_below") != nullptr) {
      asked.push_back({kOffsetError, required_text(kOffsetError)});
    }
    if (require.find("probability_of_losing_lock_below") != nullptr) {
      asked.push_back({kProbability, required_text(kProbability)});
    }
    const bool within = require.find("settles_within") != nullptr;
    const bool below = require.find("settled_below") != nullptr;
    if (within != below) {
      objections.emplace_back("settles_within and settled_below belong together");
    } else if (within) {
      asked.push_back({kSettles, required_text(kSettles)});
    }
    return asked;
  }

  [[nodiscard]] std::string asked_text(const char* key) const {
    return text_of(design_.at("require").at(key));
  }
  [[nodiscard]] Ball asked(const char* key) const {
    Objections read_before;
    return read_number(design_.at("require").at(key), read_before);
  }
  [[nodiscard]] std::string required_text(const std::string& id) const {
    if (id == kProbability) {
      return "within the first " + text_of(assume_.at("blocks")) +
             " blocks lock is lost with a probability below " +
             asked_text("probability_of_losing_lock_below");
    }
    return id == kOffsetError
               ? "the offset error is below " + asked_text("offset_error_below") + " bins in every block"
               : "from block " + asked_text("settles_within") + " on, the offset error is below " +
                     asked_text("settled_below") + " bins";
  }

  /// The filter, with which every sentence begins.
  [[nodiscard]] std::string filter_words() const {
    const Tree& chosen = design_.at("design");
    const auto text = [&](const char* key) { return text_of(chosen.at(key)); };
    return "In exact arithmetic, the block tracker without leaks, with Q = diag(" + text("q1") + ", " +
           text("q2") + ", " + text("q3") + "), R = " + text("r") + " I and the bins M - " +
           text("half_width") + " ... M + " + text("half_width");
  }

  [[nodiscard]] std::string amplitude_words() const {
    const Tree& amplitude = assume_.at("amplitude");
    return one_amplitude_
               ? "the amplitude " + text_of(amplitude)
               : "a constant amplitude from " + text_of(amplitude.at(0)) + " to " + text_of(amplitude.at(1));
  }

  [[nodiscard]] std::string noise_words() const {
    const Tree& noise = assume_.at("noise");
    if (!is_gaussian_) {
      return "plus noise whose length in all bins of a block together is at most " + text_of(noise);
    }
    const Tree* decibels = noise.find("snr_db");
    return "in a way that does not depend on the noise, plus Gaussian noise of mean zero, independent from "
           "block "
           "to block and from bin to bin, with independent real and imaginary parts of a deviation of at "
           "most " +
           lower_decimal(noise_.deviation) + " each: that of blocks of " +
           text_of(design_.at("design").at("block_length")) + " samples with white noise and " +
           (decibels != nullptr ? "an SNR of at least " + text_of(*decibels) + " dB"
                                : "a deviation of at most " + text_of(noise.at("deviation")));
  }

  [[nodiscard]] std::string hypotheses() const {
    const auto text = [](const Tree& table, const char* key) { return text_of(table.at(key)); };
    return filter_words() + ", is fed with the bins (4.9) of a tone of " + amplitude_words() +
           ", constant within each block and continuous in phase from one to the next, whose offset is "
           "between " +
           text_of(assume_.at("offset").at(0)) + " and " + text_of(assume_.at("offset").at(1)) +
           " bins in every block and changes by at most " + text(assume_, "slew") +
           " bins from one to the next, " + noise_words() +
           ". Its first prediction has a root amplitude x1 within " +
           text(assume_, "initial_amplitude_error") + " of the tone's, relative to it, a phase within " +
           text(assume_, "initial_phase_error") + " rad at the middle of the block, an offset within " +
           text(assume_, "initial_offset_error") + " bins, and the covariance " +
           (covariance_ ? covariance_text_
                        : "of the steady state in exact lock in the middle of these offsets") +
           ". Then ";
  }

  void check_one(const Tree& derivation) {
    const std::string& id = derivation.at("id").text();
    Objections objections;
    const bool is_known = id == (is_gaussian_ ? "lock-in-noise" : "lock-set") || is_false_lock(id);
    if (!is_known || !seen_.insert(id).second) {
      result_.parts.push_back({id, {is_known ? "a second derivation of this id" : kUnknown}});
      return;
    }
    check_derivation(derivation,
                     is_false_lock(id) ? false_lock(derivation, problem_, objections)
                     : is_gaussian_    ? lock_in_noise(derivation, problem_,
                                                       {noise_.deviation, noise_.blocks, start_, covariance_},
                                                       result_.cells, objections)
                                       : lock_set(derivation, objections),
                     objections);
    if (objections.empty() && verdict_of(derivation) == Verdict::proved) {
      (is_false_lock(id) ? false_locks_[id] : proved_) = &derivation;
    }
    result_.parts.push_back({id, objections});
  }

  /// Nothing for what proposes nothing.
  std::optional<Proposal> read_proposal(const Tree& derivation, Objections& objections) const {
    const Tree* evidence = find_evidence(derivation, "lock");
    if (evidence == nullptr || derivation.at("evidence").elements().size() != 1) {
      objections.emplace_back("the evidence is not \"lock\" alone");
      return std::nullopt;
    }
    const Tree& numbers = evidence->at("numbers");
    Proposal found{{exact_matrix(evidence->at("matrices").at("frame")), exact_number(numbers.at("above")),
                    exact_number(numbers.at("below")), exact_number(numbers.at("floor"))},
                   read_rate(numbers, ""),
                   std::nullopt};
    if (numbers.find("late_radius") != nullptr) {
      found.late = read_rate(numbers, "late_");
    }
    if (!certainly_at_most(one, found.set.above) || !certainly_at_most(one, found.set.below) ||
        !is_rate(found.rate) || (found.late && !is_rate(*found.late))) {
      objections.emplace_back("the evidence is no set");
      return std::nullopt;
    }
    return found;
  }

  Derivation lock_set(const Tree& derivation, Objections& objections) {
    Derivation found;
    found.title = "A set about the exact lock that is never left";
    const std::optional<Proposal> proposal = read_proposal(derivation, objections);
    if (!proposal) {
      return found;
    }
    const BlockLock lock(problem_, proposal->set);
    const Ball start = lock.length_of(start_);
    const Ball disturbance = lock.disturbance();
    const Ball resting = rest(disturbance, proposal->rate);
    const bool falls = lock.falls(proposal->rate, result_.cells);
    const bool tolerates = certainly_at_most(resting, proposal->rate.radius);
    // The steady state is in every set that is verified: docs/block-tracker.md, section 4.
    const bool starts = certainly_at_most(start, proposal->rate.radius) && falls &&
                        (!covariance_ || lock.holds(*covariance_));
    found.conditions = {{"rate", "errors fall", proved_if(falls)},
                        {"noise", "noise and slew do not push errors out", proved_if(tolerates)},
                        {"start", "the starts are in the set", proved_if(starts)}};
    // The evidence is there for these two; whether it holds the starts is the certificate's to say.
    if (!falls) {
      objections.emplace_back("errors do not certainly fall at that rate");
    }
    if (!tolerates) {
      objections.emplace_back("noise and slew may push errors out of the set");
    }
    if (!falls || !tolerates || !starts) {
      return found;
    }
    const auto add = [&](const char* name, const Ball& value) {
      found.quantities.push_back({name, value, Sense::bounds_above});
    };
    const Ball ever = max(start, resting);
    add("contraction_rate", proposal->rate.rate);
    add("offset_error_bound", ever * lock.reach(2));
    add("phase_error_bound", ever * lock.reach(1));
    add("amplitude_error_bound", ever * lock.reach(0));
    std::optional<BlockRate> late;
    if (proposal->late) {
      // Every error comes below its radius, and stays there.
      if (certainly_less(resting, proposal->late->radius) &&
          certainly_at_most(rest(disturbance, *proposal->late), proposal->late->radius) &&
          lock.falls(*proposal->late, result_.cells)) {
        late = proposal->late;
      } else {
        objections.emplace_back("the late set is not verified");
      }
    }
    const Ball last = late ? rest(disturbance, *late) : resting;
    add("ultimate_offset_error", last * lock.reach(2));
    const Tree* blocks = derivation.at("quantities").find("settling_blocks");
    const Tree* settled = derivation.at("quantities").find("settled_offset_error");
    if (blocks != nullptr && settled != nullptr) {
      const Ball error = high_of(*settled);
      const auto block = blocks_until(error / lock.reach(2), start, disturbance, proposal->rate, late);
      add("settling_blocks", block ? *block : Ball::everything());
      add("settled_offset_error", block ? error : Ball::everything());
    }
    return found;
  }

  /// The first block from which |C^-1 z| is at most that for ever.
  static std::optional<Ball> blocks_until(const Ball& length, const Ball& start, const Ball& disturbance,
                                          const BlockRate& rate, const std::optional<BlockRate>& late) {
    Ball e = start;
    constexpr int kMost = 100'000;
    for (int block = 1; block < kMost; ++block) {
      const BlockRate& now = late && certainly_at_most(e, late->radius) ? *late : rate;
      if (certainly_at_most(rest(disturbance, now), length) && certainly_at_most(e, length)) {
        return Ball(static_cast<double>(block));
      }
      e = (now.rate * e + disturbance).upper();
    }
    return std::nullopt;
  }

  /// What the verified derivation says of the quantity; a ball of everything when it says nothing.
  [[nodiscard]] Ball at_most(const char* name) const {
    const Tree* quantity = proved_ != nullptr ? proved_->at("quantities").find(name) : nullptr;
    const Tree* number = quantity != nullptr ? quantity->find("hi") : nullptr;
    return number != nullptr ? exact_number(*number) : Ball::everything();
  }
  [[nodiscard]] Quantity bounded(const char* name) const {
    return {name, at_most(name), Sense::bounds_above};
  }

  Claim check_one_claim(const Tree& claim, Objections& objections) const {
    const std::string& id = claim.at("id").text();
    if (id == kEveryStart) {
      return every_start(claim, objections);
    }
    if (id.starts_with(kClaimOf) && is_false_lock(id.substr(kClaimOf.size()))) {
      return false_lock_claim(claim, id.substr(kClaimOf.size()), objections);
    }
    const Tree& require = design_.at("require");
    if (is_gaussian_) {
      return claim_in_noise(claim, objections);
    }
    const bool is_asked = id == kGuarantee ||
                          (id == kOffsetError && require.find("offset_error_below") != nullptr) ||
                          (id == kSettles && require.find("settles_within") != nullptr);
    if (!is_asked) {
      objections.emplace_back(kUnknown);
      return {};
    }
    Claim found = id == kGuarantee ? guarantee(claim) : required_claim(id);
    if (proved_ == nullptr) {
      objections.emplace_back(kUnverified);
    }
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Claim claim_in_noise(const Tree& claim, Objections& objections) const {
    const std::string& id = claim.at("id").text();
    const bool is_required =
        id == kProbability && design_.at("require").find("probability_of_losing_lock_below") != nullptr;
    if (id != kLosingLock && !is_required) {
      objections.emplace_back(kUnknown);
      return {};
    }
    if (proved_ == nullptr) {
      objections.emplace_back(kUnverified);
    }
    Claim found;
    const Ball probability = at_most("probability_of_losing_lock");
    if (is_required) {
      found.statement = hypotheses_ + required_text(id) + ".";
      found.verdict = proved_if(certainly_less(probability, asked("probability_of_losing_lock_below")));
      found.evidence = {bounded("probability_of_losing_lock")};
    } else {
      const Tree& evidence = claim.at("evidence");
      const auto most = [&](const char* name) { return upper_decimal(high_of(evidence.at(name))); };
      found.is_summary = true;
      found.verdict = proved_if(certainly_less(probability, one) && at_most("offset_error_bound").finite());
      found.evidence = {bounded("probability_of_losing_lock"), bounded("offset_error_bound")};
      found.statement = hypotheses_ + "the probability that within the first " +
                        text_of(assume_.at("blocks")) + " blocks the offset error of an estimate exceeds " +
                        most("offset_error_bound") + " bins is at most " +
                        most("probability_of_losing_lock") + ".";
    }
    check_claim(claim, found, objections);
    return found;
  }

  /// Refuted by any false lock.
  [[nodiscard]] Claim every_start(const Tree& claim, Objections& objections) const {
    Claim found;
    found.is_summary = true;
    found.verdict = false_locks_.empty() ? Verdict::undecided : Verdict::refuted;
    found.statement = filter_words() + ", is fed, without noise, with the bins (4.9) of a tone of " +
                      amplitude_words() + " and a constant offset between " +
                      text_of(assume_.at("offset").at(0)) + " and " + text_of(assume_.at("offset").at(1)) +
                      " bins. Whatever its first prediction and covariance, the offset error of some "
                      "prediction is less than half a bin.";
    if (false_locks_.empty()) {
      objections.emplace_back(kUnverified);
    }
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Claim false_lock_claim(const Tree& claim, const std::string& id,
                                       Objections& objections) const {
    Claim found;
    const auto lock = false_locks_.find(id);
    if (lock == false_locks_.end()) {
      objections.emplace_back(kUnverified);
      return found;
    }
    const Tree& said = claim.at("evidence");
    const Tree& quantities = lock->second->at("quantities");
    constexpr int kDigits = 4;
    const auto both_ends = [&](const char* name) {
      return lower_decimal(low_of(said.at(name)), kDigits) + " and " +
             upper_decimal(high_of(said.at(name)), kDigits);
    };
    const auto established = [&](const char* name) -> Range {
      const Tree* value = quantities.find(name);
      return value == nullptr ? Range(Ball::everything()) : Range(low_of(*value), high_of(*value));
    };
    const Tree* amplitude = quantities.find("amplitude");
    const FalseLockTone tone = false_lock_tone(*lock->second);
    found.verdict = Verdict::proved;
    found.evidence = {
        {"offset_error", established("offset_error")},
        {"fixed_offset_error", established("fixed_offset_error")},
        {"amplitude", amplitude == nullptr ? Ball::everything() : high_of(*amplitude), Sense::bounds_above}};
    found.statement = filter_words() +
                      ", is fed, without noise, with the bins (4.9) of a tone of the amplitude " +
                      tone.amplitude + " and the constant offset " + tone.offset +
                      " bins. From every first prediction and covariance of the set " + id +
                      ", the offset error of every prediction is between " + both_ends("offset_error") +
                      " bins, for ever; it tends to one between " + both_ends("fixed_offset_error") +
                      " bins, and the estimated amplitude to at most " +
                      upper_decimal(high_of(said.at("amplitude")), kDigits) + " of the tone's.";
    check_claim(claim, found, objections);
    return found;
  }

  [[nodiscard]] Claim required_claim(const std::string& id) const {
    Claim found;
    found.statement = hypotheses_ + required_text(id) + ".";
    if (id == kOffsetError) {
      found.verdict = proved_if(certainly_less(at_most("offset_error_bound"), asked("offset_error_below")));
      found.evidence = {bounded("offset_error_bound")};
    } else {
      found.verdict = proved_if(certainly_at_most(at_most("settling_blocks"), asked("settles_within")) &&
                                certainly_less(at_most("settled_offset_error"), asked("settled_below")));
      found.evidence = {bounded("settling_blocks"), bounded("settled_offset_error")};
    }
    return found;
  }

  /// With the numbers that the claim names, which are checked beside this.
  [[nodiscard]] Claim guarantee(const Tree& claim) const {
    const Tree& evidence = claim.at("evidence");
    const auto most = [&](const char* name) { return upper_decimal(high_of(evidence.at(name))); };
    Claim found;
    found.is_summary = true;
    found.verdict =
        proved_if(at_most("offset_error_bound").finite() && at_most("ultimate_offset_error").finite());
    found.evidence = {bounded("offset_error_bound"), bounded("ultimate_offset_error"),
                      bounded("settling_blocks"), bounded("settled_offset_error")};
    found.statement = hypotheses_ + "the offset error of every estimate and prediction is at most " +
                      most("offset_error_bound") + " bins, and in the long run at most " +
                      most("ultimate_offset_error") + " bins";
    if (evidence.find("settling_blocks") != nullptr || evidence.find("settled_offset_error") != nullptr) {
      found.statement +=
          "; from block " + most("settling_blocks") + " on at most " + most("settled_offset_error") + " bins";
    }
    found.statement += ".";
    return found;
  }

  const Tree& certificate_;
  const Tree& design_;
  const Tree& assume_;
  Verification& result_;
  BlockProblem problem_;
  BlockNoise noise_;  ///< deviation and blocks, where the noise is Gaussian
  bool is_gaussian_ = false;
  bool one_amplitude_ = true;
  Vector3 start_;
  std::optional<Matrix3> covariance_;
  std::string covariance_text_;
  std::string hypotheses_;
  std::set<std::string> seen_;
  const Tree* proved_ = nullptr;  ///< the derivation "lock-set", once verified, and PROVED as a whole
  std::map<std::string, const Tree*> false_locks_;  ///< likewise, by their ids
};

}  // namespace

TrackerKind dft_block_tracker() {
  return {"dft-block-ekf", [](const Tree& certificate, bool /*all_boxes*/, Verification& result) {
            BlockVerifier(certificate, result).run();
          }};
}

}  // namespace veritrack::checker
