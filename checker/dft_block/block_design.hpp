// The design of a block tracker as a certificate repeats it, and its words in sentences.
#pragma once

#include <string>
#include <vector>

#include "checker/dft_block/bounded_lock_check.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// The claims that [require] may ask for.
inline const std::string kOffsetError = "dft-block/offset-error";
inline const std::string kSettles = "dft-block/settles";
inline const std::string kProbability = "dft-block/probability-of-losing-lock";

class BlockDesign {
 public:
  /// Objects to an invalid design; no statement may then be made about it. The tree must outlive this.
  BlockDesign(const Tree& design, Objections& objections);

  [[nodiscard]] const BlockProblem& problem() const { return problem_; }
  [[nodiscard]] const BlockStart& start() const { return start_; }
  [[nodiscard]] bool is_gaussian() const { return is_gaussian_; }
  /// With Gaussian noise: the deviation of each part of a bin, and the blocks.
  [[nodiscard]] const Ball& deviation() const { return deviation_; }
  [[nodiscard]] const Ball& blocks() const { return blocks_; }
  /// The deviation at another signal-to-noise ratio of the samples, a decimal in dB. Only with Gaussian noise
  /// and one amplitude.
  [[nodiscard]] Ball deviation_at(const std::string& decibels) const;
  [[nodiscard]] bool has_one_amplitude() const { return one_amplitude_; }

  [[nodiscard]] const std::vector<Requirement>& requirements() const { return requirements_; }
  [[nodiscard]] bool asks_for(const char* key) const { return design_.at("require").find(key) != nullptr; }
  /// The number of this key of [require], which must be there.
  [[nodiscard]] Ball asked(const char* key) const;
  /// The aim of the claim of this id, in short.
  [[nodiscard]] std::string required_text(const std::string& id) const;

  /// The filter, with which every sentence begins.
  [[nodiscard]] std::string filter_words() const;
  [[nodiscard]] std::string amplitude_words() const;
  /// Everything up to what is claimed of the assumed tones, noise and starts.
  [[nodiscard]] std::string hypotheses() const { return hypotheses_with(noise_words()); }
  /// The same with another signal-to-noise ratio, as deviation_at.
  [[nodiscard]] std::string hypotheses_at(const std::string& decibels) const;
  /// The decimal of a key of [assume]; `index` of an array.
  [[nodiscard]] const std::string& assumed_text(const char* key) const;
  [[nodiscard]] const std::string& assumed_text(const char* key, std::size_t index) const;

 private:
  void read_design(Objections& objections);
  void read_bins(Objections& objections) const;
  void read_assumptions(Objections& objections);
  void read_noise(Objections& objections);
  void read_covariance(Objections& objections);
  std::vector<Requirement> read_requirements(Objections& objections);
  [[nodiscard]] std::string asked_text(const char* key) const;
  [[nodiscard]] std::string noise_words() const;
  [[nodiscard]] std::string gaussian_words(const Ball& deviation, const std::string& of_samples) const;
  [[nodiscard]] std::string hypotheses_with(const std::string& noise) const;

  const Tree& design_;
  const Tree& assume_;
  BlockProblem problem_;
  BlockStart start_;
  std::string covariance_text_;
  Ball deviation_, blocks_;
  bool is_gaussian_ = false;
  bool one_amplitude_ = true;
  std::vector<Requirement> requirements_;
};

}  // namespace veritrack::checker
