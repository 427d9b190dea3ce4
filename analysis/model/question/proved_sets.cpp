#include "analysis/model/question/proved_sets.hpp"

#include <algorithm>

#include <cmath>
#include <utility>

#include "analysis/model/question/tube_search.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/sets/harder_questions.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

TubeSearch search_for(const SetQuestion& question) {
  return question.tone_at ? TubeSearch(question.tone_at, question.tracker, question.band, question.deadline)
                          : TubeSearch(question.tone, question.tracker, question.band, question.deadline);
}

/// The sets of a question, one after the other.
class SetsProof {
 public:
  SetsProof(const SetQuestion& question, const SetProgress& progress)
      : question_(&question), progress_(&progress), search_(search_for(question)) {}

  [[nodiscard]] ProvedSets all() {
    const std::vector<SetTask> tasks = tasks_of(*question_);
    tasks_ = static_cast<double>(tasks.size());
    for (const SetTask& task : tasks) {
      add(task);
      done_ += 1.0;
    }
    add_long_run();
    if (const auto& required = question_->required_error) {
      ProvedSet& deciding = sets_.assumed ? *sets_.assumed : sets_.starts;
      deciding = lowered_to(question_->tracker, std::move(deciding), question_->deviations, *required);
    }
    if (question_->is_thorough && sets_.assumed && !sets_.assumed->tubes.tubes.empty()) {
      sets_.linear = search_.linear_over(sets_.assumed->tubes);
    }
    return std::move(sets_);
  }

 private:
  void add(SetTask task) {
    if (sets_.assumed && sets_.assumed->is_proved()) {
      task.known_noise = task.largest_noise ? sets_.assumed->tubes.noise : 0.0;
      task.known_slew = task.largest_slew ? sets_.assumed->tubes.slew : 0.0;
    }
    if (task.name == kStarts) {
      sets_.starts = proved(task, &sets_.slices);
    } else if (task.name == kAssumed) {
      sets_.assumed = for_requirement(task, proved(task));
    } else {
      (task.largest_noise ? sets_.noise : sets_.slew) = proved(task);
    }
  }

  [[nodiscard]] ProvedSet proved(const SetTask& task, std::vector<FrequencySlice>* slices = nullptr) const {
    const auto tell = [&](double share) {
      if (*progress_) {
        (*progress_)((done_ + share) / tasks_);
      }
    };
    return conclude(question_->tracker, search_.prove(task, tell), question_->deviations, slices);
  }

  [[nodiscard]] bool meets(const ProvedSet& set) const {
    const Interval& required = *question_->required_error;
    const auto lowered = [&] { return lowered_to(question_->tracker, set, question_->deviations, required); };
    // cannot bind (required): this only chooses among proved sets, and the verdict is of the chosen one.
    return set.is_proved() && set.start_share <= 1.0 &&
           rigor::certainly_less(Interval(lowered().frequency_error), required);
  }

  /// A set for more is also one for less: where the set does not meet the requirement, one for noise and slew
  /// that do not depend on the assumed ones may.
  [[nodiscard]] ProvedSet for_requirement(const SetTask& task, ProvedSet set) const {
    constexpr int kSteps = 2;
    for (int steps = 0;
         question_->required_error && steps < kSteps && !meets(set) && !question_->deadline.is_over();
         ++steps) {
      SetTask louder = task;
      louder.noise = sets::raised(Interval(question_->noise), steps).upper();
      louder.slew = sets::raised(Interval(question_->slew), steps).upper();
      if (ProvedSet other = proved(louder); meets(other)) {
        set = std::move(other);
      }
    }
    return set;
  }

  void add_long_run() {
    if (question_->tone.filter == nullptr || !sets_.assumed || question_->slew > 0.0) {
      return;
    }
    if (auto tubes = search_.prove_long_run(sets_.assumed->tubes)) {
      ProvedSet inner = conclude(question_->tracker, *std::move(tubes), question_->deviations);
      if (inner.settled_error < sets_.assumed->settled_error) {
        sets_.long_run = std::move(inner);
      }
    }
  }

  const SetQuestion* question_;
  const SetProgress* progress_;
  TubeSearch search_;
  ProvedSets sets_;
  double tasks_ = 1.0;
  double done_ = 0.0;
};

}  // namespace

ProvedSets prove_sets(const SetQuestion& question, const SetProgress& progress) {
  const rigor::UpwardRounding upward;
  return SetsProof(question, progress).all();
}

const ProvedSet& ProvedSets::best() const {
  if (!phases || !phases->assumed.is_proved() || phases->assumed.start_share > 1.0) {
    return deciding();
  }
  const bool is_better = !deciding().is_proved() || deciding().start_share > 1.0 ||
                         (phases->assumed.settled_error < settled_error_of(*this) &&
                          phases->assumed.frequency_error <= deciding().frequency_error);
  return is_better ? phases->assumed : deciding();
}

double settled_error_of(const ProvedSets& sets) {
  return sets.long_run ? sets.long_run->settled_error : sets.assumed ? sets.assumed->settled_error : INFINITY;
}

double best_settled_error_of(const ProvedSets& sets) {
  const ProvedSet& best = sets.best();
  return best.is_without_tubes() ? std::min(settled_error_of(sets), best.settled_error)
                                 : settled_error_of(sets);
}

}  // namespace veritrack::model
