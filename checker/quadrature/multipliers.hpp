// Proposals in double for the proof of the step inequality: any multipliers and any congruence are valid.
#pragma once

#include "checker/quadrature/step_form.hpp"

namespace veritrack::checker::step_form {

Matrix<double> with_lambda(const Form<double>& form, double lambda);
/// The multiplier with the most room, among powers of 2^(1/16).
double propose_lambda(const Form<double>& form);
/// The multiplier for |y| <= tangent |x| that leaves most room.
double propose_tau(const Form<double>& form, double lambda, double tangent);
/// L^-1 for m = L L'; not numbers when m is not definite.
Matrix<double> inverse_factor(const Matrix<double>& m);

}  // namespace veritrack::checker::step_form
