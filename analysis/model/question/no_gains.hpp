// The reason why gains do not answer a question.
#pragma once

#include <string>

namespace veritrack::model {

struct NoGains {
  enum class Kind {
    question,      ///< it asks something that this proof does not cover
    band,          ///< some frequencies are out of reach
    steady_state,  ///< none was found
    bounds,        ///< those of the errors do not close, even without noise
    residual,      ///< the steady state is not linear in the frequency over the whole band
    structure,     ///< of the loop, by `detail`
    time           ///< it was over before `detail`
  };
  Kind kind = Kind::question;
  std::string detail = {};
};

}  // namespace veritrack::model
