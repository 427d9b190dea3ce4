// The characteristic polynomial of a matrix of balls, and its values near a point of the complex plane.
#pragma once

#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

using BallRows = std::vector<std::vector<Ball>>;

/// det(z - A), coefficients from the constant one on.
std::vector<Ball> characteristic_polynomial(const BallRows& matrix);

struct ComplexBall {
  Ball real, imaginary;
};
inline ComplexBall operator+(const ComplexBall& x, const ComplexBall& y) {
  return {x.real + y.real, x.imaginary + y.imaginary};
}
inline ComplexBall operator*(const ComplexBall& x, const ComplexBall& y) {
  return {x.real * y.real - x.imaginary * y.imaginary, x.real * y.imaginary + x.imaginary * y.real};
}
/// exp(real + j imaginary).
ComplexBall exponential(const Ball& real, const Ball& imaginary);
Ball length(const ComplexBall& x);

/// The values of a polynomial in a disc: nowhere farther than `spread` from the one in its centre.
struct ValuesInDisc {
  ComplexBall centre;
  Ball spread;
};
/// By the Taylor expansion about the centre. For every polynomial in the balls.
ValuesInDisc values_in_disc(const std::vector<Ball>& polynomial, const ComplexBall& centre,
                            const Ball& radius);

}  // namespace veritrack::checker
