#include "checker/dft_block/block_design.hpp"

#include "checker/document/design_number.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

constexpr int kMostHalfWidth = 8;

void read_pair(const Tree& pair, const std::string& name, Ball& low, Ball& high, Objections& objections) {
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

/// The deviation of the samples: 10 log10(amplitude^2 / (2 deviation^2)) is the signal-to-noise ratio in dB.
Ball sample_deviation(const Ball& amplitude, const Ball& decibels) {
  return amplitude * exp(-(decibels / Ball(20.0)) * log(Ball(10.0))) / sqrt(two);
}

}  // namespace

BlockDesign::BlockDesign(const Tree& design, Objections& objections)
    : design_(design), assume_(design.at("assume")) {
  read_design(objections);
  read_assumptions(objections);
  requirements_ = read_requirements(objections);
}

void BlockDesign::read_design(Objections& objections) {
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
  if (problem_.half_width == 0) {
    objections.emplace_back("half_width must be a whole number from 1 to 8");
  }
  read_bins(objections);
}

/// The noise of the samples is independent from bin to bin, with the same variance in real and imaginary
/// part, in the bins strictly between 0 and T/2: bins 0 and T/2 are real, and bin T - m is the conjugate of
/// bin m. Those are M - L ... M + L; without a centre there has to be one for which they are, and L + 1 is
/// the lowest.
void BlockDesign::read_bins(Objections& objections) const {
  const Tree& chosen = design_.at("design");
  const auto whole = [&](const char* key) {
    Ball number = read_positive(chosen.at(key), key, objections);
    if (arb_is_int(number.raw()) == 0) {
      objections.push_back(std::string(key) + " must be a whole number");
    }
    return number;
  };
  if (chosen.find("block_length") == nullptr) {
    if (chosen.find("centre") != nullptr) {
      objections.emplace_back("a centre goes with block_length");
    }
    return;
  }
  const Ball width(static_cast<double>(problem_.half_width));
  const Ball length = whole("block_length");
  const Ball centre = chosen.find("centre") != nullptr ? whole("centre") : width + one;
  if (!certainly_less(width, centre) || !certainly_less(two * (centre + width), length)) {
    objections.emplace_back(
        "the bins M - L ... M + L are not all between 1 and half of block_length, where white noise is "
        "independent from bin to bin");
  }
}

void BlockDesign::read_assumptions(Objections& objections) {
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
  start_.errors = {
      read_not_negative(assume_.at("initial_amplitude_error"), "initial_amplitude_error", objections),
      read_not_negative(assume_.at("initial_phase_error"), "initial_phase_error", objections),
      read_not_negative(assume_.at("initial_offset_error"), "initial_offset_error", objections)};
  if (!certainly_less(start_.errors[0], one)) {
    objections.emplace_back("initial_amplitude_error must be below 1");
  }
  read_covariance(objections);
}

/// A bound, or Gaussian noise of the samples, from which that of the bins follows.
void BlockDesign::read_noise(Objections& objections) {
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
    deviation = sample_deviation(problem_.amplitude_low, read_number(*decibels, objections));
  } else {
    deviation = read_positive(noise.at("deviation"), "deviation", objections);
  }
  // Real and imaginary part of (4.4) have the variance deviation^2/(2 T).
  const Ball length = read_number(design_.at("design").at("block_length"), objections);
  deviation_ = deviation / sqrt(two * length);
  if (!certainly_positive(deviation_)) {
    objections.emplace_back("the deviation of the noise is not a positive number");
  }
  blocks_ = read_positive(assume_.at("blocks"), "blocks", objections);
  if (!certainly_at_most(one, blocks_)) {
    objections.emplace_back("blocks must be at least 1");
  }
}

void BlockDesign::read_covariance(Objections& objections) {
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
  start_.covariance = matrix;
}

std::vector<Requirement> BlockDesign::read_requirements(Objections& objections) {
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

std::string BlockDesign::asked_text(const char* key) const {
  return text_of(design_.at("require").at(key));
}
Ball BlockDesign::asked(const char* key) const {
  Objections read_before;
  return read_number(design_.at("require").at(key), read_before);
}
std::string BlockDesign::required_text(const std::string& id) const {
  if (id == kProbability) {
    return "within the first " + text_of(assume_.at("blocks")) +
           " blocks lock is lost, the offset error exceeding half a bin, with a probability below " +
           asked_text("probability_of_losing_lock_below");
  }
  return id == kOffsetError
             ? "the offset error is below " + asked_text("offset_error_below") + " bins in every block"
             : "from block " + asked_text("settles_within") + " on, the offset error is below " +
                   asked_text("settled_below") + " bins";
}

std::string BlockDesign::filter_words() const {
  const Tree& chosen = design_.at("design");
  const auto text = [&](const char* key) { return text_of(chosen.at(key)); };
  return "In exact arithmetic, the block tracker without leaks, with Q = diag(" + text("q1") + ", " +
         text("q2") + ", " + text("q3") + "), R = " + text("r") + " I and the bins M - " +
         text("half_width") + " ... M + " + text("half_width");
}

std::string BlockDesign::amplitude_words() const {
  const Tree& amplitude = assume_.at("amplitude");
  return one_amplitude_
             ? "the amplitude " + text_of(amplitude)
             : "a constant amplitude from " + text_of(amplitude.at(0)) + " to " + text_of(amplitude.at(1));
}

std::string BlockDesign::noise_words() const {
  const Tree& noise = assume_.at("noise");
  if (!is_gaussian_) {
    return "plus noise whose length in all bins of a block together is at most " + text_of(noise);
  }
  const Tree* decibels = noise.find("snr_db");
  return gaussian_words(deviation_, decibels != nullptr
                                        ? "an SNR of at least " + text_of(*decibels) + " dB"
                                        : "a deviation of at most " + text_of(noise.at("deviation")));
}

std::string BlockDesign::gaussian_words(const Ball& deviation, const std::string& of_samples) const {
  return "in a way that does not depend on the noise, plus Gaussian noise of mean zero, independent from "
         "block "
         "to block and from bin to bin, with independent real and imaginary parts of a deviation of at "
         "most " +
         lower_decimal(deviation) + " each: that of the bins between 0 and T/2 of blocks of T = " +
         text_of(design_.at("design").at("block_length")) + " samples with white noise and " + of_samples;
}

Ball BlockDesign::deviation_at(const std::string& decibels) const {
  Objections read_before;
  const Ball length = read_number(design_.at("design").at("block_length"), read_before);
  return sample_deviation(problem_.amplitude_low, from_decimal(decibels)) / sqrt(two * length);
}

std::string BlockDesign::hypotheses_at(const std::string& decibels) const {
  return hypotheses_with(gaussian_words(deviation_at(decibels), "an SNR of at least " + decibels + " dB"));
}

std::string BlockDesign::hypotheses_with(const std::string& noise) const {
  const auto text = [](const Tree& table, const char* key) { return text_of(table.at(key)); };
  return filter_words() + ", is fed with the bins (4.9) of a tone of " + amplitude_words() +
         ", constant within each block and continuous in phase from one to the next, whose offset is "
         "between " +
         text_of(assume_.at("offset").at(0)) + " and " + text_of(assume_.at("offset").at(1)) +
         " bins in every block and changes by at most " + text(assume_, "slew") +
         " bins from one to the next, " + noise + ". Its first prediction has a root amplitude x1 within " +
         text(assume_, "initial_amplitude_error") + " of the tone's, relative to it, a phase within " +
         text(assume_, "initial_phase_error") + " rad at the middle of the block, an offset within " +
         text(assume_, "initial_offset_error") + " bins, and the covariance " +
         (start_.covariance ? covariance_text_
                            : "of the steady state in exact lock in the middle of these offsets") +
         ". Then ";
}

const std::string& BlockDesign::assumed_text(const char* key) const {
  return text_of(assume_.at(key));
}

const std::string& BlockDesign::assumed_text(const char* key, std::size_t index) const {
  return text_of(assume_.at(key).at(index));
}

}  // namespace veritrack::checker
