#include "analysis/model/gain/factor_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace veritrack::model {

using trackers::Instruction;
using trackers::Operation;
using trackers::StraightLineProgram;

namespace {

struct Factors {
  std::vector<int> above, below;  ///< registers of the new program
};

class Reordering {
 public:
  Reordering(const StraightLineProgram& program, const std::vector<std::vector<double>>& values)
      : program_(&program), result_(program.inputs()), uses_(static_cast<std::size_t>(program.registers())) {
    for (const Instruction& each : program.instructions()) {
      for (const int operand : {each.first, each.second, each.third}) {
        if (operand >= 0) {
          ++uses_[static_cast<std::size_t>(operand)];
        }
      }
    }
    for (const auto* list : {&program.results(), &program.limits()}) {
      for (const int each : *list) {
        uses_[static_cast<std::size_t>(each)] += 2;
      }
    }
    find_sizes(values);
  }

  StraightLineProgram run() {
    for (int r = 0; r < program_->registers(); ++r) {
      now_.push_back(r < program_->inputs() ? r : -1);
      vanishes_.push_back(vanishes_in_program(r));
    }
    for (int r = program_->inputs(); r < program_->registers(); ++r) {
      const Instruction& each = at(r);
      if (is_product(r) && uses_[static_cast<std::size_t>(r)] == 1 && is_part_of_product(r)) {
        continue;  // written with the product that it is a factor of
      }
      now_[static_cast<std::size_t>(r)] = is_product(r) ? product(r) : copy(each);
    }
    for (const int each : program_->results()) {
      result_.add_result(now_[static_cast<std::size_t>(each)]);
    }
    for (const int each : program_->limits()) {
      result_.add_limit(now_[static_cast<std::size_t>(each)]);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Instruction& at(int place) const {
    return program_->instructions()[static_cast<std::size_t>(place - program_->inputs())];
  }
  [[nodiscard]] bool is_product(int place) const {
    return place >= program_->inputs() &&
           (at(place).operation == Operation::multiply || at(place).operation == Operation::divide);
  }
  /// Whether its only user is a product.
  [[nodiscard]] bool is_part_of_product(int place) const {
    for (int r = place + 1; r < program_->registers(); ++r) {
      const Instruction& each = at(r);
      if (each.first == place || each.second == place || each.third == place) {
        return is_product(r) && each.first != each.second;
      }
    }
    return false;
  }
  void find_sizes(const std::vector<std::vector<double>>& values) {
    sizes_.assign(static_cast<std::size_t>(program_->registers()), 0.0);
    for (const std::vector<double>& each : values) {
      for (std::size_t r = 0; r < sizes_.size(); ++r) {
        sizes_[r] = std::max(sizes_[r], std::fabs(each.at(r)));
      }
    }
  }
  [[nodiscard]] bool vanishes_in_program(int place) const {
    constexpr double kSmall = 0x1p-10;
    if (place < program_->inputs()) {
      return false;
    }
    const Instruction& each = at(place);
    const auto is_below = [&](int term) {
      return sizes_[static_cast<std::size_t>(place)] < kSmall * sizes_[static_cast<std::size_t>(term)];
    };
    return (each.operation == Operation::add || each.operation == Operation::subtract) &&
           is_below(each.first) && is_below(each.second);
  }
  int copy(Instruction each) {
    for (int* operand : {&each.first, &each.second, &each.third}) {
      *operand = *operand < 0 ? -1 : now_[static_cast<std::size_t>(*operand)];
    }
    return result_.append(each);
  }
  void collect(int place, bool is_below, Factors& factors, std::vector<int>& last) {
    if (is_product(place) && now_[static_cast<std::size_t>(place)] < 0) {
      const Instruction& each = at(place);
      collect(each.first, is_below, factors, last);
      collect(each.second, is_below != (each.operation == Operation::divide), factors, last);
      return;
    }
    const int here = now_[static_cast<std::size_t>(place)];
    if (!is_below && vanishes_[static_cast<std::size_t>(place)]) {
      last.push_back(here);
    } else {
      (is_below ? factors.below : factors.above).push_back(here);
    }
  }
  int product(int place) {
    Factors factors;
    std::vector<int> last;
    collect(place, false, factors, last);
    if (last.size() != 1 || factors.above.empty()) {
      return as_it_is(place);
    }
    int result = factors.above.front();
    for (std::size_t i = 1; i < factors.above.size(); ++i) {
      result = result_.append(Operation::multiply, result, factors.above[i]);
    }
    for (const int each : factors.below) {
      result = result_.append(Operation::divide, result, each);
    }
    return result_.append(Operation::multiply, result, last.front());
  }
  int as_it_is(int place) {
    const Instruction& each = at(place);
    for (const int operand : {each.first, each.second}) {
      if (now_[static_cast<std::size_t>(operand)] < 0) {
        now_[static_cast<std::size_t>(operand)] = as_it_is(operand);
      }
    }
    return copy(each);
  }

  const StraightLineProgram* program_;
  StraightLineProgram result_;
  std::vector<int> uses_;
  std::vector<double> sizes_;
  std::vector<int> now_;
  std::vector<bool> vanishes_;
};

}  // namespace

StraightLineProgram with_vanishing_factors_last(const StraightLineProgram& program,
                                                const std::vector<std::vector<double>>& values) {
  return Reordering(program, values).run();
}

}  // namespace veritrack::model
