From Coq Require Export Reals Lra Psatz.
From Coquelicot Require Export Coquelicot.
From Interval Require Export Tactic Specific_ops Specific_stdz.

(* The interval tactic on Coq's own integers: it needs no axiom beyond those of the real numbers. *)
Module IntegerFloats := SpecificFloat StdZRadix2.
Module IntegerIntervals := IntervalTactic IntegerFloats.
Export IntegerIntervals.
Open Scope R_scope.

(* The KKL observer of L. Praly, L. Marconi and A. Isidori with four filters, for all filter rates l1, ..., l4.
   Equation numbers are those of "A new observer for an unknown harmonic oscillator". *)

(* The observer's map T for one filter of rate l, (6). *)
Definition transform (l x1 x2 x3 : R) : R := (l * x1 + x2) / (l ^ 2 + x3).

(* (3): along x1' = -x2, x2' = x3 x1 the filter's equation xi' = -l xi + x1 holds for xi = T. *)
Theorem invariance :
  forall (l x3 : R) (x1 x2 : R -> R) (t : R), 0 < x3 ->
  is_derive x1 t (- x2 t) -> is_derive x2 t (x3 * x1 t) ->
  is_derive (fun u => transform l (x1 u) (x2 u) x3) t (- l * transform l (x1 t) (x2 t) x3 + x1 t).
Proof.
intros l x3 x1 x2 t positive slope_1 slope_2.
unfold transform.
assert (l ^ 2 + x3 <> 0) by nra.
auto_derive.
- repeat split; try (eexists; eassumption).
- rewrite (is_derive_unique (fun x : R => x1 x) _ _ slope_1), (is_derive_unique (fun x : R => x2 x) _ _ slope_2).
  field; assumption.
Qed.

(* Rows of the matrix M below (9) times xi = (u1, u2, u3, u4), and |M xi|^2. *)
Definition excitation (l1 l2 l3 l4 u1 u2 u3 u4 : R) : R :=
  ((l3 - l4) * u2 + (l4 - l2) * u3 + (l2 - l3) * u4) ^ 2 +
  ((l4 - l3) * u1 + (l1 - l4) * u3 + (l3 - l1) * u4) ^ 2 +
  ((l2 - l4) * u1 + (l4 - l1) * u2 + (l1 - l2) * u4) ^ 2 +
  ((l3 - l2) * u1 + (l1 - l3) * u2 + (l2 - l1) * u3) ^ 2.

(* The entries of L'L, L = (lambda, 1, -xi). *)
Definition g11 (l1 l2 l3 l4 : R) : R := l1 ^ 2 + l2 ^ 2 + l3 ^ 2 + l4 ^ 2.
Definition g12 (l1 l2 l3 l4 : R) : R := l1 + l2 + l3 + l4.
Definition g13 (l1 l2 l3 l4 u1 u2 u3 u4 : R) : R := - (l1 * u1 + l2 * u2 + l3 * u3 + l4 * u4).
Definition g23 (u1 u2 u3 u4 : R) : R := - (u1 + u2 + u3 + u4).
Definition g33 (u1 u2 u3 u4 : R) : R := u1 ^ 2 + u2 ^ 2 + u3 ^ 2 + u4 ^ 2.

Definition det3 (a b c d e f : R) : R := a * (d * f - e * e) - b * (b * f - e * c) + c * (b * e - d * c).

Theorem determinant : forall l1 l2 l3 l4 u1 u2 u3 u4 : R,
  det3 (g11 l1 l2 l3 l4) (g12 l1 l2 l3 l4) (g13 l1 l2 l3 l4 u1 u2 u3 u4) 4 (g23 u1 u2 u3 u4) (g33 u1 u2 u3 u4) =
  excitation l1 l2 l3 l4 u1 u2 u3 u4.
Proof. intros. unfold det3, g11, g12, g13, g23, g33, excitation. ring. Qed.

(* y solves (L'L + mu I) y = L' F^2 xi, (15); with the regularization mu of (9) it is gamma(xi). *)
Definition solves (mu l1 l2 l3 l4 u1 u2 u3 u4 y1 y2 y3 : R) : Prop :=
  (g11 l1 l2 l3 l4 + mu) * y1 + g12 l1 l2 l3 l4 * y2 + g13 l1 l2 l3 l4 u1 u2 u3 u4 * y3 =
    l1 ^ 3 * u1 + l2 ^ 3 * u2 + l3 ^ 3 * u3 + l4 ^ 3 * u4 /\
  g12 l1 l2 l3 l4 * y1 + (4 + mu) * y2 + g23 u1 u2 u3 u4 * y3 =
    l1 ^ 2 * u1 + l2 ^ 2 * u2 + l3 ^ 2 * u3 + l4 ^ 2 * u4 /\
  g13 l1 l2 l3 l4 u1 u2 u3 u4 * y1 + g23 u1 u2 u3 u4 * y2 + (g33 u1 u2 u3 u4 + mu) * y3 =
    - (l1 ^ 2 * u1 ^ 2 + l2 ^ 2 * u2 ^ 2 + l3 ^ 2 * u3 ^ 2 + l4 ^ 2 * u4 ^ 2).

Definition regularization (ell l1 l2 l3 l4 u1 u2 u3 u4 : R) : R :=
  Rmax (ell * g33 u1 u2 u3 u4 - 2 * excitation l1 l2 l3 l4 u1 u2 u3 u4) 0.

(* T(x) times L, row by row: L x = F^2 T(x). *)
Lemma row : forall l x1 x2 x3 : R, 0 < x3 ->
  l * x1 + x2 - transform l x1 x2 x3 * x3 = l ^ 2 * transform l x1 x2 x3.
Proof. intros. unfold transform. field. nra. Qed.

Lemma state_solves : forall l1 l2 l3 l4 x1 x2 x3 : R, 0 < x3 ->
  solves 0 l1 l2 l3 l4 (transform l1 x1 x2 x3) (transform l2 x1 x2 x3) (transform l3 x1 x2 x3)
    (transform l4 x1 x2 x3) x1 x2 x3.
Proof.
intros l1 l2 l3 l4 x1 x2 x3 positive.
generalize (row l1 x1 x2 x3 positive) (row l2 x1 x2 x3 positive) (row l3 x1 x2 x3 positive)
  (row l4 x1 x2 x3 positive).
generalize (transform l1 x1 x2 x3) (transform l2 x1 x2 x3) (transform l3 x1 x2 x3) (transform l4 x1 x2 x3).
intros u1 u2 u3 u4 r1 r2 r3 r4.
unfold solves, g11, g12, g13, g23, g33.
repeat split.
- replace (l1 ^ 3 * u1 + l2 ^ 3 * u2 + l3 ^ 3 * u3 + l4 ^ 3 * u4) with
    (l1 * (l1 ^ 2 * u1) + l2 * (l2 ^ 2 * u2) + l3 * (l3 ^ 2 * u3) + l4 * (l4 ^ 2 * u4)) by ring.
  rewrite <- r1, <- r2, <- r3, <- r4. ring.
- rewrite <- r1, <- r2, <- r3, <- r4. ring.
- replace (- (l1 ^ 2 * u1 ^ 2 + l2 ^ 2 * u2 ^ 2 + l3 ^ 2 * u3 ^ 2 + l4 ^ 2 * u4 ^ 2)) with
    (- (u1 * (l1 ^ 2 * u1) + u2 * (l2 ^ 2 * u2) + u3 * (l3 ^ 2 * u3) + u4 * (l4 ^ 2 * u4))) by ring.
  rewrite <- r1, <- r2, <- r3, <- r4. ring.
Qed.

(* Two solutions of a symmetric 3 x 3 system whose determinant is not zero are the same. *)
Lemma unique : forall a b c d e f y1 y2 y3 z1 z2 z3 : R, det3 a b c d e f <> 0 ->
  a * y1 + b * y2 + c * y3 = a * z1 + b * z2 + c * z3 ->
  b * y1 + d * y2 + e * y3 = b * z1 + d * z2 + e * z3 ->
  c * y1 + e * y2 + f * y3 = c * z1 + e * z2 + f * z3 ->
  y1 = z1 /\ y2 = z2 /\ y3 = z3.
Proof.
intros a b c d e f y1 y2 y3 z1 z2 z3 regular q1 q2 q3.
assert (s1 : a * (y1 - z1) + b * (y2 - z2) + c * (y3 - z3) = 0) by lra.
assert (s2 : b * (y1 - z1) + d * (y2 - z2) + e * (y3 - z3) = 0) by lra.
assert (s3 : c * (y1 - z1) + e * (y2 - z2) + f * (y3 - z3) = 0) by lra.
assert (d1 : det3 a b c d e f * (y1 - z1) = (d * f - e * e) * (a * (y1 - z1) + b * (y2 - z2) + c * (y3 - z3)) -
  (b * f - c * e) * (b * (y1 - z1) + d * (y2 - z2) + e * (y3 - z3)) +
  (b * e - c * d) * (c * (y1 - z1) + e * (y2 - z2) + f * (y3 - z3))) by (unfold det3; ring).
assert (d2 : det3 a b c d e f * (y2 - z2) = - (b * f - c * e) * (a * (y1 - z1) + b * (y2 - z2) + c * (y3 - z3)) +
  (a * f - c * c) * (b * (y1 - z1) + d * (y2 - z2) + e * (y3 - z3)) -
  (a * e - b * c) * (c * (y1 - z1) + e * (y2 - z2) + f * (y3 - z3))) by (unfold det3; ring).
assert (d3 : det3 a b c d e f * (y3 - z3) = (b * e - c * d) * (a * (y1 - z1) + b * (y2 - z2) + c * (y3 - z3)) -
  (a * e - b * c) * (b * (y1 - z1) + d * (y2 - z2) + e * (y3 - z3)) +
  (a * d - b * b) * (c * (y1 - z1) + e * (y2 - z2) + f * (y3 - z3))) by (unfold det3; ring).
rewrite s1, s2, s3 in d1, d2, d3.
repeat split; apply Rminus_diag_uniq; apply Rmult_eq_reg_l with (det3 a b c d e f); lra.
Qed.

(* Where mu vanishes and M T(x) does not, gamma(T(x)) = x. *)
Theorem inverse_where_regularization_vanishes : forall ell l1 l2 l3 l4 x1 x2 x3 y1 y2 y3 : R, 0 < x3 ->
  let u1 := transform l1 x1 x2 x3 in let u2 := transform l2 x1 x2 x3 in
  let u3 := transform l3 x1 x2 x3 in let u4 := transform l4 x1 x2 x3 in
  ell * g33 u1 u2 u3 u4 <= 2 * excitation l1 l2 l3 l4 u1 u2 u3 u4 ->
  0 < excitation l1 l2 l3 l4 u1 u2 u3 u4 ->
  solves (regularization ell l1 l2 l3 l4 u1 u2 u3 u4) l1 l2 l3 l4 u1 u2 u3 u4 y1 y2 y3 ->
  y1 = x1 /\ y2 = x2 /\ y3 = x3.
Proof.
intros ell l1 l2 l3 l4 x1 x2 x3 y1 y2 y3 positive u1 u2 u3 u4 small excited solution.
assert (mu : regularization ell l1 l2 l3 l4 u1 u2 u3 u4 = 0) by (apply Rmax_right; lra).
rewrite mu in solution.
destruct (state_solves l1 l2 l3 l4 x1 x2 x3 positive) as (e1 & e2 & e3).
destruct solution as (f1 & f2 & f3).
rewrite <- determinant in excited.
apply (unique _ _ _ _ _ _ _ _ _ _ _ _ (Rgt_not_eq _ _ excited)); fold u1 u2 u3 u4 in e1, e2, e3; lra.
Qed.

Lemma form_is_positive : forall a b c x y : R, 0 < a -> 0 <= a * c - b ^ 2 -> 0 <= a * x ^ 2 + 2 * b * x * y + c * y ^ 2.
Proof.
intros a b c x y positive discriminant.
apply Rmult_le_reg_l with a; [ assumption | ].
replace (a * (a * x ^ 2 + 2 * b * x * y + c * y ^ 2)) with ((a * x + b * y) ^ 2 + (a * c - b ^ 2) * y ^ 2) by ring.
rewrite Rmult_0_r. generalize (pow2_ge_0 (a * x + b * y)) (pow2_ge_0 y). nra.
Qed.

(* |M T|^2 - ell |T|^2 is a quadratic form in (x1, x2), s = x3; these are its entries times the square
   of the product of the denominators. *)
Definition denominator (l s : R) := l ^ 2 + s.
Definition vandermonde (a b c : R) := (a - b) * (b - c) * (a - c).
Definition first (a b c s : R) : R := a * b * c - s * (a + b + c).
Definition second (a b c s : R) : R := a * b + b * c + c * a - s.
Section Entries.
Variables l1 l2 l3 l4 ell s : R.
Let d1 := denominator l1 s.
Let d2 := denominator l2 s.
Let d3 := denominator l3 s.
Let d4 := denominator l4 s.
Definition entry_a : R :=
  (vandermonde l2 l3 l4 * d1 * first l2 l3 l4 s) ^ 2 + (vandermonde l1 l3 l4 * d2 * first l1 l3 l4 s) ^ 2 +
  (vandermonde l1 l2 l4 * d3 * first l1 l2 l4 s) ^ 2 + (vandermonde l1 l2 l3 * d4 * first l1 l2 l3 s) ^ 2 -
  ell * ((d2 * d3 * d4 * l1) ^ 2 + (d1 * d3 * d4 * l2) ^ 2 + (d1 * d2 * d4 * l3) ^ 2 + (d1 * d2 * d3 * l4) ^ 2).
Definition entry_b : R :=
  (vandermonde l2 l3 l4 * d1) ^ 2 * first l2 l3 l4 s * second l2 l3 l4 s +
  (vandermonde l1 l3 l4 * d2) ^ 2 * first l1 l3 l4 s * second l1 l3 l4 s +
  (vandermonde l1 l2 l4 * d3) ^ 2 * first l1 l2 l4 s * second l1 l2 l4 s +
  (vandermonde l1 l2 l3 * d4) ^ 2 * first l1 l2 l3 s * second l1 l2 l3 s -
  ell * ((d2 * d3 * d4) ^ 2 * l1 + (d1 * d3 * d4) ^ 2 * l2 + (d1 * d2 * d4) ^ 2 * l3 + (d1 * d2 * d3) ^ 2 * l4).
Definition entry_c : R :=
  (vandermonde l2 l3 l4 * d1 * second l2 l3 l4 s) ^ 2 + (vandermonde l1 l3 l4 * d2 * second l1 l3 l4 s) ^ 2 +
  (vandermonde l1 l2 l4 * d3 * second l1 l2 l4 s) ^ 2 + (vandermonde l1 l2 l3 * d4 * second l1 l2 l3 s) ^ 2 -
  ell * ((d2 * d3 * d4) ^ 2 + (d1 * d3 * d4) ^ 2 + (d1 * d2 * d4) ^ 2 + (d1 * d2 * d3) ^ 2).
End Entries.


Ltac unfold_form :=
  unfold entry_a, entry_b, entry_c, first, second, vandermonde, denominator.

Lemma form_of_excitation : forall l1 l2 l3 l4 ell x1 x2 s : R, 0 < s ->
  let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  excitation l1 l2 l3 l4 u1 u2 u3 u4 - ell * g33 u1 u2 u3 u4 =
  (entry_a l1 l2 l3 l4 ell s * x1 ^ 2 + 2 * entry_b l1 l2 l3 l4 ell s * x1 * x2 + entry_c l1 l2 l3 l4 ell s * x2 ^ 2) /
    (denominator l1 s * denominator l2 s * denominator l3 s * denominator l4 s) ^ 2.
Proof.
intros l1 l2 l3 l4 ell x1 x2 s positive u1 u2 u3 u4.
unfold u1, u2, u3, u4, transform, excitation, g33. unfold_form.
field. repeat split; nra.
Qed.

(* |M T(x)|^2 >= ell |T(x)|^2 where the form is positive definite. *)
Lemma excitation_is_at_least : forall l1 l2 l3 l4 ell x1 x2 s : R, 0 < s ->
  0 < entry_a l1 l2 l3 l4 ell s ->
  0 < entry_a l1 l2 l3 l4 ell s * entry_c l1 l2 l3 l4 ell s - entry_b l1 l2 l3 l4 ell s ^ 2 ->
  let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  ell * g33 u1 u2 u3 u4 <= excitation l1 l2 l3 l4 u1 u2 u3 u4.
Proof.
intros l1 l2 l3 l4 ell x1 x2 s positive first_entry discriminant u1 u2 u3 u4.
apply Rminus_le_0. unfold u1, u2, u3, u4.
rewrite form_of_excitation; [ | assumption ].
apply Rdiv_le_0_compat.
- apply form_is_positive; [ assumption | left; assumption ].
- unfold denominator. apply pow2_gt_0.
  repeat apply Rmult_integral_contrapositive_currified; nra.
Qed.

(* T(x) = 0 only for the signal that is zero: two filters of different rates see it. *)
Lemma filters_see_the_signal : forall l1 l2 l3 l4 x1 x2 s : R, 0 < s -> l1 <> l2 -> x1 <> 0 \/ x2 <> 0 ->
  0 < g33 (transform l1 x1 x2 s) (transform l2 x1 x2 s) (transform l3 x1 x2 s) (transform l4 x1 x2 s).
Proof.
intros l1 l2 l3 l4 x1 x2 s positive different nonzero.
generalize (row l1 x1 x2 s positive) (row l2 x1 x2 s positive).
generalize (transform l1 x1 x2 s) (transform l2 x1 x2 s) (transform l3 x1 x2 s) (transform l4 x1 x2 s).
intros u1 u2 u3 u4 r1 r2.
assert (weak : 0 <= g33 u1 u2 u3 u4) by (unfold g33; nra).
destruct weak as [ strict | zero ]; [ assumption | exfalso ].
assert (z1 : u1 = 0) by (unfold g33 in zero; nra).
assert (z2 : u2 = 0) by (unfold g33 in zero; nra).
subst u1 u2.
assert (e1 : (l1 - l2) * x1 = 0) by lra.
apply Rmult_integral in e1. destruct e1 as [ same | zero_1 ]; [ lra | ].
subst x1. assert (x2 = 0) by lra. destruct nonzero; contradiction.
Qed.

(* gamma o T = id at a signal for which M T(x) is that far from zero. *)
Theorem inverse_where_excited : forall lower ell l1 l2 l3 l4 x1 x2 s y1 y2 y3 : R, 0 < s -> l1 <> l2 ->
  x1 <> 0 \/ x2 <> 0 -> 0 < lower -> ell <= 2 * lower ->
  let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  lower * g33 u1 u2 u3 u4 <= excitation l1 l2 l3 l4 u1 u2 u3 u4 ->
  solves (regularization ell l1 l2 l3 l4 u1 u2 u3 u4) l1 l2 l3 l4 u1 u2 u3 u4 y1 y2 y3 ->
  y1 = x1 /\ y2 = x2 /\ y3 = s.
Proof.
intros lower ell l1 l2 l3 l4 x1 x2 s y1 y2 y3 positive different nonzero lower_is_positive small u1 u2 u3 u4 bound.
assert (large := filters_see_the_signal l1 l2 l3 l4 x1 x2 s positive different nonzero).
apply inverse_where_regularization_vanishes; fold u1 u2 u3 u4 in large |- *; nra.
Qed.

(* Where mu does not vanish gamma(T(x)) is not x. *)
Theorem no_inverse_where_regularized : forall ell l1 l2 l3 l4 x1 x2 s y1 y2 y3 : R, 0 < s ->
  let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  0 < ell * g33 u1 u2 u3 u4 - 2 * excitation l1 l2 l3 l4 u1 u2 u3 u4 ->
  solves (regularization ell l1 l2 l3 l4 u1 u2 u3 u4) l1 l2 l3 l4 u1 u2 u3 u4 y1 y2 y3 ->
  ~ (y1 = x1 /\ y2 = x2 /\ y3 = s).
Proof.
intros ell l1 l2 l3 l4 x1 x2 s y1 y2 y3 positive u1 u2 u3 u4 large solution (e1 & e2 & e3). subst y1 y2 y3.
assert (0 < regularization ell l1 l2 l3 l4 u1 u2 u3 u4).
{ apply Rlt_le_trans with (1 := large). apply Rmax_l. }
destruct (state_solves l1 l2 l3 l4 x1 x2 s positive) as (_ & _ & f3). fold u1 u2 u3 u4 in f3.
destruct solution as (_ & _ & g3).
assert (regularization ell l1 l2 l3 l4 u1 u2 u3 u4 * s = 0) by lra.
nra.
Qed.
