From Coq Require Export Reals Lra Psatz.
From Interval Require Export Tactic Specific_ops Specific_stdz.

(* The interval tactic on Coq's own integers: it needs no axiom beyond those of the real numbers. *)
Module IntegerFloats := SpecificFloat StdZRadix2.
Module IntegerIntervals := IntervalTactic IntegerFloats.
Export IntegerIntervals.
Open Scope R_scope.

(* Proposition 1 of S. Bittanti and S. M. Savaresi, "On the parameterization and design of an extended Kalman filter
   frequency tracker", IEEE Trans. Automatic Control 45(9), 2000, for all gains and frequencies. Equation numbers are
   theirs. *)

(* The filter (3) with frozen frequency x3 and gain K = (k1, k2): c = cos x3, s = sin x3, R = ((c, -s), (s, c)),
   h = (1, 0). Rows of A = (I - K h) R: *)
Definition a11 (k1 c : R) : R := (1 - k1) * c.
Definition a12 (k1 s : R) : R := - ((1 - k1) * s).
Definition a21 (k2 c s : R) : R := s - k2 * c.
Definition a22 (k2 c s : R) : R := c + k2 * s.

Definition characteristic (k1 k2 c s z : R) : R :=
  (z - a11 k1 c) * (z - a22 k2 c s) - a12 k1 s * a21 k2 c s.
Definition denominator (k1 k2 c s z : R) : R := z ^ 2 - z * (k2 * s + 2 * c - k1 * c) + 1 - k1.
Definition denominator_as_printed (k1 k2 c s z : R) : R := z ^ 2 - z * (k2 * s + 2 * c) + (k1 * c - k1 + 1).
Definition numerator (c z : R) : R := z ^ 2 - 2 * c * z + 1.

(* Equal modulo c^2 + s^2 = 1: the difference is a multiple of that. *)
Theorem characteristic_polynomial : forall k1 k2 c s z : R, c ^ 2 + s ^ 2 = 1 ->
  characteristic k1 k2 c s z = denominator k1 k2 c s z.
Proof.
intros k1 k2 c s z circle.
replace (characteristic k1 k2 c s z) with
  (z ^ 2 - z * (k2 * s + 2 * c - k1 * c) + (1 - k1) * (c ^ 2 + s ^ 2))
  by (unfold characteristic, a11, a12, a21, a22; ring).
rewrite circle. unfold denominator. ring.
Qed.

Theorem denominator_as_printed_is_another :
  exists k1 k2 c s z : R, c ^ 2 + s ^ 2 = 1 /\ denominator_as_printed k1 k2 c s z <> characteristic k1 k2 c s z.
Proof.
exists (1 / 2), (1 / 4), (3 / 5), (4 / 5), 2. split; [ lra | ].
unfold denominator_as_printed, characteristic, a11, a12, a21, a22. lra.
Qed.

(* z times row 1 and row 2 of adj(zI - A) K, and what (4) prints. *)
Theorem numerator_1 : forall k1 k2 c s z : R, c ^ 2 + s ^ 2 = 1 ->
  z * ((z - a22 k2 c s) * k1 + a12 k1 s * k2) = z * (z * k1 - k1 * c - k2 * s).
Proof. intros. unfold a22, a12. ring. Qed.

Theorem numerator_2 : forall k1 k2 c s z : R, c ^ 2 + s ^ 2 = 1 ->
  z * (a21 k2 c s * k1 + (z - a11 k1 c) * k2) = z * (z * k2 + k1 * s - k2 * c).
Proof. intros. unfold a21, a11. ring. Qed.

(* x = R x / z + K e and e = y - h R x / z, the filter and its innovation e for the measurement y: *)
Theorem response : forall k1 k2 c s z x1 x2 e y : R, c ^ 2 + s ^ 2 = 1 ->
  z * x1 = c * x1 - s * x2 + z * k1 * e -> z * x2 = s * x1 + c * x2 + z * k2 * e ->
  z * e = z * y - (c * x1 - s * x2) -> z <> 0 ->
  denominator k1 k2 c s z * e = numerator c z * y.
Proof.
intros k1 k2 c s z x1 x2 e y circle f1 f2 f3 nonzero.
apply Rmult_eq_reg_l with z; [ | assumption ].
assert (g1 : numerator c z * x1 = z * (z * k1 - k1 * c - k2 * s) * e).
{ replace (numerator c z) with (z ^ 2 - 2 * c * z + (c ^ 2 + s ^ 2)) by (rewrite circle; unfold numerator; ring).
  replace ((z ^ 2 - 2 * c * z + (c ^ 2 + s ^ 2)) * x1) with
    ((z - c) * (z * x1 - (c * x1 - s * x2)) - s * (z * x2 - (s * x1 + c * x2))) by ring.
  replace (z * x1 - (c * x1 - s * x2)) with (z * k1 * e) by lra.
  replace (z * x2 - (s * x1 + c * x2)) with (z * k2 * e) by lra. ring. }
assert (g2 : numerator c z * x2 = z * (z * k2 + k1 * s - k2 * c) * e).
{ replace (numerator c z) with (z ^ 2 - 2 * c * z + (c ^ 2 + s ^ 2)) by (rewrite circle; unfold numerator; ring).
  replace ((z ^ 2 - 2 * c * z + (c ^ 2 + s ^ 2)) * x2) with
    ((z - c) * (z * x2 - (s * x1 + c * x2)) + s * (z * x1 - (c * x1 - s * x2))) by ring.
  replace (z * x1 - (c * x1 - s * x2)) with (z * k1 * e) by lra.
  replace (z * x2 - (s * x1 + c * x2)) with (z * k2 * e) by lra. ring. }
assert (left : numerator c z * (z * y) = numerator c z * (z * e) + c * (numerator c z * x1) - s * (numerator c z * x2)).
{ replace (z * y) with (z * e + (c * x1 - s * x2)) by lra. ring. }
rewrite g1, g2 in left.
replace (z * (numerator c z * y)) with (numerator c z * (z * y)) by ring.
rewrite left.
replace (numerator c z * (z * e) + c * (z * (z * k1 - k1 * c - k2 * s) * e) - s * (z * (z * k2 + k1 * s - k2 * c) * e))
  with (z * ((numerator c z + z * (k1 * c - k2 * s) - k1 * (c ^ 2 + s ^ 2)) * e)) by ring.
rewrite circle. unfold numerator, denominator. ring.
Qed.

(* The printed G has the numerator z (z^2 - 2 c z + 1) over the printed denominator. *)
Theorem response_as_printed_is_another :
  exists k1 k2 c s z : R, c ^ 2 + s ^ 2 = 1 /\
  z * numerator c z / denominator_as_printed k1 k2 c s z <> numerator c z / denominator k1 k2 c s z.
Proof.
exists (1 / 2), (1 / 4), (3 / 5), (4 / 5), 2. split; [ lra | ].
unfold denominator_as_printed, denominator, numerator. intro equal.
assert (0 < 2 * (2 ^ 2 - 2 * (3 / 5) * 2 + 1) /
  (2 ^ 2 - 2 * (1 / 4 * (4 / 5) + 2 * (3 / 5)) + (1 / 2 * (3 / 5) - 1 / 2 + 1)) -
  (2 ^ 2 - 2 * (3 / 5) * 2 + 1) / (2 ^ 2 - 2 * (1 / 4 * (4 / 5) + 2 * (3 / 5) - 1 / 2 * (3 / 5)) + 1 - 1 / 2))
  by interval with (i_prec 60).
lra.
Qed.

(* e^{+-i x3} = cos x3 +- i sin x3 are the zeros: real and imaginary part of z^2 - 2 z cos x3 + 1 there. *)
Theorem zeros : forall x3 : R, let c := cos x3 in let s := sin x3 in
  (c ^ 2 - s ^ 2) - 2 * c * c + 1 = 0 /\ 2 * c * s - 2 * c * s = 0 /\ c ^ 2 + s ^ 2 = 1.
Proof.
intros x3 c s. assert (circle := sin2_cos2 x3). unfold Rsqr in circle. unfold c, s. split; [ | split ]; nra.
Qed.

(* The Jury conditions: a complex root a + i b of z^2 - t z + d lies inside the unit circle. *)
Theorem jury : forall t d a b : R, -1 < d < 1 -> 0 < 1 - t + d -> 0 < 1 + t + d ->
  a ^ 2 - b ^ 2 - t * a + d = 0 -> 2 * a * b - t * b = 0 -> a ^ 2 + b ^ 2 < 1.
Proof.
intros t d a b product at_1 at_minus_1 real imaginary.
destruct (Req_dec b 0) as [ zero | nonzero ].
- subst b.
  assert (below : a < 1).
  { apply Rnot_le_lt; intro. assert ((1 - a) * (a - d) = a * (1 - t + d)) by nra. nra. }
  assert (above : -1 < a).
  { apply Rnot_le_lt; intro. assert ((1 + a) * (a + d) = a * (1 + t + d)) by nra. nra. }
  nra.
- assert (t = 2 * a) by (apply Rmult_eq_reg_r with b; [ lra | assumption ]). subst t. nra.
Qed.
