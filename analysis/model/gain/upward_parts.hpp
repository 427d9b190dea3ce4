// Work on the parts of a band, in parallel.
#pragma once

#include <cstddef>

#include <tbb/parallel_for.h>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

/// In any order, each with upward rounding: threads do not have it by themselves.
template <typename Task>
void for_each_part(std::size_t parts, const Task& task) {
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    const rigor::UpwardRounding upward;
    task(part);
  });
}

}  // namespace veritrack::model
