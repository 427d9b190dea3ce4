#include "certificates/model/model_limits.hpp"

#include <cmath>
#include <vector>

namespace veritrack::certificates {

namespace {

using model::ProvedSet;
using Sets = std::vector<const ProvedSet*>;
using Part = std::optional<model::FrequencyRange>;

double noise_of(const ProvedSet& set) {
  return set.tubes.noise;
}
double slew_of_set(const ProvedSet& set) {
  return set.tubes.slew;
}
double reach_of(const ProvedSet& set) {
  return set.reach;
}

/// The sets in the certificate, in this order; a part of the set for the largest slew is not written.
Sets in_order(std::initializer_list<const std::optional<ProvedSet>*> sets,
              const ProvedSet* starts = nullptr) {
  Sets found;
  if (starts != nullptr) {
    found.push_back(starts);
  }
  for (const std::optional<ProvedSet>* set : sets) {
    if (*set) {
      found.push_back(&**set);
    }
  }
  return found;
}
Sets for_noise(const ModelSets& sets) {
  Sets found = in_order({&sets.noise, &sets.assumed, &sets.slew});
  if (sets.phases) {
    found.push_back(&sets.phases->assumed);
    if (sets.phases->noise) {
      found.push_back(&*sets.phases->noise);
    }
  }
  if (sets.averages && sets.averages->noise) {
    found.push_back(&*sets.averages->noise);
  }
  return found;
}
Sets for_slew(const ModelSets& sets) {
  Sets found = in_order({&sets.slew, &sets.assumed});
  if (sets.phases) {
    found.push_back(&sets.phases->assumed);
  }
  return found;
}

bool has_part(const ProvedSet& set) {
  return set.has_part() && set.tubes.name != "slew";
}
/// No part: the whole band.
bool covers(const ProvedSet& set, const Part& part) {
  return set.is_proved() ||
         (part && has_part(set) && set.tubes.part.low <= part->low && part->high <= set.tubes.part.high);
}

/// Among those that cover the part, and that are a lock. A value that is not a number is not a size.
LargestOfSets largest(const Sets& sets, const Part& part, double (*size)(const ProvedSet&)) {
  LargestOfSets found;
  for (const ProvedSet* set : sets) {
    const double here = size(*set);
    if (covers(*set, part) && names_lock(*set) && std::isfinite(here) && here > found.size) {
      found = {here, set};
    }
  }
  return found;
}

/// The place of the largest known value: the whole band, or else the widest part. Empty where there is none.
struct Where {
  Part range;
  std::optional<BandPart> part;
};
std::optional<Where> where(const Sets& sets, const ModelAssumptions& assume,
                           double (*size)(const ProvedSet&)) {
  if (largest(sets, std::nullopt, size).set != nullptr) {
    return Where{};
  }
  std::optional<Where> widest;
  for (const ProvedSet* set : sets) {
    const model::FrequencyRange& range = set->tubes.part;
    const bool is_wider = !widest || range.high - range.low > widest->range->high - widest->range->low;
    if (!has_part(*set) || !names_lock(*set) || !(size(*set) > 0.0) || !is_wider) {
      continue;
    }
    if (auto part = band_part(assume, range)) {
      widest = Where{range, std::move(part)};
    }
  }
  return widest;
}

}  // namespace

std::optional<ModelLimits> limits_of(const ModelSets& sets, const ModelAssumptions& assume) {
  const auto place = sets.objection.empty() ? where(for_noise(sets), assume, noise_of) : std::nullopt;
  if (!place) {
    return std::nullopt;
  }
  Sets all = in_order({&sets.assumed, &sets.noise, &sets.slew}, &sets.starts);
  if (sets.phases) {
    all.push_back(&sets.phases->starts);
  }
  if (sets.averages) {
    all.push_back(&sets.averages->starts);
  }
  return ModelLimits{largest(for_noise(sets), place->range, noise_of), largest(all, place->range, reach_of),
                     place->part};
}

std::optional<SlewLimit> slew_limit_of(const ModelSets& sets, const ModelAssumptions& assume) {
  const auto place = sets.objection.empty() ? where(for_slew(sets), assume, slew_of_set) : std::nullopt;
  if (!place) {
    return std::nullopt;
  }
  return SlewLimit{largest(for_slew(sets), place->range, slew_of_set), place->part};
}

LargestOfSets largest_noise(const ModelSets& sets) {
  return sets.objection.empty() ? largest(for_noise(sets), std::nullopt, noise_of) : LargestOfSets{};
}

LargestOfSets largest_slew(const ModelSets& sets) {
  return sets.objection.empty() ? largest(for_slew(sets), std::nullopt, slew_of_set) : LargestOfSets{};
}

}  // namespace veritrack::certificates
