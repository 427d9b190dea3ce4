// The claims of a certificate for a model, decided from its verified sets of tubes.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/document/parts.hpp"
#include "checker/model/model_design.hpp"
#include "checker/model/required_claims.hpp"
#include "checker/model/tube_family.hpp"
#include "checker/sets/frequency_words.hpp"

namespace veritrack::checker {

class ModelClaims {
 public:
  /// Decides the claims of a certificate with this design. `sets`: the verified ones, by name. All must
  /// outlive this.
  ModelClaims(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
              const std::map<std::string, TubeFamily>& sets, std::int64_t& cells);

  /// The requirements of [require].
  [[nodiscard]] std::vector<Requirement> required() const { return required_.all(); }
  /// The claim in the checker's words, with its verdict. Objects where the certificate says something else.
  Claim check(const Tree& claim, Objections& objections) const;

 private:
  /// The scope of a claim: a part of the band, or none for the whole band.
  using Part = std::optional<BandPart>;
  /// The part of a claim that may name one. Objects to what is not a part of the assumed band.
  [[nodiscard]] Part part_of(const Tree& claim, Objections& objections) const;
  [[nodiscard]] bool covers_all(const TubeFamily& family, const Part& part = {}) const;
  /// A set of that name that covers the part.
  [[nodiscard]] const TubeFamily* find(const std::string& name, const Part& part = {}) const;
  /// A set that covers the part, with noise and slew that are at least the assumed ones.
  [[nodiscard]] const TubeFamily* deciding_set(const Part& part = {}) const;
  /// The set inside the deciding set in which states are in the long run, or none.
  [[nodiscard]] const TubeFamily* long_run_set(const Part& part = {}) const;
  /// The tubes of the deciding set, or of the long run, that contain all states from this sample on; each
  /// with one level.
  [[nodiscard]] std::vector<TubeSet> reached_by(const TubeFamily& family, const Ball& sample) const;
  [[nodiscard]] TubeSet reached_by(const TubeSet& set, const TubeSet* inner, const Ball& sample) const;
  /// The name of the set that a guarantee is about.
  [[nodiscard]] std::string deciding_name() const;
  /// "starts", if there are lower levels to reach.
  [[nodiscard]] const TubeFamily* settling_set(const Part& part = {}) const;
  [[nodiscard]] FamilyCheck of(const TubeFamily& family) const { return of(family.sets); }
  [[nodiscard]] FamilyCheck of(const std::vector<TubeSet>& sets) const { return {*model_, sets, *cells_}; }
  /// The assumed starts are in the set.
  [[nodiscard]] bool contains_assumed_starts(const TubeFamily& family) const;
  [[nodiscard]] bool settles(const TubeFamily& family) const;
  /// The frequency is defined in the whole set, and its error stays at or below this, which is nearer to the
  /// true lock than to any other that the formulas show (false_lock.hpp). Only such sets support statements
  /// about lock.
  [[nodiscard]] bool is_lock(const TubeFamily& family, const Ball& error, const Part& part = {}) const;

  [[nodiscard]] Claim bound() const;
  [[nodiscard]] Claim settling() const;
  [[nodiscard]] Claim size(const Tree& claim) const;
  [[nodiscard]] Claim long_run(const std::string& id) const;
  /// In Gaussian noise of this deviation the probability that the assumed starts leave the set is at most
  /// this number, or less than it.
  [[nodiscard]] bool is_seldom_left(const TubeFamily* set, const Ball& deviation, const Ball& probability,
                                    bool strictly) const;
  [[nodiscard]] Claim required_lock(const Tree& claim) const;
  [[nodiscard]] Claim reported_lock(const Tree& claim) const;
  [[nodiscard]] Claim capture(const Tree& claim, const Part& part) const;
  [[nodiscard]] Claim captured_in_time(const Tree& claim) const;
  [[nodiscard]] Claim guarantee(const Tree& claim, const Part& part) const;
  /// Among the sets with these names that cover the part and are never left, and that are a lock with this
  /// error: the one with the largest noise or slew, the first of equal ones; none where all are 0.
  [[nodiscard]] const TubeFamily* largest(std::initializer_list<const char*> names,
                                          double (TubeFamily::*tolerated)() const, const Ball& error,
                                          const Part& part) const;
  [[nodiscard]] Claim limits(const Tree& claim, const Part& part) const;
  /// Without noise some set that is a lock with this error contains frequency errors up to `reach`.
  [[nodiscard]] bool contains_errors(const Ball& reach, const Ball& error, const Part& part) const;
  [[nodiscard]] Claim reach(const Tree& claim, const Part& part) const;
  [[nodiscard]] Claim slew_limit(const Tree& claim, const Part& part) const;
  [[nodiscard]] Claim steady_state(const Tree& claim, const Part& part) const;

  const Tree* tree_;  ///< the design
  const ModelDesign* design_;
  const TrackedModel* model_;
  const std::map<std::string, TubeFamily>* sets_;
  std::int64_t* cells_;
  ModelWords words_;
  RequiredClaims required_;
  FrequencyWords units_;
};

}  // namespace veritrack::checker
